// SPDX-License-Identifier: GPL-2.0-or-later
// The page: runs played in step, with one clock and one camera.
import { Box3, Vector3 } from "three";
import { Card } from "./card.js";
import { Clock } from "./clock.js";
import { connect } from "./controls.js";
import { Curves, largest } from "./curves.js";
import { Panel, legend } from "./panel.js";
import { unpack } from "./run.js";
import { Stage } from "./stage.js";
import { Tempo } from "./tempo.js";
import { speak, tr, translated } from "./texts.js";
import { View } from "./view.js";

const BEFORE_FIRST = 2; // time from the opening of the page to the shaking, or to the first event when it is earlier [s]
const SHORTEST = 0.1; // length of the time line for runs without a step [s]
const NEAR = 1.5; // distance up to which wreckage stays in the picture [m]

/** Draws the runs, only when something has changed. */
class Player {
  constructor(runs) {
    this.runs = runs;
    this.options = { shaken: runs.some((run) => run.info.motion), joints: true, ghost: false, walls: false, person: false };
    const main = runs.flatMap(({ info }) => (info.main === null ? [] : [info.main]));
    this.clock = new Clock(Math.max(SHORTEST, ...runs.map((run) => run.end)), main.length ? Math.min(...main) : null);
    const start = corners(runs, 0);
    const box = new Box3().setFromPoints(start);
    this.view = new View(inPicture(start, runs), () => this.changed());
    const scales = largest(runs);
    this.first = Math.min(...runs.map(({ info }) => info.first));
    const seek = (t) => this.seek(t);
    this.parts = runs.map((run) => {
      const panel = new Panel(run, seek);
      document.getElementById("runs").append(panel.section);
      const curves = new Curves(panel.curves, run, scales, seek);
      const stage = open(panel, run, box);
      const card = stage && new Card(stage, panel.stage, this.view, { redraw: () => this.changed(), seek });
      return { run, panel, curves, stage, card };
    });
    for (const { stage } of this.parts) if (stage) this.view.listen(stage.canvas);
    for (const { panel } of this.parts) panel.view.addEventListener("webglcontextrestored", () => this.changed());
    this.tick = this.tick.bind(this);
    this.pending = 0;
    this.tempo = new Tempo();
    new ResizeObserver(() => this.resize()).observe(document.body);
    for (const { panel } of this.parts) new ResizeObserver(() => this.resize()).observe(panel.stage);
  }

  seek(t) {
    this.clock.seek(t);
    this.changed();
  }

  play(on) {
    this.clock.play(on);
    this.changed();
  }

  /** Draw before the next frame of the browser. */
  changed() {
    this.pending ||= requestAnimationFrame(this.tick);
  }

  tick(now) {
    this.pending = 0;
    this.clock.advance(now);
    const turning = this.view.step(now);
    this.draw();
    if (this.clock.playing && this.tempo.isSlow(now)) for (const { stage } of this.parts) stage?.simplify(this.view.fov);
    if (this.clock.playing || turning) this.changed();
    if (!this.clock.playing) this.ended?.();
  }

  draw() {
    const t = this.clock.time;
    for (const { run, panel, curves, stage, card } of this.parts) {
      run.at(t);
      stage?.draw(this.view, this.options);
      card?.update(t);
      panel.update(t, this.view);
      curves.update(t);
    }
    this.film?.take();
    this.shown?.();
  }

  resize() {
    const { clientWidth, clientHeight } = this.parts[0].panel.view;
    if (!clientHeight) return;
    this.view.resize(clientWidth / clientHeight);
    for (const { curves, stage } of this.parts) {
      stage?.resize(this.view.fov);
      curves.resize(this.first, this.clock.end);
    }
    this.draw();
  }
}

/** The stage of a run, or null with a message in its panel. */
function open(panel, run, box) {
  try {
    return new Stage(panel.view, run, box);
  } catch (problem) {
    console.error(problem);
    translated(() => (panel.error.textContent = tr("No 3D picture: this browser has no WebGL 2. Curves and events work.")));
    panel.error.hidden = false;
    return null;
  }
}

/** Corners of the houses at a time, without the ground. */
function corners(runs, time) {
  return runs.flatMap((run) => {
    run.at(time);
    return run.info.elements.flatMap(({ kind }, k) => (kind === "ground" ? [] : run.corners(k)));
  });
}

/** Points that the camera keeps in the picture: the houses at the start, and at the end within NEAR of them. */
function inPicture(start, runs) {
  const near = new Box3().setFromPoints(start).expandByVector(new Vector3(NEAR, NEAR, 0));
  return [...start, ...corners(runs, Infinity).map((point) => near.clampPoint(point, point))];
}

/** For tests and the console: seek(t), play(on), time, pace, playing, speak(language), joint(j) { x, y } [pixel]; of a point [m] in the body frame of an element of a run (from 0 on):
 *  position(name, run, point) [m, frame of the ground], screen(name, run, point) { x, y } [pixel]. */
function expose(player) {
  const position = (name, k = 0, point = [0, 0, 0]) => {
    const { run } = player.parts[k];
    return run.placed(run.info.elements.findIndex((element) => element.name === name), new Vector3(...point)).toArray();
  };
  window.player = Object.freeze({
    seek(t) {
      player.play(false);
      player.clock.seek(t);
      player.draw();
    },
    play: (on = true) => player.play(on),
    get time() {
      return player.clock.time;
    },
    get pace() {
      return player.clock.pace;
    },
    get playing() {
      return player.clock.playing;
    },
    position,
    speak,
    joint: (j, k = 0) => player.parts[k].stage.screen(Array.from(player.parts[k].run.joint.place.subarray(3 * j, 3 * j + 3)), player.view),
    screen: (name, k = 0, point = undefined) => player.parts[k].stage.screen(position(name, k, point), player.view),
  });
}

/** #t=12.3 opens at that time, paused; else the page plays from shortly before the shaking or the first event, unless the user prefers no motion. */
function begin(player) {
  const wanted = () => Number.parseFloat(new URLSearchParams(location.hash.slice(1)).get("t"));
  const jump = () => {
    player.play(false);
    player.seek(wanted());
  };
  addEventListener("hashchange", () => Number.isFinite(wanted()) && jump());
  if (Number.isFinite(wanted())) return jump();
  const onsets = player.runs.flatMap(({ info }) => (info.motion ? [info.motion.onset, ...info.events.map(({ time }) => time)] : []));
  player.seek(onsets.length ? Math.max(0, Math.min(...onsets) - BEFORE_FIRST) : 0);
  player.play(!matchMedia("(prefers-reduced-motion: reduce)").matches);
}

async function main() {
  const runs = await Promise.all(Array.from(document.querySelectorAll("script.run-data"), (place) => unpack(place.textContent)));
  document.body.classList.add(runs.length > 1 ? "compare" : "single");
  const player = new Player(runs);
  translated(() => legend(document.getElementById("legend-list"), runs));
  connect(player);
  speak(navigator.language.startsWith("ja") ? "ja" : "en");
  player.resize();
  begin(player);
  expose(player);
  document.body.classList.add("ready");
}

main().catch((problem) => {
  document.getElementById("loading").textContent = `This page cannot be shown: ${problem.message}. It needs a browser of 2023 or later.`;
  throw problem;
});
