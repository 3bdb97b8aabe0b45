// SPDX-License-Identifier: GPL-2.0-or-later
// Ground motion and storey drifts over time, with a cursor; a click goes to that time.
import { element, svg } from "./dom.js";
import { rowAt } from "./run.js";
import { either, storeyName, tr, translated } from "./texts.js";

/** Okabe and Ito (2008) */
export const COLORS = { ns: "#0072b2", ew: "#d55e00", ud: "#8a8a8a" };
const NAMES = { ns: "N–S", ew: "E–W", ud: "up–down" };
const MOST_DRIFT = 1 / 5; // larger drifts, of a falling house, are drawn at the border
const LEFT = 42; // width of the labels [pixel]
const AXIS = 14; // height of the labels of the time axis [pixel]
const LABEL_GAP = 12; // between the baselines of two labels [pixel]
const DRAG = 6; // sideways movement that makes a touch a drag [pixel]
const [INK, PALE] = ["#39424a", "#d9d5cb"];
const FONT = "11px system-ui, sans-serif";

/** The curves of a run in an element of the page. scales: from `largest`; seek: called with a time. */
export class Curves {
  constructor(place, run, scales, seek) {
    Object.assign(this, { place, run });
    const storeys = [...new Set(run.info.drifts.map(({ storey }) => storey))];
    this.charts = [...(run.info.motion ? [motionChart(run, scales.acceleration)] : []), ...storeys.map((storey) => driftChart(run, scales.drifts, storey))];
    if (this.charts.length) this.charts.at(-1).axis = AXIS;
    for (const chart of this.charts) place.append(this.figure(chart));
    this.cursor = element("div", { className: "cursor" });
    place.append(this.cursor);
    this.listen(seek);
  }

  figure(chart) {
    chart.canvas = element("canvas", { role: "img" });
    const caption = element("figcaption");
    translated(() => {
      caption.replaceChildren(...chart.caption());
      chart.canvas.ariaLabel = chart.description();
    });
    return element("figure", { className: chart.name }, caption, chart.canvas);
  }

  listen(seek) {
    const go = (event) => {
      const { left, width } = this.place.getBoundingClientRect();
      seek(Math.min(Math.max((event.clientX - left - LEFT) / (width - LEFT), 0), 1) * (this.span - this.first) + this.first);
    };
    let start = null; // of a touch that may yet become a scroll
    this.place.addEventListener("pointerdown", (event) => {
      if (event.pointerType === "touch") start = event.clientX;
      else {
        this.place.setPointerCapture(event.pointerId);
        go(event);
      }
    });
    this.place.addEventListener("pointermove", (event) => {
      if (start !== null && Math.abs(event.clientX - start) > DRAG) start = null;
      if (event.buttons && start === null) go(event);
    });
    this.place.addEventListener("pointerup", (event) => {
      if (start !== null) go(event);
      start = null;
    });
    this.place.addEventListener("pointercancel", () => (start = null)); // the browser scrolls the page
  }

  /** Redraw all at the current size. first, span: times at the left and the right end [s]. */
  resize(first, span) {
    Object.assign(this, { first: Math.min(first, 0.9 * span), span });
    for (const chart of this.charts) paint(chart, this.run, this.first, span);
  }

  update(t) {
    const x = LEFT + (Math.min(Math.max((t - this.first) / (this.span - this.first), 0), 1) || 0) * (this.place.clientWidth - LEFT);
    this.cursor.style.transform = `translateX(${x}px)`;
  }
}

/** Largest values of all runs, for a common scale: { acceleration [m/s2], drifts [-] }. */
export function largest(runs) {
  const most = (name) => runs.reduce((sum, run) => (run[name] ?? []).reduce((a, b) => Math.max(a, Math.abs(b)), sum), 1e-6);
  return { acceleration: most("acceleration"), drifts: most("drifts") };
}

function motionChart(run, most) {
  const { dt, start } = run.info.motion;
  const count = run.acceleration.length / 3;
  const lines = ["ew", "ns", "ud"].map((key, k) => ({ key, k })).reverse();
  return {
    name: "motion",
    caption: () => [element("span", {}, tr("Ground acceleration, m/s²")), ...["ns", "ew", "ud"].map(direction)],
    description: () => `${tr("Ground acceleration, m/s²")}: ≤ ${most.toFixed(1)}`,
    lines: lines.map((line) => ({ ...line, value: (i) => run.acceleration[3 * i + line.k], time: (i) => start + i * dt, count })),
    scale: (value) => value / (1.05 * most),
    marks: [round(most)].flatMap((v) => [{ value: -v, text: `−${v}` }, { value: v, text: `${v}` }]),
    levels: [],
  };
}

/** Drifts of a storey, scaled by signed square roots, so that small ones are visible beside large ones. */
function driftChart(run, most, storey) {
  const columns = run.info.drifts;
  const width = columns.length;
  const rows = run.history_time.length;
  const full = Math.sqrt(Math.min(Math.max(1.1 * most, 1 / 8), MOST_DRIFT));
  const title = () => `${tr("Storey drift")}, ${storeyName(storey)}`;
  return {
    name: "drift",
    caption: () => [element("span", {}, title()), ...["ns", "ew"].map(direction)],
    description: () => `${title()}. ${either(run.info.result, run.info.japanese?.result)}`,
    lines: columns.flatMap((column, k) => (column.storey === storey ? [{ key: column.key, k }] : [])).map(({ key, k }) => ({
      key,
      value: (i) => run.drifts[i * width + k],
      time: (i) => run.history_time[i],
      count: rows,
    })),
    scale: (value) => Math.max(-1, Math.min(1, (Math.sign(value) * Math.sqrt(Math.abs(value))) / full)),
    marks: run.info.levels,
    levels: run.info.levels.flatMap(({ value }) => [value, -value]),
  };
}

const round = (v) => Number((v >= 2 ? Math.floor(v) : v).toPrecision(2));
const direction = (key) => swatch(COLORS[key], tr(NAMES[key]));

function swatch(color, name) {
  const line = svg("path", { d: "M0 4H18", stroke: color, "stroke-width": 2.5 });
  return element("span", { className: "key" }, svg("svg", { width: 18, height: 8, "aria-hidden": "true" }, line), name);
}

function paint(chart, run, first, span) {
  const { canvas } = chart;
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = devicePixelRatio;
  Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  const x = (t) => LEFT + ((t - first) / (span - first)) * (width - LEFT);
  const low = height - (chart.axis ?? 0);
  const y = (value) => (low - 1) * (0.5 - 0.5 * chart.scale(value)) + 0.5; // a line at the border is inside
  axes(pen, chart, x, y, width, height, first, span);
  for (const { time } of run.info.events) if (time >= first) stroke(pen, [[x(time), 0], [x(time), low]], "#b8b2a4", 1, [1, 3]);
  for (const line of chart.lines) curve(pen, line, x, y, first, span);
}

function axes(pen, chart, x, y, width, height, first, span) {
  const low = height - (chart.axis ?? 0);
  Object.assign(pen, { font: FONT, fillStyle: INK, textBaseline: "middle", textAlign: "right" });
  stroke(pen, [[LEFT, y(0)], [width, y(0)]], "#9b9789", 1);
  for (const value of chart.levels) stroke(pen, [[LEFT, y(value)], [width, y(value)]], "#77736a", 1, [4, 3]);
  for (const { place, text } of apart(chart.marks.map(({ value, text }) => ({ place: Math.min(y(value), height - LABEL_GAP / 2), text })))) pen.fillText(text, LEFT - 5, place);
  Object.assign(pen, { textAlign: "center", textBaseline: "bottom" });
  const gap = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 60].find((step) => (step / (span - first)) * (width - LEFT) > 44) ?? 120;
  for (let k = Math.ceil(first / gap); k * gap <= span; k++) {
    const t = k * gap;
    stroke(pen, [[x(t), 0], [x(t), low]], PALE, 1);
    if (chart.axis && x(t) < width - 16) pen.fillText(`${Number(t.toFixed(1))} s`, Math.max(x(t), LEFT + 8), height);
  }
}

/** Labels [{ place [pixel], text }] from the bottom up, LABEL_GAP apart: moved upwards where they would overlap, down again at the upper border. */
export function apart(labels) {
  const sorted = labels.toSorted((a, b) => b.place - a.place);
  sorted.forEach((label, k) => k && (label.place = Math.min(label.place, sorted[k - 1].place - LABEL_GAP)));
  sorted.forEach((label, k) => (label.place = Math.max(label.place, LABEL_GAP / 2 + (sorted.length - 1 - k) * LABEL_GAP)));
  return sorted;
}

function stroke(pen, points, color, width, dash = []) {
  Object.assign(pen, { strokeStyle: color, lineWidth: width });
  pen.setLineDash(dash);
  pen.beginPath();
  for (const [x, y] of points) pen.lineTo(x, y);
  pen.stroke();
}

function curve(pen, { key, value, time, count }, x, y, first, span) {
  Object.assign(pen, { strokeStyle: COLORS[key], lineWidth: 1.2, lineJoin: "round" });
  pen.setLineDash([]);
  pen.beginPath();
  for (let i = 0; i < count && time(i) <= span; i++) if (time(i) >= first) pen.lineTo(x(time(i)), y(value(i)));
  pen.stroke();
}

/** Largest absolute storey drift of a run at a time. [-] */
export function driftAt(run, t) {
  const width = run.info.drifts.length;
  const row = rowAt(run.history_time, t) * width;
  let largest = 0;
  for (let k = 0; k < width; k++) largest = Math.max(largest, Math.abs(run.drifts[row + k] ?? 0));
  return largest;
}
