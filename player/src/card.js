// SPDX-License-Identifier: GPL-2.0-or-later
// A member or joint that the user has clicked: its name, its load over time, when and why it broke.
import { Raycaster, Vector2, Vector3 } from "three";
import { LOAD_COLORS } from "./joints.js";
import { element } from "./dom.js";
import { either, storeyName, translated, tr } from "./texts.js";

const CLOSE = 14; // distance to a joint at which a click means it [pixel]
const STILL = 6; // movement between press and release that is still a click [pixel]
const BEHIND = 0.5; // a joint this far behind the visible face is hidden [m]
const MOST = 1.25; // largest load in the curve [strength]
const RED = "#d55e00";
const [toward, middle] = [new Raycaster(), new Vector3()];

/** Listens to clicks on a stage and shows the card in its panel. redraw: called after a change; seek: with a time [s]. */
export class Card {
  constructor(stage, place, view, { redraw, seek }) {
    Object.assign(this, { stage, run: stage.run, view, redraw, chosen: null });
    this.title = element("b");
    this.name = element("small");
    this.now = element("p");
    this.most = element("p", { className: "most" });
    this.broke = element("p", { className: "broke" });
    this.canvas = element("canvas", { role: "img" });
    const close = element("button", { type: "button", className: "close", textContent: "×" });
    close.addEventListener("click", () => this.choose(null));
    this.box = element("aside", { className: "card", hidden: true }, close, this.title, this.name, this.canvas, this.now, this.most, this.broke);
    this.ring = element("i", { className: "ring", hidden: true });
    place.append(this.ring, this.box);
    translated(() => {
      close.setAttribute("aria-label", tr("Close"));
      this.fill();
    });
    this.canvas.addEventListener("click", (event) => seek((event.offsetX / this.canvas.clientWidth) * this.run.end));
    this.listen();
  }

  listen() {
    let press = null;
    const { canvas } = this.stage;
    canvas.addEventListener("pointerdown", (event) => (press = event.isPrimary && event.button === 0 ? event : null));
    canvas.addEventListener("pointerup", (event) => {
      if (press && Math.hypot(event.clientX - press.clientX, event.clientY - press.clientY) < STILL) this.choose(this.at(event.clientX, event.clientY));
      press = null;
    });
  }

  /** {element} or {joint} at a position of the page, or null. */
  at(x, y) {
    const place = this.stage.canvas.getBoundingClientRect();
    this.view.shape(this.stage.aspect);
    toward.setFromCamera(new Vector2(((x - place.left) / place.width) * 2 - 1, 1 - ((y - place.top) / place.height) * 2), this.view.camera);
    const hit = this.stage.house.hit(toward);
    const far = hit ? hit.distance + BEHIND : Infinity;
    const joints = this.stage.joints.visible ? Array.from({ length: this.run.joints }, (_, j) => this.measured(j, x, y)) : [];
    const near = joints.filter(({ away, distance }) => away < CLOSE && distance < far).sort((a, b) => a.away - b.away)[0];
    return near ? { joint: near.j } : hit ? { element: hit.number } : null;
  }

  /** Distance of a joint from a position of the page [pixel] and from the camera [m]. */
  measured(j, x, y) {
    const point = Array.from(this.run.joint.place.subarray(3 * j, 3 * j + 3));
    const seen = this.stage.screen(point, this.view);
    middle.fromArray(point).add(this.stage.moving.position);
    return { j, away: Math.hypot(seen.x - x, seen.y - y), distance: middle.distanceTo(this.view.camera.position) };
  }

  choose(chosen) {
    this.chosen = chosen;
    this.stage.house.highlight(chosen?.element ?? null);
    this.box.hidden = !chosen;
    this.fill();
    this.redraw();
  }

  /** Texts that do not change with time. */
  fill() {
    if (!this.chosen) return;
    const { info } = this.run;
    const { joint, element: number } = this.chosen;
    const own = joint === undefined ? this.run.jointsOf(number) : [joint];
    this.loads = this.run.loadOver(own);
    if (joint !== undefined) {
      const [kind, ...rest] = info.joint_list[joint].place.split(", ");
      this.title.textContent = [kind, ...rest].map(tr).join(", ");
      const { a, b } = this.run;
      this.name.textContent = `${info.elements[a[joint]].name} – ${info.elements[b[joint]].name}`;
    } else {
      const { kind, storey, name } = info.elements[number];
      this.title.textContent = tr(kind) + (storey ? `, ${storeyName(storey)}` : "");
      this.name.textContent = name;
    }
    this.most.textContent = this.largest(own);
    this.breaks = info.breaks.filter((entry) => own.includes(entry.joint)).sort((p, q) => p.time - q.time);
    const first = own.filter((j) => this.run.damaged[j]).length;
    const lines = this.breaks.slice(0, 3).map((entry) => this.sentence(entry, own.length > 1));
    if (this.breaks.length > 3) lines.push(`+ ${this.breaks.length - 3}`);
    if (first) lines.unshift(`${tr("broken before the start")}${own.length > 1 ? `: ${first}` : ""}`);
    this.broke.textContent = lines.join("\n") || (own.length ? tr("not broken") : tr("no joints"));
  }

  /** 'largest pull 3.1 kN, shear 0.6 kN', and the uplift at the foot of a column; empty where the run has no such data. */
  largest(own) {
    const { elements, joint_list: joints, feet } = this.run.info;
    const known = own.map((j) => joints[j]).filter((joint) => joint.pull !== undefined);
    const force = (key) => `${(Math.max(...known.map((joint) => joint[key])) / 1000).toFixed(1)} kN`;
    const end = this.run.info.until?.toFixed(2); // a collapse
    const until = end ? either(` before ${end} s`, `（${end} 秒まで）`) : "";
    const lines = known.length ? [`${own.length > 1 ? tr("its joints: ") : ""}${tr("largest pull")} ${force("pull")}${tr(", ")}${tr("shear")} ${force("shear")}${until}`] : [];
    const column = this.chosen.element ?? (feet.includes(own[0]) ? this.run.a[own[0]] : undefined);
    const uplift = elements[column]?.uplift;
    if (uplift !== undefined) lines.push(`${tr("largest uplift of the column's foot")} ${(1000 * uplift).toFixed(uplift < 0.01 ? 1 : 0)} mm${until}`);
    return lines.join("\n");
  }

  /** '21.77 s: tension, 3.1 kN (4 of 4 springs)' */
  sentence({ joint, time, cause, force, springs }, many) {
    const place = many ? `${tr(this.run.info.joint_list[joint].place.split(", ")[0])}, ` : "";
    return `${time.toFixed(2)} s: ${place}${tr(cause)}${force > 0 ? `, ${(force / 1000).toFixed(1)} kN` : ""} (${springs}/${this.run.springs[joint]})`;
  }

  /** Follow the current time and camera. */
  update(t) {
    this.ring.hidden = this.chosen?.joint === undefined;
    if (!this.chosen) return;
    const { joint } = this.chosen;
    if (joint !== undefined) {
      const seen = this.stage.screen(Array.from(this.run.joint.place.subarray(3 * joint, 3 * joint + 3)), this.view);
      const place = this.stage.canvas.getBoundingClientRect();
      this.ring.style.transform = `translate(${seen.x - place.left}px, ${seen.y - place.top}px)`;
    }
    const { load, joint: most } = this.loads.at(this.run, t);
    const force = most === null || !this.run.strength[most] ? "" : ` (${((load * this.run.strength[most]) / 1000).toFixed(1)} kN)`;
    const text = most === null ? "" : `${t.toFixed(2)} s: ${load.toFixed(2)} ${tr("of its strength")}${force}`;
    if (this.now.textContent !== text) this.now.textContent = text;
    this.paint(t);
  }

  paint(t) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = devicePixelRatio;
    Object.assign(this.canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    const pen = this.canvas.getContext("2d");
    pen.scale(ratio, ratio);
    const x = (time) => (time / this.run.end) * width;
    const y = (load) => height - 1 - (Math.min(load, MOST) / MOST) * (height - 2);
    line(pen, "#b8b2a4", [[0, y(1)], [width, y(1)]], [3, 3]);
    line(pen, LOAD_COLORS[2], Array.from(this.loads.values, (load, k) => [x(this.run.time[k]), y(load)]), []);
    for (const { time } of this.breaks) line(pen, RED, [[x(time), 0], [x(time), height]], [2, 2]);
    line(pen, "#20282e", [[x(t), 0], [x(t), height]], []);
  }
}

function line(pen, color, points, dash) {
  Object.assign(pen, { strokeStyle: color, lineWidth: 1.3 });
  pen.setLineDash(dash);
  pen.beginPath();
  for (const [x, y] of points) pen.lineTo(x, y);
  pen.stroke();
}
