// What the page holds: its JSON, and packed numbers (engine/record/report/pack.h says how they are packed).

export const run = JSON.parse(document.getElementById('run').textContent);

async function inflated(id) {
  const text = atob(document.getElementById(id).textContent);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Float32Array [frames][blocks][7]: x, y, z (m), then w, x, y, z of the rotation from rest.
async function posesOf() {
  const bytes = await inflated('poses');
  const nblock = run.blocks.length, nframe = run.times.length, head = 24 * nblock, count = 7 * nblock * nframe;
  const scale = new DataView(bytes.buffer, 0, head);
  const poses = new Float32Array(count);
  for (let part = 0, at = head; part < 7; ++part) {
    for (let b = 0; b < nblock; ++b) {
      const place = part < 3;
      const low = place ? scale.getFloat32(24 * b + 4 * part, true) : 0;
      const step = place ? scale.getFloat32(24 * b + 12 + 4 * part, true) : run.rotation_step;
      for (let f = 0, sum = 0; f < nframe; ++f, ++at) {
        sum = (sum + bytes[at] + 256 * bytes[at + count]) & 65535;
        poses[7 * (f * nblock + b) + part] = low + step * (place || sum < 32768 ? sum : sum - 65536);
      }
    }
  }
  return poses;
}

// Uint8Array [joints][frames]
async function damageOf() {
  const bytes = await inflated('damage'), nframe = run.times.length;
  for (let i = 0; i < bytes.length; ++i)
    if (i % nframe) bytes[i] += bytes[i - 1];
  return bytes;
}

// {names, columns}: NaN becomes null, which a curve leaves out.
async function tableOf(id) {
  const bytes = await inflated(id), {names, rows} = run[id], count = names.length * rows;
  const joined = new Uint8Array(4 * count);
  for (let weight = 0; weight < 4; ++weight)
    for (let i = 0; i < count; ++i) joined[4 * i + weight] = bytes[weight * count + i];
  const values = new Float32Array(joined.buffer);
  const columns = names.map((_, c) => Array.from(values.subarray(c * rows, (c + 1) * rows), (v) => (Number.isFinite(v) ? v : null)));
  return {names, columns};
}

export async function unpack() {
  const [poses, damage, histories, energy] = await Promise.all([posesOf(), damageOf(), tableOf('histories'), tableOf('energy')]);
  return {poses, damage, histories, energy};
}

// A push has states of equilibrium in place of times: the i-th of them stands at i * frame_dt. What follows is the fall under the least
// load without equilibrium. null for any other run.
export const push = run.push && {...run.push, states: run.push.multipliers.length, step: run.manifest.frame_dt_s || 1};

// "0.280 g", "tangent 0.280" or "0.280 of the load pattern".
export function multiplierText(value) {
  return push.unit === 'tan' ? `tangent ${short(value)}` : push.unit === 'g' ? `${short(value)} g` : `${short(value)} of the load pattern`;
}

// How a time (s) of the run is told.
export function momentText(t, digits = 3) {
  if (!push) return `${t.toFixed(digits)} s`;
  const last = push.states - 1, state = Math.round(t / push.step);
  return state > last ? `fall + ${(t - last * push.step).toFixed(2)} s` : `state ${state} of ${last}: ${multiplierText(push.multipliers[state])}`;
}

// Where a time stands on the axes of curves: its state, or the time itself.
export const axisOf = (t) => (push ? t / push.step : t);
export const axisName = !push ? 'time [s]' : run.times.at(-1) > (push.states - 0.5) * push.step ? `state [-]; the fall from state ${push.states} on` : 'state [-]';

// What happens to the structure, not to one joint: engine/record/report/report.cpp keeps all of these.
export const rareEvent = (event) => ['collapse', 'fall', 'hinge', 'slide', 'part'].includes(event[1]);

// 0.01234 -> "12.3 mm"; other units stay as they are.
export function withUnit(value, unit) {
  if (value === null || value === undefined) return '';
  if (typeof value !== 'number') return String(value);
  if (unit === 'm' && value !== 0 && Math.abs(value) < 0.1) return `${short(1000 * value)} mm`;
  return `${short(value)} ${unitName(unit)}`.trim();
}

export function short(value) {
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2).replace('e+', 'e');
  return String(Number(value.toPrecision(4)));
}

export function unitName(unit) {
  return (unit || '')
      .replace(/m_s2|m\/s2/, 'm/s²')
      .replace(/_/g, '/')
      .replace(/\b(k?g|m)([23])\b/g, (_, u, n) => u + (n === '2' ? '²' : '³'));
}
