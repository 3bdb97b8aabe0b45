// SPDX-License-Identifier: GPL-2.0-or-later
// Buttons, slider and keys.
import { CAMERA_NAMES } from "./view.js";

const TURN = 0.12; // [rad] per key
const find = (id) => document.getElementById(id);

/** Connect the page's controls and keys with the player. */
export function connect(player) {
  const { clock, view, options } = player;
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const part = { play: find("play"), scrub: find("scrub"), time: find("time"), speed: find("speed"), shaken: find("shaken"), joints: find("joints"), help: find("help") };
  const cameras = CAMERA_NAMES.map((name) => find(`camera-${name}`));
  const moments = [...new Set(player.runs.flatMap((run) => run.info.events.map(({ time }) => time)))].sort((a, b) => a - b);

  const camera = (name) => view.set(name, !calm.matches);
  const change = (name, on) => {
    options[name] = on;
    player.changed();
  };
  const speed = (step) => {
    part.speed.selectedIndex = Math.min(Math.max(part.speed.selectedIndex + step, 0), part.speed.length - 1);
    clock.speed = Number(part.speed.value);
  };
  const event = (way) => {
    const next = way > 0 ? moments.find((t) => t > clock.time + 0.01) : moments.findLast((t) => t < clock.time - 0.01);
    if (next !== undefined) player.seek(next);
  };

  part.scrub.max = clock.end;
  part.shaken.closest("label").hidden = !player.runs.some((run) => run.info.motion);
  part.shaken.checked = options.shaken;
  part.play.addEventListener("click", () => player.play(!clock.playing));
  part.scrub.addEventListener("input", () => player.seek(Number(part.scrub.value)));
  part.speed.addEventListener("change", () => speed(0));
  for (const name of ["shaken", "joints"]) part[name].addEventListener("change", () => change(name, part[name].checked));
  CAMERA_NAMES.forEach((name, k) => cameras[k].addEventListener("click", () => camera(name)));
  find("help-button").addEventListener("click", () => part.help.showModal());
  ticks(find("ticks"), moments, clock.end);

  const keys = {
    " ": () => player.play(!clock.playing),
    k: () => player.play(!clock.playing),
    ArrowLeft: () => player.seek(clock.time - 0.5),
    ArrowRight: () => player.seek(clock.time + 0.5),
    ",": () => player.seek(clock.time - 0.05),
    ".": () => player.seek(clock.time + 0.05),
    Home: () => player.seek(0),
    End: () => player.seek(clock.end),
    PageUp: () => event(-1),
    PageDown: () => event(1),
    1: () => camera("front"),
    2: () => camera("side"),
    3: () => camera("free"),
    c: () => camera(CAMERA_NAMES[(CAMERA_NAMES.indexOf(view.name) + 1) % CAMERA_NAMES.length]),
    g: () => part.shaken.closest("label").hidden || part.shaken.click(),
    j: () => part.joints.click(),
    "+": () => view.turn(0, 0, 1 / 1.15),
    "=": () => view.turn(0, 0, 1 / 1.15),
    "-": () => view.turn(0, 0, 1.15),
    "[": () => speed(-1),
    "]": () => speed(1),
    "?": () => part.help.showModal(),
    "Shift+ArrowLeft": () => view.turn(-TURN, 0),
    "Shift+ArrowRight": () => view.turn(TURN, 0),
    "Shift+ArrowUp": () => view.turn(0, TURN),
    "Shift+ArrowDown": () => view.turn(0, -TURN),
  };
  addEventListener("keydown", (pressed) => {
    const action = keys[(pressed.shiftKey && pressed.key.startsWith("Arrow") ? "Shift+" : "") + (pressed.key.length > 1 ? pressed.key : pressed.key.toLowerCase())];
    if (!action || pressed.ctrlKey || pressed.altKey || pressed.metaKey || part.help.open || own(pressed)) return;
    pressed.preventDefault();
    action();
  });

  player.shown = () => {
    const now = clock.time.toFixed(2);
    if (part.time.textContent !== now) part.time.textContent = now;
    if (document.activeElement !== part.scrub || Number(part.scrub.value) !== clock.time) part.scrub.value = clock.time;
    part.scrub.setAttribute("aria-valuetext", `${now} seconds`);
    const label = clock.playing ? "Pause" : "Play";
    if (part.play.getAttribute("aria-label") !== label) part.play.setAttribute("aria-label", label);
    document.body.classList.toggle("playing", clock.playing);
    CAMERA_NAMES.forEach((name, k) => cameras[k].setAttribute("aria-pressed", String(view.name === name)));
  };
}

/** Keys that the focused control needs itself: a button its space, the list of speeds its arrows. */
function own({ key, target }) {
  if (target instanceof HTMLSelectElement) return key === " " || key.startsWith("Arrow") || key === "Home" || key === "End";
  return key === " " && (target instanceof HTMLButtonElement || (target instanceof HTMLInputElement && target.type === "checkbox"));
}

/** Small marks over the slider where something happens. */
function ticks(place, moments, end) {
  place.innerHTML = moments.map((t) => `<i style="left:${((100 * t) / end).toFixed(3)}%"></i>`).join("");
}
