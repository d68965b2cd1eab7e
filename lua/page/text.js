// The parts of the page that are read: verdict, trust, events, parameters, effects, provenance.
import {momentText, push, rareEvent, run, short, unitName, withUnit} from './data.js';
import {pushCards} from './push.js';

const at = (id) => document.getElementById(id);

// An element with text or children. Texts of the run enter as text only, never as HTML.
export function make(tag, content, attributes = {}) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...(Array.isArray(content) ? content : [content ?? '']));
  return element;
}

export function table(caption, head, rows) {
  const body = rows.map((row) => make('tr', row.map((cell, i) => (i === 0 ? make('th', cell, {scope: 'row'}) : make('td', cell)))));
  return make(
      'table',
      [make('caption', caption), make('thead', make('tr', head.map((name) => make('th', name, {scope: 'col'})))), make('tbody', body)]);
}

export function card(kind, heading, lead, lines) {
  return make(
      'section', [make('p', heading, {class: 'quiet'}), make('strong', lead), make('ul', lines.map((line) => make('li', line)))],
      {class: `card ${kind}`, 'aria-label': heading});
}

function verdictCard(metrics) {
  if (!metrics)
    return card(
        'warn', 'Verdict', 'No result', ['The run did not end: its folder has no metrics.json. The frames written until then are shown.']);
  const {collapse = {}} = metrics, lines = [];
  const diverged = metrics.status === 'diverged', ended = ['completed', 'inaccurate'].includes(metrics.status);
  const moving = collapse.moving_fraction > 0;
  if (collapse.course) lines.push(`Course: ${collapse.course}`);
  if (collapse.mechanism?.summary && !diverged) lines.push(`Mechanism: ${collapse.mechanism.summary}`);
  if (collapse.fallen_fraction !== undefined) lines.push(`${short(100 * collapse.fallen_fraction)} % of the mass has fallen by the end`);
  if (moving) lines.push(`${short(100 * collapse.moving_fraction)} % of it still moves at the end`);
  lines.push(`${metrics.joints_broken} of ${metrics.joints} joints broken; ${metrics.blocks} blocks`);
  const checks = metrics.expectations ?? {};
  if (checks.passed + checks.failed) lines.push(`Expectations of the scene: ${checks.passed} met, ${checks.failed} not`);
  const how = metrics.status === 'completed' ? '' : ` (run ${metrics.status})`;
  // A push, and what does not stand under its own weight, have no time of collapse. What has not come to its end may still collapse.
  const stands = !ended ? 'No collapse so far' : moving ? 'No collapse by the end' : 'Does not collapse';
  const lead = !collapse.collapsed ? (diverged ? 'No verdict' : stands) :
      run.collapse_when            ? `Collapses ${run.collapse_when}` :
      collapse.under_gravity       ? `Does not stand under ${collapse.under ?? 'its own weight'}` :
                                     'Collapses';
  const kind = collapse.collapsed ? 'bad' : metrics.status === 'completed' && !moving ? 'good' : 'warn';
  return card(kind, 'Verdict', lead + how, lines);
}

function trustCard(metrics) {
  if (!metrics?.trust) return card('warn', 'Trust', 'Unknown', ['The run left no figures by which to judge it.']);
  const t = metrics.trust, percent = (share) => `${short(100 * share)} %`, warned = t.warned_share > 0;
  const bad = ['diverged', 'inaccurate'].includes(metrics.status) || t.past_gate_share > 0;
  const lead = bad ? 'With care: the numbers did not hold' :
      warned       ? `Energy accounted for; ${percent(t.warned_share)} of steps with a warning` :
                     'Energy accounted for, no warnings';
  const lines = [
    `Largest energy residual ${short(t.energy_residual)} of all energy, at ${short(t.energy_residual_time_s ?? 0)} s`,
    `Penetration at most ${percent(t.max_penetration_relative)} of a block's smallest edge`,
    ...(t.dt_margin > 0 ? [`Time step at most ${short(t.dt_margin)} of its limit`] : bad ? [] : ['Nothing limits the time step']),
    `Inner forces balance but for ${short(t.momentum_residual ?? 0)} of their sum`
  ];
  if (t.sinking_share > 0) lines.push(`Deepening penetration in ${percent(t.sinking_share)} of steps`);
  if (t.past_step_share > 0) lines.push(`Time step above its limit in ${percent(t.past_step_share)} of steps`);
  lines.push(
      t.twin ? (t.chaos_horizon_s === null ? 'A perturbed twin stayed within 1 mm' :
                                             `A perturbed twin differs by 1 mm from ${short(t.chaos_horizon_s)} s on`) :
                                             ['No perturbed twin was run; ', make('code', 'erbs run --twin'), ' tells how long single blocks can be foreseen']);
  return card(bad ? 'bad' : warned ? 'warn' : 'good', 'Trust', lead, lines);
}

function costCard(manifest, metrics) {
  const lines = [`Gravity ${short(Math.hypot(...manifest.gravity_m_s2))} m/s² at rest`, `Time step ${short(manifest.dt_s)} s`];
  if (metrics) lines.push(`${metrics.steps} steps in ${short(metrics.wall_s?.total ?? 0)} s of wall clock`);
  lines.push(`${run.times.length} frames shown${run.every > 1 ? `, each ${run.every}th of the run and the last` : ''}`);
  return card('', 'Run', `${short(metrics?.time_s ?? run.times.at(-1))} s of ${short(manifest.duration_s)} s simulated`, lines);
}

// The metrics that the scene defines, folded away.
function figures(metrics) {
  const own = Object.entries(metrics?.metrics ?? {});
  if (!own.length) return [];
  const units = Object.fromEntries((run.manifest.metrics ?? []).map((m) => [m.name, m.unit]));
  const lines = own.map(([name, value]) => `${name}: ${withUnit(typeof value === 'object' ? JSON.stringify(value) : value, units[name])}`);
  return [make('details', [make('summary', `${own.length} figure${own.length === 1 ? '' : 's'} of the scene`), make('ul', lines.map((line) => make('li', line)))])];
}

function showParameters() {
  const rows = (run.manifest.params ?? []).map((p) => {
    const marks = [];
    if (/assum|guess|estimat/i.test(p.text)) marks.push(make('span', 'assumed', {class: 'mark'}), ' ');
    if (p.value !== p.default) marks.push(make('span', `changed from ${withUnit(p.default, p.unit)}`, {class: 'mark'}));
    return [p.name, withUnit(p.value, p.unit), p.text, marks];
  });
  for (const m of run.manifest.materials ?? [])
    rows.push([
      `material ${m.name}`, `${short(m.density_kg_m3)} kg/m³`,
      `friction ${short(m.friction)}, restitution ${short(m.restitution)}, ` +
          `normal stiffness ${short(m.kn_Pa_m)} Pa/m, shear stiffness ${short(m.ks_Pa_m)} Pa/m`,
      []
    ]);
  at('parameters')
      .append(table(
          'Values the scene was run with. All others stand in manifest.json with their units.', ['Name', 'Value', 'Meaning', 'Mark'],
          rows));
}

function showEffects() {
  const {on = [], off = []} = run.manifest.effects ?? {};
  for (const [name, list] of [['On', on], ['Off', off]])
    at('effects').append(make('div', [
      make('h3', `${name} (${list.length})`),
      make('ul', list.map((effect) => make('li', `${name === 'On' ? '✓' : '–'} ${effect.replace(/\([^()]*\//, '(')}`)), {class: 'plain'})
    ]));
}

function showProvenance() {
  const m = run.manifest;
  const rows = [
    ['Program', `ERBS ${m.version}`], ['Commit', m.git_hash], ['Compiler', m.compiler], ['Instructions', m.isa],
    ['Threads', String(m.threads)], ['Started', m.started], ['Scene', `${m.scene.name}, hash ${m.scene.hash}`]
  ];
  for (const [path, hash] of Object.entries(m.inputs ?? {})) rows.push([`Input ${path.split('/').pop()}`, `${path}, hash ${hash}`]);
  if (run.metrics?.state_hash) rows.push(['State at the end', `hash ${run.metrics.state_hash}`]);
  for (const departure of m.departures ?? [])
    rows.push(['Departure', typeof departure === 'string' ? departure : JSON.stringify(departure)]);
  rows.push(['Time step', `${short(m.dt_s)} s: ${m.dt_rule}`]);
  at('provenance').append(table('By which program and from which files the run was made.', ['What', 'Value'], rows));
  const folder = run.folder.split('/').map(encodeURIComponent).join('/');
  at('files').append(
      'Files of the run: ', ...run.files.flatMap((name, i) => [i ? ', ' : '', make('a', name, {href: `${folder}/${name}`})]));
}

const mostRows = 300;

function showEvents(kind, goTo) {
  const chosen = run.events.filter((e) => (kind === 'rare' ? rareEvent(e) : kind === 'all' || e[1] === kind));
  const rows = chosen.slice(0, mostRows).map((e) => {
    const moment = push ? momentText(e[0]) : `${short(e[0])} s`;
    const button = make('button', moment, {type: 'button', 'aria-label': `Go to ${moment}`});
    button.addEventListener('click', () => goTo(e[0]));
    return [button, String(e[1]), String(e[2] ?? ''), withUnit(e[3], e[4])];
  });
  const more = chosen.length > mostRows ? ` The first ${mostRows} are listed; events.csv holds all.` : '';
  const name = push ? 'State' : 'Time', caption = `${chosen.length} event${chosen.length === 1 ? '' : 's'}. The ${name.toLowerCase()} moves the replay there.${more}`;
  if (!rows.length) return at('events').replaceChildren(make('p', 'The run recorded no events.', {class: 'quiet'}));
  at('events').replaceChildren(table(caption, [name, 'Event', 'Where', 'Value'], rows));
}

export function showTexts(goTo) {
  const {manifest, metrics} = run;
  at('scene-name').textContent = `Scene ${manifest.scene.name}`;
  const cards = push ? pushCards(manifest, metrics) : [verdictCard(metrics), trustCard(metrics), costCard(manifest, metrics)];
  cards.at(-1).append(...figures(metrics));
  at('verdict').append(...cards);
  showParameters();
  showEffects();
  showProvenance();
  const kinds = [...new Set(run.events.map((e) => e[1]))];
  const select = at('event-kind'), rare = run.events.some(rareEvent);
  if (rare) select.append(make('option', 'falls and collapse', {value: 'rare'}));
  select.append(make('option', 'all', {value: 'all'}), ...kinds.map((kind) => make('option', kind, {value: kind})));
  select.addEventListener('change', () => showEvents(select.value, goTo));
  showEvents(select.value, goTo);
}
