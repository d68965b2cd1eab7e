// Curves over time, with events and the time of the replay: drag to zoom, double click for the whole run.
import 'uplot/dist/uPlot.min.css';

import uPlot from 'uplot';

import {axisName, axisOf, push, rareEvent, run, short, unitName} from './data.js';

const at = (id) => document.getElementById(id);
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
// Eight colours told apart with any colour vision (Okabe and Ito 2008), without yellow and black; then dashes.
const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#56b4e9', '#e69f00'];
const units = {
  m_s2: 'acceleration',
  m_s: 'velocity',
  m: 'displacement',
  N: 'force',
  J: 'energy',
  Nm: 'moment',
  rad: 'rotation',
  rad_s: 'angular velocity',
  Pa: 'stress',
  J_m2: 'energy of an area',
  kg: 'mass',
  s: 'time',
  relative: 'share'
};

export function unitOf(column) {
  return Object.keys(units).filter((unit) => column.endsWith(`_${unit}`)).sort((a, b) => b.length - a.length)[0] ?? '';
}

const label = (column, unit) => (unit ? column.slice(0, -unit.length - 1) : column).replace(/_/g, ' ');

// Vertical lines: rare events, and the time of the replay.
function marks(time) {
  return {
    hooks: {
      draw: (plot) => {
        const {ctx, bbox} = plot, line = (t, colour, width) => {
          const x = plot.valToPos(axisOf(t), 'x', true);
          if (x < bbox.left || x > bbox.left + bbox.width) return;
          ctx.save();
          ctx.strokeStyle = colour, ctx.lineWidth = width * devicePixelRatio;
          ctx.setLineDash([]);
          ctx.beginPath(), ctx.moveTo(x, bbox.top), ctx.lineTo(x, bbox.top + bbox.height), ctx.stroke();
          ctx.restore();
        };
        const bad = css('--bad'), seen = new Set();
        for (const event of run.events) {
          const fell = event[1] === 'collapse', x = Math.round(plot.valToPos(axisOf(event[0]), 'x') / 4);
          if (!rareEvent(event) || (!fell && seen.has(x))) continue;  // one line for all events of four pixels
          seen.add(x);
          line(event[0], `${bad}${fell ? 'ff' : '40'}`, fell ? 2 : 1);
        }
        line(time(), css('--accent'), 2);
      }
    }
  };
}

// A plot that fills `holder`. `series`: [{label, values}] over the times `x` (s); `time` gives the time of the replay.
export function plotOf(holder, x, series, unit, time, height) {
  const ink = css('--ink'), grid = {stroke: css('--line'), width: 1};
  const axis = {stroke: ink, grid, ticks: grid, font: '13px system-ui, sans-serif', labelFont: '13px system-ui, sans-serif'};
  const value = (_, v) => (v === null || v === undefined ? '–' : short(v));
  const plot =
      new uPlot(
          {
            width: Math.max(200, holder.clientWidth),
            height,
            plugins: [marks(time)],
            cursor: {drag: {x: true, y: false}},
            scales: {x: {time: false}},
            axes: [
              {...axis, label: axisName},
              {...axis, label: unit ? `[${unitName(unit)}]` : '', size: 72, values: (_, all) => all.map(short)}
            ],
            series:
                [
                  {label: axisName, value}, ...series.map((one, i) => ({
                                                              label: one.label,
                                                              stroke: colours[i % colours.length],
                                                              width: 1.5,
                                                              value,
                                                              points: {show: false},
                                                              dash: i < colours.length ? undefined : [6, 3]
                                                            }))
                ],
          },
          [x.map(axisOf), ...series.map((one) => one.values)], holder);
  const watch = new ResizeObserver(() => plot.setSize({width: Math.max(200, holder.clientWidth), height}));
  watch.observe(holder);
  return {plot, remove: () => (watch.disconnect(), plot.destroy())};
}

// The columns of both tables by unit: [{name, unit, x, series}].
function quantities({histories, energy}) {
  const groups = new Map();
  for (const [table, where] of [[histories, 'recorders'], [energy, 'ledger']])
    table.names.forEach((column, c) => {
      if (c === 0 || table.columns[0].length < 2) return;  // the time; a run killed before its first rows were written
      const unit = unitOf(column), ground = column.startsWith('ground_') ? 'ground ' : '';
      const name = where === 'ledger' ? (unit === 'J' ? 'energy' : 'energy residual, share') : `${ground}${units[unit] ?? 'other'}`;
      if (!groups.has(name)) groups.set(name, {name, unit: unit === 'relative' ? '' : unit, x: table.columns[0], series: []});
      groups.get(name).series.push({label: label(column, unit), values: table.columns[c]});
    });
  return [...groups.values()].sort((a, b) => a.name.startsWith('ground') - b.name.startsWith('ground'));
}

export class Curves {
  constructor(tables, time) {
    this.time = time, this.groups = quantities(tables), this.shown = null;
    const select = at('quantity');
    this.groups.forEach((group, i) => select.add(new Option(`${group.name}${group.unit ? ` [${unitName(group.unit)}]` : ''}`, i)));
    if (!this.groups.length) return void (at('curves-note').textContent = 'The run holds no curves: it has no rows in histories.csv.');
    select.addEventListener('change', () => this.show());
    for (const [id, factor] of [['zoom-in', 0.5], ['zoom-out', 2], ['zoom-all', Infinity]])
      at(id).addEventListener('click', () => this.zoom(factor));
    const rows = tables.histories.columns[0]?.length ?? 0;
    at('curves-note').textContent = 'Drag to zoom, double-click for the whole run; a name in the legend switches its curve. ' +
        `Red lines are events (collapse bold), the blue line is the ${push ? 'state' : 'time'} of the replay.` +
        (run.history_rows > rows ?
             ` Of ${run.history_rows} rows, those with the extremes of each ${Math.ceil((2 * run.history_rows) / rows)} are drawn.` :
             '');
    this.show();
  }

  show() {
    const group = this.groups[Number(at('quantity').value)];
    if (!group) return;
    this.shown?.remove();
    this.shown = plotOf(
        at('curves'), group.x, group.series, group.unit, this.time,
        window.innerWidth < 600 ? 280 : Math.max(340, window.innerHeight * 0.4));
    at('curves').setAttribute(
        'aria-label',
        `${group.name} over ${push ? 'the states' : 'time'}: ${
            group.series
                .map(
                    (one) => `${one.label}, largest ${short(one.values.reduce((most, v) => Math.max(most, Math.abs(v ?? 0)), 0))} ${
                        unitName(group.unit)}`)
                .join('; ')}`);
  }

  // About the time of the replay where it is in view, otherwise about the middle.
  zoom(factor) {
    const {plot} = this.shown, x = plot.data[0], {min, max} = plot.scales.x, now = axisOf(this.time());
    const middle = now > min && now < max ? now : (min + max) / 2, half = (factor * (max - min)) / 2;
    plot.setScale('x', {min: Math.max(x[0], middle - half), max: Math.min(x.at(-1), middle + half)});
  }

  redraw() {
    this.shown?.plot.redraw(false);
  }
}
