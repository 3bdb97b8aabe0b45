// SPDX-License-Identifier: GPL-2.0-or-later
// Texts about a run: title, result, current state, events; and the legend shared by all runs.
import { driftAt } from "./curves.js";
import { element, svg } from "./dom.js";
import { DAMAGE_COLORS, LOAD_COLORS } from "./joints.js";
import { STATE } from "./run.js";
import { current, either, tr, translated } from "./texts.js";

/** The section of a run, from the page's template. seek: called with a time [s]. */
export class Panel {
  constructor(run, seek) {
    const copy = document.getElementById("run-template").content.cloneNode(true);
    this.run = run;
    this.section = copy.querySelector(".run");
    const part = (name) => this.section.querySelector(`.${name}`);
    for (const name of ["view", "stage", "curves", "camera-name", "needle", "now", "error"]) this[name] = part(name);
    this.list = part("event-list");
    this.list.hidden = !run.info.events.length;
    this.events = run.info.events.map(({ time, text, japanese }) => {
      const what = element("span");
      const button = element("button", { type: "button" }, element("b", {}, `${time.toFixed(1)} s`), " ", what);
      button.addEventListener("click", () => seek(time));
      part("events").append(element("li", {}, button));
      translated(() => (what.textContent = either(text, japanese)));
      return { time, button };
    });
    translated(() => {
      part("title").textContent = part("curves-title").textContent = this.title;
      this.section.setAttribute("aria-label", this.title);
      this.view.setAttribute("aria-label", `${this.title}: ${tr("the house in 3D. Drag to turn it, or use Shift and the arrow keys.")}`);
      for (const name of ["result", "origin"]) part(name).textContent = either(run.info[name], run.info.japanese?.[name]);
      for (const name of ["result", "origin"]) part(name).title = part(name).textContent;
    });
  }

  get title() {
    return either(this.run.info.title, this.run.info.japanese?.title);
  }

  /** Show the state at a time: drift, broken joints, past events, direction of north. */
  update(t, view) {
    const { info } = this.run;
    const down = info.collapse !== null && t >= info.collapse;
    const drift = info.drifts.length ? ratio(driftAt(this.run, t), info.levels) : "";
    const end = this.run.end.toFixed(1);
    const broken = brokenParts(this.run);
    const over = t > this.run.end + 1e-6;
    const fallen = this.run.countFallen();
    const columns = this.run.columns.length;
    const texts = (...parts) => parts.filter(Boolean);
    const english = texts(down && "collapsed", fallen ? `${fallen} of ${columns} columns fallen` : !down && drift && `storey drift ${drift}`, broken?.english);
    const short = drift.replace("below 1/1000", "1/1000 未満").replace("over 1/2", "1/2 以上");
    const japanese = texts(down && "倒壊", fallen ? `柱 ${columns} のうち ${fallen} が倒れた` : !down && drift && `層間変形角 ${short}`, broken?.japanese);
    const [until, now] = current() === "ja" ? [`記録は ${end} 秒まで：`, japanese.join("、")] : [`recorded up to ${end} s: `, english.join(", ")];
    setText(this.now, (over ? until : "") + now);
    setText(this["camera-name"], tr(view.title));
    this.needle.style.transform = `rotate(${(view.azimuth + Math.PI / 2).toFixed(3)}rad)`;
    this.mark(this.events.findLastIndex(({ time }) => time <= t + 1e-6));
  }

  /** Mark the events up to the current one (-1: none), and keep that one in view where the list scrolls. */
  mark(current) {
    if (current === this.current) return;
    this.current = current;
    this.events.forEach(({ button }, k) => {
      button.classList.toggle("past", k <= current);
      if (k === current) button.setAttribute("aria-current", "step");
      else button.removeAttribute("aria-current");
    });
    if (current < 0) return void (this.list.scrollTop = 0);
    const { offsetTop, offsetHeight } = this.events[current].button;
    this.list.scrollTop = Math.min(Math.max(this.list.scrollTop, offsetTop + 2 * offsetHeight - this.list.clientHeight), offsetTop - offsetHeight);
  }
}

/** Texts about the broken joints and wall sheets of a run at its current time: { english, japanese }, or null when none is broken. */
function brokenParts(run) {
  const [joints, broken, sheets, torn] = [run.joints - run.apart.size, run.count(STATE.broken), run.sheets.length, run.countSheets("broken")];
  const partly = run.count(STATE.partly) + run.countSheets("partly");
  if (!broken && !torn && !partly) return null;
  const walls = sheets ? ` and ${torn} of ${sheets} wall sheet${sheets === 1 ? "" : "s"}` : "";
  const wallsJapanese = sheets ? `、壁面 ${sheets} のうち ${torn}` : "";
  return {
    english: `${broken} of ${joints} joints${walls} broken${partly ? `, ${partly} partly` : ""}`,
    japanese: `接合部 ${joints} のうち ${broken}${wallsJapanese} が破断${partly ? `、一部破断 ${partly}` : ""}`,
  };
}

function setText(place, text) {
  if (place.textContent !== text) place.textContent = text;
}

/** A drift as engineers write it: 1/85. One below a limit is not rounded up to it (text/english.py: ratio). */
function ratio(drift, levels) {
  if (drift < 1e-3) return "below 1/1000";
  const number = Math.round(1 / drift);
  const below = drift < 1 / number && levels.some(({ value }) => Math.round(1 / value) === number);
  return drift > 0.5 ? "over 1/2" : `1/${number + below}`;
}

const [BROKEN_JOINT, BROKEN_WALL] = ["joint broken (pale: hidden)", "joint or wall broken (pale: hidden)"];
const MARKS = {
  partly: ["joint partly broken", "path", { d: "M8 2.5 14.5 13.5H1.5Z", fill: DAMAGE_COLORS.partly, stroke: "#141414", "stroke-width": 1.4 }],
  broken: [BROKEN_JOINT, "path", { d: "M3 3 13 13M13 3 3 13", stroke: DAMAGE_COLORS.broken, "stroke-width": 4 }],
  before: ["broken before the start", "circle", { cx: 8, cy: 8, r: 5, fill: DAMAGE_COLORS.before, stroke: "#141414", "stroke-width": 2.4 }],
};

const SHEETS = { whole: "wall", partly: "wall partly broken", broken: "wall broken" };

/** Fill the legend: kinds of elements and marks that occur in any run. */
export function legend(place, runs) {
  const kinds = new Map(runs.flatMap((run) => run.info.kinds.map(({ kind, color }) => [kind, color])));
  kinds.delete("ground");
  const boxes = Array.from(kinds, ([kind, color]) => [kind === "snow" ? "snow, in rigid slabs" : kind, "rect", { x: 1, y: 1, width: 14, height: 14, rx: 2, fill: color, stroke: "#4a4a4a" }]);
  const marks = Object.keys(MARKS).filter((name) => runs.some((run) => run.occurs(STATE[name])));
  const colors = Object.assign({}, ...runs.map(({ info }) => info.sheet_colors));
  const walls = Object.keys(colors).length > 0;
  for (const [state, label] of Object.entries(SHEETS)) if (colors[state]) boxes.push([label, "rect", { x: 1, y: 1, width: 14, height: 14, rx: 2, fill: colors[state], stroke: "#4a4a4a" }]);
  const bar = element("span", { className: "bar" });
  bar.style.background = `linear-gradient(90deg, ${LOAD_COLORS.join()})`;
  place.replaceChildren(element("li", { className: "loads" }, bar, tr("force in a joint: none … strength")));
  for (const [label, tag, attributes] of [...boxes, ...marks.map((name) => MARKS[name])])
    place.append(element("li", {}, svg("svg", { width: 16, height: 16, "aria-hidden": "true" }, svg(tag, attributes)), tr(label === BROKEN_JOINT && walls ? BROKEN_WALL : label)));
}
