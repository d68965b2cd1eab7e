// The first cards of the page of a push: what the structure bears, how well its states balance, and what they cost.
import {multiplierText, push, run, short, withUnit} from './data.js';
import {card} from './text.js';

const percent = (share) => `${short(100 * share)} %`;

// "0.28 g", or why there is none.
function limitText(limit) {
  if (!limit.stands) return 'does not stand';
  if (limit.lower === null) return 'no mechanism';
  return multiplierText((limit.lower + limit.upper) / 2) + (limit.converged ? '' : ' (not converged)');
}

// How the push ended.
function endOf(capacity, completed) {
  if (typeof capacity.upper === 'number') return `No equilibrium at ${multiplierText(capacity.upper)}`;
  if (!completed) return 'The push did not end; this is the largest load so far';
  if (capacity.past_peak) return 'The load falls again beyond this peak of the curve';
  const controlled = run.manifest.settings?.push?.control?.value === 'displacement';
  return controlled ? 'The load still rises at the largest displacement asked for' : 'The structure stands up to the largest load asked for';
}

function shearText(capacity) {
  const share = capacity.base_shear_over_weight;
  return typeof share === 'number' ? `${percent(share)} of the weight` : withUnit(capacity.base_shear_N, 'N');
}

function verdict(metrics) {
  const {capacity} = metrics, completed = metrics.status === 'completed', ended = completed ? '' : ` (run ${metrics.status})`;
  if (capacity.gravity_alone) return card('bad', 'Verdict', `Does not stand under ${metrics.collapse?.under ?? 'its own weight'}${ended}`, []);
  const tilts = capacity.kind === 'tilt';
  const lead = tilts ? `Stands up to a tilt of ${short(capacity.angle_deg)}°` : `Bears ${multiplierText(capacity.multiplier)}`;
  const lines = [endOf(capacity, completed)];
  if (capacity.mechanism_text) lines.push(`Mechanism: ${capacity.mechanism_text}`);
  const walls = Object.entries(capacity.walls ?? {}).map(([group, does]) => `${group}: ${does}`);
  if (walls.length) lines.push(`Walls: ${walls.join('; ')}`);
  lines.push(
      `At that load: displacement ${withUnit(capacity.displacement_m, 'm')}, base shear ${shearText(capacity)}, ` +
      `joints opened: ${capacity.joints_opened}, slid: ${capacity.joints_slid}`);
  lines.push(`${metrics.joints_broken} of ${metrics.joints} joints broken; ${metrics.blocks} blocks`);
  const checks = metrics.expectations ?? {};
  if (checks.passed + checks.failed) lines.push(`Expectations of the scene: ${checks.passed} met, ${checks.failed} not`);
  return card(completed ? 'good' : 'warn', 'Verdict', lead + ended, lines);
}

function trust(metrics) {
  const {capacity} = metrics, bad = ['diverged', 'inaccurate'].includes(metrics.status), lines = [];
  lines.push(`Mean unbalanced force at most ${short(capacity.unbalanced_relative)} of the mean applied force in any state`);
  if (typeof capacity.upper === 'number' && capacity.upper > 0)
    lines.push(`The largest load is known to ${percent((capacity.upper - capacity.multiplier) / capacity.upper)}`);
  const {dry, bonded} = capacity.limit ?? {};
  if (dry) lines.push(`Limit analysis without bond: ${limitText(dry)}`);
  if (typeof dry?.smooth_uprights === 'number')
    lines.push(`The same without friction of upright joints, which nothing need press at rest: ${multiplierText(dry.smooth_uprights)}`);
  if (bonded) lines.push(`Limit analysis with bond, as if ductile: ${limitText(bonded)}`);
  if (!dry) lines.push('No limit analysis beside it');
  return card(bad ? 'bad' : 'good', 'Trust', bad ? 'With care: the numbers did not hold' : 'All states shown are in equilibrium', lines);
}

function cost(manifest, metrics) {
  const {capacity} = metrics;
  const lines = [
    `Gravity ${short(Math.hypot(...manifest.gravity_m_s2))} m/s²`, `${capacity.attempts} loads tried`,
    `${capacity.relaxation_steps} steps of relaxation in ${short(metrics.wall_s?.total ?? 0)} s of wall clock`
  ];
  const fall = run.times.filter((t) => t > (push.states - 0.5) * push.step).length;
  lines.push(`${run.times.length} frames shown${run.every > 1 ? `, each ${run.every}th of the run and the last` : ''}${fall ? `, ${fall} of them of the fall` : ''}`);
  return card('', 'Run', `${capacity.kind === 'tilt' ? 'Tilt' : 'Push'} by ${capacity.states} states of equilibrium`, lines);
}

export function pushCards(manifest, metrics) {
  if (!metrics?.capacity)
    return [card(
        'warn', 'Verdict', 'No result',
        [`The push did not end: ${push.states} states of equilibrium were found, the last at ${multiplierText(push.multipliers.at(-1))}.`])];
  return [verdict(metrics), trust(metrics), cost(manifest, metrics)];
}
