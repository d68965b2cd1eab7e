// A test on a table that tilts: the run computes in the frame of the table, in which gravity turns. Here the table turns instead.
import * as THREE from 'three';

const level = 1e-6;  // rad, below which nothing tilts

export class Table {
  // From the columns of histories.csv. null where gravity keeps to the vertical.
  static of({names, columns}) {
    const time = columns[names.indexOf('time_s')], gravity = ['x', 'y', 'z'].map((axis) => columns[names.indexOf(`gravity_a${axis}_m_s2`)]);
    if (!time?.length || gravity.some((column) => !column)) return null;
    const table = new Table(time, gravity);
    return time.some((t) => table.angle(t) > level) ? table : null;
  }

  constructor(time, gravity) { this.time = time, this.gravity = gravity; }

  // Direction in which all falls at time t, in the frame of the table.
  down(t) {
    const {time, gravity} = this;
    let low = 0, high = time.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (time[middle] <= t) low = middle;
      else high = middle;
    }
    const share = high > low ? Math.min(1, Math.max(0, (t - time[low]) / (time[high] - time[low]))) : 0;
    return new THREE.Vector3(...gravity.map((g) => g[low] + share * (g[high] - g[low]))).normalize();
  }

  // The rotation of the table, so that gravity points downwards.
  turn(t) { return new THREE.Quaternion().setFromUnitVectors(this.down(t), new THREE.Vector3(0, 0, -1)); }

  // rad
  angle(t) { return this.down(t).angleTo(new THREE.Vector3(0, 0, -1)); }

  // The time at which it leans most.
  get steepest() { return this.time.reduce((most, t) => (this.angle(t) > this.angle(most) ? t : most), this.time[0]); }
}
