// The page of erbs report: ties replay, curves and texts to one time.
import './page.css';
import {momentText, rareEvent, run, short, unpack, withUnit} from './data.js';
import {Curves, plotOf} from './curves.js';
import {Motion} from './motion.js';
import {groundBlocks, materialCss, Replay, scaleCss} from './replay.js';
import {Table} from './table.js';
import {make, showTexts, table} from './text.js';

const at = (id) => document.getElementById(id);
const first = run.times[0], last = run.times.at(-1);
let time = first, playing = false, motion = null, replay = null, curves = null, blockCurve = null, tilting = null, chosen = -1, before = 0;

function setTime(t) {
  time = Math.min(last, Math.max(first, t));
  const frame = motion.setTime(time);
  replay?.show(frame);
  curves?.redraw();
  blockCurve?.plot.redraw(false);
  at('scrub').value = time;
  const tilt = tilting ? `, tilt ${((tilting.angle(time) * 180) / Math.PI).toFixed(1)}°` : '';
  at('scrub').setAttribute('aria-valuetext', `${momentText(time, 2)} of ${momentText(last, 2)}${tilt}`);
  at('clock').textContent = momentText(time) + tilt;
  showJoints(frame);
}

function play(on) {
  playing = on;
  at('play').textContent = on ? 'Pause' : 'Play';
  at('play').setAttribute('aria-pressed', String(on));
  if (!on) return;
  if (time >= last) setTime(first);
  before = performance.now();
  requestAnimationFrame(tick);
}

function tick(now) {
  if (!playing) return;
  setTime(time + (Number(at('speed').value) * (now - before)) / 1000);
  before = now;
  if (time >= last)
    play(false);
  else
    requestAnimationFrame(tick);
}

function step(frames) {
  play(false);
  setTime(run.times[Math.min(run.times.length - 1, Math.max(0, motion.frame(time + 1e-9) + frames))]);
}

function toEvent(way) {
  const times = run.events.filter(rareEvent).map((event) => event[0]).sort((a, b) => a - b);
  const all = times.length ? times : run.events.map((event) => event[0]);
  const next = way > 0 ? all.find((t) => t > time + 1e-6) : all.findLast((t) => t < time - 1e-6);
  play(false);
  setTime(next ?? (way > 0 ? last : first));
}

function showLegend() {
  const colour = at('colour').value, legend = at('legend');
  if (colour === 'material') {
    const ground = groundBlocks(), used = [...new Set(run.blocks.filter((block, b) => !ground.has(b)).map((block) => block[2]))];
    return legend.replaceChildren(...used.flatMap((m) => {
      const dot = make('span', '', {class: 'dot'});
      dot.style.background = materialCss(m);
      return [dot, run.manifest.materials?.[m]?.name ?? 'no material'];
    }));
  }
  const bar = make('span', '', {class: 'bar'}), unit = {displacement: 'm', speed: 'm/s'}[colour];
  bar.style.background = scaleCss;
  const most = colour === 'damage' ? 'broken' : withUnit(motion.most[colour], unit);
  const what = {damage: 'mean damage of its joints', displacement: 'displacement from rest', speed: 'speed'}[colour];
  legend.replaceChildren(`${what}: ${colour === 'damage' ? 'intact' : '0'}`, bar, most);
}

function showJoints(frame) {
  const holder = at('block-joints');
  if (chosen < 0) return holder.replaceChildren();
  const rows = motion.jointsOf[chosen].map((joint) => {
    const [a, b] = run.joints[joint];
    return [run.blocks[a === chosen ? b : a][0], `${short(100 * motion.jointDamage(joint, frame))} %`];
  });
  holder.replaceChildren(rows.length ? table('Joints of this block at the time shown', ['Joint with', 'Damage'], rows) : '');
}

function choose(block) {
  chosen = block;
  at('block').value = block;
  replay?.choose(block);
  blockCurve?.remove();
  blockCurve = null;
  const facts = at('block-facts');
  at('block-title').textContent = block < 0 ? 'No block chosen' : run.blocks[block][0];
  if (block < 0) {
    facts.textContent = 'Click a block of the replay, or choose it here.';
    return showJoints(0);
  }
  const [, group, material, fixed, , x, y, z] = run.blocks[block];
  const most = Math.max(...run.times.map((_, f) => motion.displacement(block, f)));
  facts.textContent =
      `Group ${group || 'none'}; material ${run.manifest.materials?.[material]?.name ?? 'none'}; ${fixed ? 'fixed; ' : ''}` +
      `centroid at rest (${short(x)}, ${short(y)}, ${short(z)}) m; moves at most ${withUnit(most, 'm')}.`;
  const axes = ['x', 'y', 'z'].map((name, i) => ({label: name, values: run.times.map((_, f) => motion.displacement(block, f, i))}));
  const factor = most < 0.1 ? 1000 : 1;
  for (const axis of axes) axis.values = axis.values.map((v) => factor * v);
  blockCurve = plotOf(at('block-curve'), run.times, axes, factor === 1 ? 'm' : 'mm', () => time, 230);
  at('block-curve').setAttribute('aria-label', `Displacement of ${run.blocks[block][0]}: at most ${withUnit(most, 'm')}`);
  showJoints(motion.frame(time));
}

function fillControls() {
  const groups = new Map();
  run.blocks.forEach((block, b) => {
    if (!groups.has(block[1])) groups.set(block[1], make('optgroup', '', {label: block[1] || 'no group'}));
    groups.get(block[1]).append(make('option', block[0], {value: b}));
  });
  at('block').append(...groups.values());
  for (const view of ['three quarter', 'front', 'side', 'top']) at('camera').add(new Option(view, view));
  (run.manifest.cameras ?? []).forEach((camera, i) => at('camera').add(new Option(`${camera.name} (scene)`, `scene ${i}`)));
  Object.assign(at('scrub'), {min: first, max: last, step: Math.max(1e-4, (last - first) / 2000)});
  const span = last - first || 1, seen = new Set();
  for (const event of run.events) {
    const share = (event[0] - first) / span, key = `${rareEvent(event)} ${share.toFixed(3)}`;
    if (share < 0 || share > 1 || seen.has(key)) continue;
    seen.add(key);
    const tickMark = make('i', '', {class: rareEvent(event) ? 'rare' : '', title: `${event[1]} ${event[2] ?? ''}`});
    tickMark.style.left = `${100 * share}%`;
    at('ticks').append(tickMark);
  }
}

function listen() {
  at('scrub').addEventListener('input', () => (play(false), setTime(Number(at('scrub').value))));
  at('play').addEventListener('click', () => play(!playing));
  at('back').addEventListener('click', () => toEvent(-1));
  at('next').addEventListener('click', () => toEvent(1));
  at('block').addEventListener('change', () => choose(Number(at('block').value)));
  at('camera').addEventListener('change', () => replay?.look(at('camera').value));
  at('colour').addEventListener('change', () => {
    if (replay) replay.colour = at('colour').value;
    setTime(time);
    showLegend();
  });
  at('view').addEventListener('keydown', (event) => {
    if (event.key === ' ')
      play(!playing);
    else if (event.key === ',')
      step(-1);
    else if (event.key === '.')
      step(1);
    else
      return;
    event.preventDefault();
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => (curves?.show(), choose(chosen)));
}

// Of a test that tilts: whether the table turns or the camera stays level with it, and an arrow along gravity.
function listenToTable() {
  at('table').hidden = at('gravity').hidden = false;
  at('tilts').addEventListener('change', () => (replay.tilts = at('tilts').checked, setTime(time)));
  replay.onDraw = () => {
    const lean = replay.gravityInView();
    at('gravity').hidden = Number.isNaN(lean);
    at('gravity').firstElementChild.style.transform = `rotate(${-lean}rad)`;
  };
}

async function start() {
  showTexts((t) => (play(false), setTime(t), at('replay').scrollIntoView({block: 'start'})));
  const data = await unpack();
  motion = new Motion(data.poses, data.damage);
  tilting = Table.of(data.histories);
  fillControls();
  try {
    replay = new Replay(at('view'), motion, tilting, choose);
    if (tilting) listenToTable();
    replay.resize();
    replay.look(at('camera').value);
  } catch (reason) {
    at('view-note').textContent =
        `The replay needs WebGL, which this browser does not offer (${reason.message}). Curves and tables work without it.`;
    at('view-note').hidden = false;
    at('view').hidden = true;
  }
  curves = new Curves(data, () => time);
  listen();
  setTime(first);
  showLegend();
  document.documentElement.dataset.ready = 'yes';
}

start().catch((reason) => {
  at('view-note').textContent = `The page could not read its data: ${reason.message}. A browser of 2023 or later is needed.`;
  at('view-note').hidden = false;
  console.error(reason);
});
