// SPDX-License-Identifier: GPL-2.0-or-later
// What the page says about a run: title, result, state now, events; and the legend that all runs share.
import { driftAt } from "./curves.js";
import { DAMAGE_COLORS, LOAD_COLORS } from "./joints.js";
import { STATE } from "./run.js";

/** The section of a run, from the page's template. seek: called with a time. */
export class Panel {
  constructor(run, seek) {
    const copy = document.getElementById("run-template").content.cloneNode(true);
    this.run = run;
    this.section = copy.querySelector(".run");
    const part = (name) => this.section.querySelector(`.${name}`);
    for (const name of ["view", "stage", "curves", "words", "needle", "now", "fault"]) this[name] = part(name);
    part("title").textContent = run.info.title;
    part("result").textContent = run.info.result;
    part("curves-title").textContent = run.info.title;
    this.view.setAttribute("aria-label", `${run.info.title}: the house in 3D. Drag to turn it, Shift and arrow keys turn it, too.`);
    this.section.setAttribute("aria-label", run.info.title);
    part("happens").hidden = !run.info.events.length;
    this.events = run.info.events.map((event) => this.event(event, part("events"), seek));
  }

  event({ time, text }, list, seek) {
    const button = Object.assign(document.createElement("button"), { type: "button" });
    button.append(Object.assign(document.createElement("b"), { textContent: `${time.toFixed(1)} s` }), ` ${text}`);
    button.addEventListener("click", () => seek(time));
    const item = document.createElement("li");
    item.append(button);
    list.append(item);
    return { time, button };
  }

  /** The state at a time: drift and broken joints in words, events so far, direction of north. */
  update(t, view) {
    const { info, joints } = this.run;
    const down = info.collapse !== null && t >= info.collapse;
    const drift = info.drifts.length ? `storey drift ${ratio(driftAt(this.run, t))}, ` : "";
    const partly = this.run.count(STATE.partly);
    const over = t > this.run.end + 1e-6 ? `recorded up to ${this.run.end.toFixed(1)} s: ` : "";
    say(this.now, `${over}${down ? "collapsed, " : drift}${this.run.count(STATE.broken)} of ${joints} joints broken${partly ? `, ${partly} partly` : ""}`);
    say(this.words, view.words);
    this.needle.style.transform = `rotate(${(view.azimuth + Math.PI / 2).toFixed(3)}rad)`;
    for (const { time, button } of this.events) button.classList.toggle("past", time <= t + 1e-6);
  }
}

function say(place, text) {
  if (place.textContent !== text) place.textContent = text;
}

/** A drift as people of the trade write it: 1/85. */
function ratio(drift) {
  if (drift < 1e-3) return "below 1/1000";
  return drift > 0.5 ? "over 1/2" : `1/${Math.round(1 / drift)}`;
}

const MARKS = {
  partly: ["joint partly broken", `<path d="M8 2.5 14.5 13.5H1.5Z" fill="${DAMAGE_COLORS.partly}" stroke="#141414" stroke-width="1.4"/>`],
  broken: ["joint broken (pale: hidden)", `<path d="M3 3 13 13M13 3 3 13" stroke="${DAMAGE_COLORS.broken}" stroke-width="4"/>`],
  before: ["broken before the start", `<circle cx="8" cy="8" r="5" fill="${DAMAGE_COLORS.before}" stroke="#141414" stroke-width="2.4"/>`],
};

/** Fill the legend: kinds of elements and marks that occur in any run. */
export function legend(place, runs) {
  const kinds = Object.assign({}, ...runs.map((run) => run.info.kinds));
  const used = new Set(runs.flatMap((run) => run.info.elements.map(({ kind }) => kind)));
  const entries = Object.entries(kinds)
    .filter(([kind]) => used.has(kind) && kind !== "ground")
    .map(([, { color, label }]) => [label, `<rect x="1" y="1" width="14" height="14" rx="2" fill="${color}" stroke="#4a4a4a"/>`]);
  const marks = Object.keys(MARKS).filter((name) => runs.some((run) => run.occurs(STATE[name]))).map((name) => MARKS[name]);
  const items = [...entries, ...marks].map(([label, shape]) => `<li><svg width="16" height="16" aria-hidden="true">${shape}</svg>${label}</li>`);
  const bar = `<li class="loads"><span class="bar" style="background:linear-gradient(90deg,${LOAD_COLORS.join()})"></span>load of a joint: none … breaks</li>`;
  place.innerHTML = bar + items.join("");
}
