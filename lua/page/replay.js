// The blocks in 3D: one instanced mesh for each shape, turned by the pointer or the keys, picked by a click.
import * as THREE from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';

import {run} from './data.js';

const thin = 0.03;  // of the size of the structure: the thickness of a table that tilts

// Colours of a scale from 0 to 1, dark to bright, even in lightness: viridis (van der Walt and Smith 2015).
const scale = ['#440154', '#3b528b', '#21918c', '#5ec962', '#fde725'].map((hex) => new THREE.Color(hex));
export const scaleCss = 'linear-gradient(90deg, #440154, #3b528b, #21918c, #5ec962, #fde725)';

function scaleColor(value, out) {
  const x = 4 * Math.min(1, Math.max(0, value)), i = Math.min(3, Math.floor(x));
  return out.copy(scale[i]).lerp(scale[i + 1], x - i);
}

export function materialCss(material) {
  const color = run.manifest.materials?.[material]?.color ?? [0.6, 0.6, 0.6];
  return `rgb(${color.map((c) => Math.round(255 * Math.min(1, Math.max(0, c)))).join(' ')})`;
}

// A fixed pseudo-random shade for each block, so that neighbours can be told apart.
const shade = (block) => 0.8 + 0.12 * (block % 2) + 0.2 * (((block * 2654435761) >>> 8) % 1000) / 1000;

// Of a block at rest.
function boxOf(block) {
  const [, , , , shape, ...rest] = run.blocks[block], {vertices} = run.shapes[shape], box = new THREE.Box3(), p = new THREE.Vector3();
  for (let i = 0; i < vertices.length; i += 3) box.expandByPoint(p.fromArray(vertices, i));
  return box.isEmpty() ? box.setFromPoints([p.fromArray(rest)]) : box.translate(p.fromArray(rest));
}

function corners({min, max}) {
  return [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new THREE.Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z));
}

// The fixed blocks that are wider than all that moves. They are drawn in the tone of the page, not of their material: a dark table would
// outweigh the building on it.
export function groundBlocks() {
  const rest = new THREE.Box3(), size = new THREE.Vector3(), own = new THREE.Vector3();
  run.blocks.forEach((block, b) => block[3] || rest.union(boxOf(b)));
  rest.getSize(size);
  const wide = (b) => (boxOf(b).getSize(own), own.x > 1.2 * size.x && own.y > 1.2 * size.y);
  return new Set(rest.isEmpty() ? [] : run.blocks.flatMap((block, b) => (block[3] && wide(b) ? [b] : [])));
}

export class Replay {
  // `table`: the tilting of the run, or null.
  constructor(canvas, motion, table, onPick) {
    this.canvas = canvas, this.motion = motion, this.colour = 'material', this.chosen = -1, this.wanted = false;
    this.table = table, this.tilts = table !== null, this.onDraw = () => {};
    this.ground = groundBlocks();
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true, preserveDrawingBuffer: true});
    this.scene = new THREE.Scene();
    this.model = new THREE.Group();  // turns with the table
    this.scene.add(this.model);
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 1000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.#light();
    this.#addBlocks();
    this.#frameView();
    this.#listen(onPick);
  }

  #light() {
    this.scene.add(new THREE.HemisphereLight('#ffffff', '#8a8378', 2.0));
    this.lamp = new THREE.DirectionalLight('#ffffff', 2.0);
    this.scene.add(this.lamp, this.lamp.target);
  }

  #addBlocks() {
    this.place = run.blocks.map(() => null);
    this.meshes = run.shapes.flatMap((shape, s) => {
      const blocks = run.blocks.flatMap((block, b) => (block[4] === s ? [b] : []));
      if (!shape.index.length || !blocks.length) return [];
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.Float32BufferAttribute(shape.vertices, 3));
      geometry.setIndex(shape.index);
      geometry.computeVertexNormals();
      const mesh = new THREE.InstancedMesh(geometry, new THREE.MeshLambertMaterial(), blocks.length);
      mesh.frustumCulled = false;
      mesh.userData.blocks = blocks;
      blocks.forEach((b, i) => (this.place[b] = {mesh, index: i}));
      this.model.add(mesh);
      return [mesh];
    });
    this.outline = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: '#ff3fd0', depthTest: false}));
    this.outline.visible = false, this.outline.frustumCulled = false;
    this.model.add(this.outline);
  }

  // What a view shows: the corners of the box of all blocks that move, at rest, and of the box in which nearly all of them end, unless
  // that is far away. The middle half of them may end farther away, so that a fall as a whole does not leave the view.
  #frameView() {
    const rest = new THREE.Box3(), end = new THREE.Box3(), {motion} = this, moving = motion.moving.length ? motion.moving : [...run.blocks.keys()];
    let radius = 0;  // m, mean of the blocks
    for (const b of moving) {
      const box = boxOf(b);
      rest.union(box), radius += box.getSize(new THREE.Vector3()).length() / 2 / moving.length;
    }
    const size = rest.getSize(new THREE.Vector3()).length(), out = Math.floor(moving.length / 50);
    const reach = rest.clone().expandByScalar(0.6 * size), far = rest.clone().expandByScalar(10 * size);
    for (let axis = 0; axis < 3; ++axis) {
      const ends = moving.map((b) => motion.poses[motion.at(b, motion.nframe - 1) + axis]).filter(Number.isFinite).sort((a, b) => a - b);
      if (!ends.length) continue;
      const x = 'xyz'[axis], quarter = Math.floor((ends.length - 1) / 4), [low, high] = [ends[quarter], ends[ends.length - 1 - quarter]];
      end.min[x] = Math.max(far.min[x], Math.min(low, Math.max(reach.min[x], ends[out]))) - radius;
      end.max[x] = Math.min(far.max[x], Math.max(high, Math.min(reach.max[x], ends[ends.length - 1 - out]))) + radius;
    }
    this.size = size, this.foot = rest.getCenter(new THREE.Vector3()).setZ(rest.min.z);
    this.seen = this.table ? this.#swept(rest, end) : [rest, end].flatMap((box) => (box.isEmpty() ? [] : corners(box)));
    const box = new THREE.Box3().setFromPoints(this.seen);
    this.middle = box.getCenter(new THREE.Vector3());
    this.radius = Math.max(0.05, box.getSize(new THREE.Vector3()).length() / 2);
    this.camera.near = this.radius / 200, this.camera.far = this.radius * 400;
  }

  // Of a table that tilts: the corners of both boxes and of the table below them as it turns.
  #swept(rest, end) {
    const {table, motion} = this, seen = [], last = run.times.at(-1), below = rest.clone();
    below.min.z = below.max.z = rest.min.z;
    below.expandByVector(new THREE.Vector3(0.2 * this.size, 0.2 * this.size, 0));
    const add = (box, t) => box.isEmpty() || seen.push(...corners(box).map((p) => this.#turn(p, t)));
    for (let f = 0; f < motion.nframe; f += Math.max(1, Math.floor(motion.nframe / 24))) add(rest, run.times[f]), add(below, run.times[f]);
    for (const box of [rest, below]) add(box, table.steepest);
    add(end, last), add(below, last);
    return seen;
  }

  // A point of the scene where the table at time t has taken it. It turns about the middle of the structure's foot.
  #turn(p, t) { return p.sub(this.foot).applyQuaternion(this.table.turn(t)).add(this.foot); }

  // Direction of gravity in the picture: rad from straight down, counter-clockwise; NaN along the view.
  gravityInView() {
    const down = this.tilts ? new THREE.Vector3(0, 0, -1) : this.table.down(this.motion.time);
    down.applyQuaternion(this.camera.quaternion.clone().invert());
    return Math.hypot(down.x, down.y) < 0.2 ? NaN : Math.atan2(down.x, -down.y);
  }

  // Places the camera in the direction `way` from all that is to be seen, as near as its angle of view allows.
  #fit(way) {
    const {camera, controls} = this, right = camera.up.clone().cross(way).normalize(), up = way.clone().cross(right);
    const half = Math.tan((camera.fov * Math.PI) / 360), target = this.middle.clone(), p = new THREE.Vector3();
    let distance = (3 * this.radius) / half;
    for (let round = 0; round < 8; ++round) {  // approaches, and moves the target to the middle of the picture
      const shown = new THREE.Box2(), point = new THREE.Vector2();
      for (const corner of this.seen) {
        p.copy(corner).sub(target);
        const depth = half * (distance - p.dot(way));
        shown.expandByPoint(point.set(p.dot(right) / camera.aspect / depth, p.dot(up) / depth));
      }
      const middle = shown.getCenter(point), size = shown.getSize(new THREE.Vector2());
      target.addScaledVector(right, distance * half * camera.aspect * middle.x).addScaledVector(up, distance * half * middle.y);
      distance = Math.max(distance * 0.58 * Math.max(size.x, size.y), 2 * camera.near);
    }
    controls.target.copy(target);
    camera.position.copy(target).addScaledVector(way, distance);
  }

  // `name`: three quarter, front, side, top, or "scene N" of the scene's own cameras.
  look(name) {
    const own = /^scene (\d+)$/.exec(name), {camera, controls} = this;
    if (own) {
      const given = run.manifest.cameras[Number(own[1])];
      camera.position.set(...given.eye), controls.target.set(...given.target), camera.up.set(...given.up);
      camera.fov = Math.min(100, (given.fov_rad * 180) / Math.PI * Math.max(1, 1.3 / camera.aspect));
    } else {
      const ways = {front: [0, -1, 0.12], side: [1, 0, 0.12], top: [0, -0.01, 1], 'three quarter': [0.75, -1, 0.55]};
      const way = new THREE.Vector3(...ways[name]).normalize();
      // From where a table faces when it leans most: from behind its lower side would be seen.
      const leans = new THREE.Vector3(0, 0, 1).applyQuaternion(this.table?.turn(this.table.steepest) ?? new THREE.Quaternion());
      if (name === 'three quarter' && way.x * leans.x + way.y * leans.y < 0) way.x *= -1, way.y *= -1;
      while (this.table && way.dot(leans) < 0.2) way.z += 0.05, way.normalize();  // or from the side, which is raised above it
      camera.up.set(0, 0, 1), camera.fov = 35;
      this.#fit(way);
    }
    camera.updateProjectionMatrix();
    controls.update();
    this.draw();
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas;
    if (!clientWidth || !clientHeight) return;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  #color(block, frame, out) {
    const [, , material, fixed] = run.blocks[block], {motion, colour} = this;
    if (this.ground.has(block)) return out.set(matchMedia('(prefers-color-scheme: dark)').matches ? '#4a4c50' : '#c9c6bf');
    if (colour === 'material' || fixed) {
      const rgb = run.manifest.materials?.[material]?.color ?? [0.6, 0.6, 0.6];
      out.setRGB(...rgb, THREE.SRGBColorSpace);
      return fixed && colour !== 'material' ? out.setRGB(0.2, 0.2, 0.2) : out.multiplyScalar(fixed ? 1 : shade(block));
    }
    if (colour === 'damage') return scaleColor(motion.blockDamage(block, frame), out);
    return scaleColor(motion[colour](block, frame) / (motion.most[colour] || 1), out);
  }

  // Shows the poses of motion.now; colours by the values of `frame`.
  show(frame) {
    this.shown = frame;
    const matrix = new THREE.Matrix4(), color = new THREE.Color(), one = new THREE.Vector3(1, 1, 1), {now} = this.motion;
    const position = new THREE.Vector3(), rotation = new THREE.Quaternion();
    for (const mesh of this.meshes) {
      mesh.userData.blocks.forEach((b, i) => {
        position.fromArray(now, 7 * b);
        rotation.set(now[7 * b + 4], now[7 * b + 5], now[7 * b + 6], now[7 * b + 3]);
        mesh.setMatrixAt(i, matrix.compose(position, rotation, one));
        if (this.table && this.ground.has(b)) mesh.setMatrixAt(i, this.#plate(b, matrix));
        mesh.setColorAt(i, this.#color(b, frame, color));
      });
      mesh.instanceMatrix.needsUpdate = mesh.instanceColor.needsUpdate = true;
      mesh.boundingSphere = null;  // the blocks have moved
    }
    this.model.quaternion.copy(this.tilts ? this.table.turn(this.motion.time) : new THREE.Quaternion());
    this.model.position.copy(this.foot).sub(this.foot.clone().applyQuaternion(this.model.quaternion));
    this.#placeOutline();
    this.draw();
  }

  // The ground as a plate: a block of its whole thickness hides, when it tilts, what happens on it.
  #plate(block, out) {
    const {min, max} = boxOf(block), flat = Math.min(1, (thin * this.size) / (max.z - min.z || 1)), rest = run.blocks[block].slice(5);
    return out.makeScale(1, 1, flat).setPosition(rest[0], rest[1], max.z - flat * (max.z - rest[2]));
  }

  #placeOutline() {
    if (!this.outline.visible) return;
    const {mesh, index} = this.place[this.chosen];
    mesh.getMatrixAt(index, this.outline.matrix);
    this.outline.matrixAutoUpdate = false;
  }

  choose(block) {
    this.chosen = block;
    this.outline.visible = block >= 0 && this.place[block] !== null;
    if (this.outline.visible) {
      this.outline.geometry.dispose();
      this.outline.geometry = new THREE.EdgesGeometry(this.place[block].mesh.geometry, 1);
    }
    this.#placeOutline();
    this.draw();
  }

  // The block under a point of the canvas, in pixels from its corner; -1 where there is none.
  pick(x, y) {
    const ray = new THREE.Raycaster(), {clientWidth, clientHeight} = this.canvas;
    ray.setFromCamera(new THREE.Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.camera);
    const [hit] = ray.intersectObjects(this.meshes, false);
    return hit ? hit.object.userData.blocks[hit.instanceId] : -1;
  }

  // Turns the view about its target, rad, and changes the distance by a factor.
  turn(aside, up, factor = 1) {
    const {camera, controls} = this, way = camera.position.clone().sub(controls.target);
    const toY = new THREE.Quaternion().setFromUnitVectors(camera.up, new THREE.Vector3(0, 1, 0));
    const s = new THREE.Spherical().setFromVector3(way.applyQuaternion(toY));
    s.theta += aside, s.phi -= up, s.radius *= factor;
    s.makeSafe();
    camera.position.setFromSpherical(s).applyQuaternion(toY.invert()).add(controls.target);
    controls.update();
    this.draw();
  }

  #listen(onPick) {
    let down = null;
    this.canvas.addEventListener('pointerdown', (event) => (down = [event.offsetX, event.offsetY]));
    this.canvas.addEventListener('pointerup', (event) => {
      if (down && Math.hypot(event.offsetX - down[0], event.offsetY - down[1]) < 5) onPick(this.pick(event.offsetX, event.offsetY));
      down = null;
    });
    const keys = {
      ArrowLeft: [-0.1, 0],
      ArrowRight: [0.1, 0],
      ArrowUp: [0, 0.1],
      ArrowDown: [0, -0.1],
      '+': [0, 0, 0.9],
      '=': [0, 0, 0.9],
      '-': [0, 0, 1.1]
    };
    this.canvas.addEventListener('keydown', (event) => {
      if (!keys[event.key] || event.ctrlKey || event.metaKey) return;
      this.turn(...keys[event.key]);
      event.preventDefault();
    });
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  // Draws once before the next repaint, however often it is called.
  draw() {
    if (this.wanted) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      // The light comes over the viewer's left shoulder: each face that is seen is lit.
      this.lamp.position.set(-0.8, 0.7, 0.4).multiplyScalar(this.radius).applyQuaternion(this.camera.quaternion).add(this.camera.position);
      this.lamp.target.position.copy(this.middle);
      this.lamp.target.updateMatrixWorld();
      this.renderer.render(this.scene, this.camera);
      this.onDraw();
    });
  }
}
