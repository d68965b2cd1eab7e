// Poses at any time, and what is derived from them: displacement, speed, damage of blocks.
import {run} from './data.js';

export class Motion {
  constructor(poses, damage) {
    this.poses = poses, this.damage = damage;
    this.nblock = run.blocks.length, this.nframe = run.times.length;
    this.jointsOf = run.blocks.map(() => []);
    run.joints.forEach(([a, b], joint) => (this.jointsOf[a].push(joint), this.jointsOf[b].push(joint)));
    this.now = new Float32Array(7 * this.nblock), this.time = run.times[0];
    this.moving = run.blocks.flatMap((block, b) => (block[3] ? [] : [b]));
    this.most = {displacement: 0, speed: 0};
    for (const b of this.moving)
      for (let f = 0; f < this.nframe; ++f) {
        this.most.displacement = Math.max(this.most.displacement, this.displacement(b, f));
        this.most.speed = Math.max(this.most.speed, this.speed(b, f));
      }
  }

  at(block, frame) { return 7 * (frame * this.nblock + block); }

  // The frame at or before time t (s).
  frame(t) {
    let low = 0, high = this.nframe - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (run.times[middle] <= t) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  // Fills `now` with the poses at time t, between two frames by straight lines and normalised quaternions.
  setTime(t) {
    this.time = t;
    const f = this.frame(t), g = Math.min(f + 1, this.nframe - 1), {poses, now} = this;
    const share = g > f ? Math.min(1, Math.max(0, (t - run.times[f]) / (run.times[g] - run.times[f]))) : 0;
    for (let b = 0; b < this.nblock; ++b) {
      const p = this.at(b, f), q = this.at(b, g), n = 7 * b;
      for (let i = 0; i < 7; ++i) now[n + i] = poses[p + i] + share * (poses[q + i] - poses[p + i]);
      const length = Math.hypot(now[n + 3], now[n + 4], now[n + 5], now[n + 6]) || 1;
      for (let i = 3; i < 7; ++i) now[n + i] /= length;
    }
    return f;
  }

  // Of the centroid from its place at rest, in axis `axis` or as a length, m.
  displacement(block, frame, axis) {
    const p = this.at(block, frame), rest = run.blocks[block];
    const d = [0, 1, 2].map((i) => this.poses[p + i] - rest[5 + i]);
    return axis === undefined ? Math.hypot(...d) : d[axis];
  }

  // m/s, of the centroid from the frame before to this one.
  speed(block, frame) {
    if (frame === 0) return 0;
    const p = this.at(block, frame), q = this.at(block, frame - 1), dt = run.times[frame] - run.times[frame - 1];
    return Math.hypot(...[0, 1, 2].map((i) => this.poses[p + i] - this.poses[q + i])) / dt;
  }

  jointDamage(joint, frame) { return this.damage[joint * this.nframe + frame] / 255; }

  // The mean damage of its joints, 0 to 1.
  blockDamage(block, frame) {
    const joints = this.jointsOf[block];
    return joints.reduce((sum, joint) => sum + this.jointDamage(joint, frame), 0) / (joints.length || 1);
  }
}
