// SPDX-License-Identifier: GPL-2.0-or-later
// Buttons, time line and keys.
import { element } from "./dom.js";
import { Film, download, possible } from "./film.js";
import { current, either, speak, tr, translated } from "./texts.js";
import { CAMERA_NAMES } from "./view.js";

const TURN = 0.12; // [rad] per key
const ANNOUNCED = 2; // time for which an event is shown on the time line [s]
const find = (id) => document.getElementById(id);

/** Connect the controls and keys of the page to the player. */
export function connect(player) {
  const { clock, view, options } = player;
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const part = { play: find("play"), scrub: find("scrub"), time: find("time"), speed: find("speed"), shaken: find("shaken"), joints: find("joints"), help: find("help"), event: find("event"), slow: find("slow"), film: find("film"), full: find("full"), language: find("language"), more: find("more") };
  const cameras = CAMERA_NAMES.map((name) => find(`camera-${name}`));
  const several = player.runs.length > 1;
  const said = ({ info }, text, japanese) => either(several ? `${info.title}: ${text}` : text, several ? `${info.japanese?.title ?? info.title}：${japanese}` : japanese);
  const titled = (run) => run.info.events.map(({ time, text, japanese }) => ({ time, get text() { return said(run, text, japanese); } }));
  const events = player.runs.flatMap(titled).sort((a, b) => a.time - b.time);

  const camera = (name) => view.set(name, !calm.matches);
  const change = (name, on) => {
    options[name] = on;
    player.changed();
  };
  const speed = (step) => {
    part.speed.selectedIndex = Math.min(Math.max(part.speed.selectedIndex + step, 0), part.speed.length - 1);
    clock.speed = Number(part.speed.value);
  };
  const event = (next) => {
    const found = next ? events.find(({ time }) => time > clock.time + 0.01) : events.findLast(({ time }) => time < clock.time - 0.01);
    if (found) player.seek(found.time);
  };

  part.scrub.max = clock.end;
  part.shaken.closest("label").hidden = !player.runs.some((run) => run.info.motion);
  part.shaken.checked = options.shaken;
  part.play.addEventListener("click", () => player.play(!clock.playing));
  part.scrub.addEventListener("input", () => player.seek(Number(part.scrub.value)));
  part.speed.addEventListener("change", () => speed(0));
  for (const name of ["ghost", "walls", "person"]) {
    part[name] = find(name);
    part[name].checked = options[name];
  }
  for (const name of ["shaken", "joints", "ghost", "walls", "person"]) part[name].addEventListener("change", () => change(name, part[name].checked));
  CAMERA_NAMES.forEach((name, k) => cameras[k].addEventListener("click", () => camera(name)));
  part.slow.closest("label").hidden = clock.main === null;
  part.slow.addEventListener("change", () => (clock.slows = part.slow.checked));
  part.full.hidden = !document.documentElement.requestFullscreen;
  const full = () => (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen());
  part.full.addEventListener("click", full);
  part.language.addEventListener("click", () => {
    speak(current() === "ja" ? "en" : "ja");
    player.changed();
  });
  translated(() => (part.language.textContent = current() === "ja" ? "English" : "日本語"));
  connectFilm(player, part.film);
  document.addEventListener("pointerdown", ({ target }) => part.more.contains(target) || part.more.removeAttribute("open"));
  const showHelp = () => {
    part.help.showModal();
    part.help.scrollTop = 0; // the focus is on the button at its end
  };
  find("help-button").addEventListener("click", showHelp);
  addTicks(find("ticks"), events, player);

  const keys = {
    " ": () => player.play(!clock.playing),
    k: () => player.play(!clock.playing),
    ArrowLeft: () => player.seek(clock.time - 0.5),
    ArrowRight: () => player.seek(clock.time + 0.5),
    ",": () => player.seek(clock.time - 0.05),
    ".": () => player.seek(clock.time + 0.05),
    Home: () => player.seek(0),
    End: () => player.seek(clock.end),
    PageUp: () => event(false),
    PageDown: () => event(true),
    1: () => camera("front"),
    2: () => camera("side"),
    3: () => camera("free"),
    c: () => camera(CAMERA_NAMES[(CAMERA_NAMES.indexOf(view.name) + 1) % CAMERA_NAMES.length]),
    g: () => part.shaken.closest("label").hidden || part.shaken.click(),
    j: () => part.joints.click(),
    f: () => part.full.hidden || full(),
    "+": () => view.turn(0, 0, 1 / 1.15),
    "=": () => view.turn(0, 0, 1 / 1.15),
    "-": () => view.turn(0, 0, 1.15),
    "[": () => speed(-1),
    "]": () => speed(1),
    "?": showHelp,
    "Shift+ArrowLeft": () => view.turn(-TURN, 0),
    "Shift+ArrowRight": () => view.turn(TURN, 0),
    "Shift+ArrowUp": () => view.turn(0, TURN),
    "Shift+ArrowDown": () => view.turn(0, -TURN),
  };
  let tabbed = false; // whether the focus was last moved by the keyboard
  addEventListener("pointerdown", () => (tabbed = false), true);
  addEventListener("keydown", (pressed) => {
    if (pressed.key === "Tab") tabbed = true;
    const action = keys[(pressed.shiftKey && pressed.key.startsWith("Arrow") ? "Shift+" : "") + (pressed.key.length > 1 ? pressed.key : pressed.key.toLowerCase())];
    if (!action || pressed.ctrlKey || pressed.altKey || pressed.metaKey || part.help.open || needed(pressed, tabbed)) return;
    pressed.preventDefault();
    if (pressed.key === " ") document.activeElement.blur(); // else the button would be pressed, too
    action();
  });

  player.shown = () => {
    const now = clock.time.toFixed(2);
    if (part.time.textContent !== now) part.time.textContent = now;
    if (document.activeElement !== part.scrub || Number(part.scrub.value) !== clock.time) part.scrub.value = clock.time;
    part.scrub.setAttribute("aria-valuetext", `${now} ${tr("seconds")}`);
    const label = tr(clock.playing ? "Pause" : "Play");
    if (part.play.getAttribute("aria-label") !== label) part.play.setAttribute("aria-label", label);
    document.body.classList.toggle("playing", clock.playing);
    announce(part.event, events, clock);
    CAMERA_NAMES.forEach((name, k) => cameras[k].setAttribute("aria-pressed", String(view.name === name)));
  };
}

/** The button that records what is played, from the present time to the end or to a second click. */
function connectFilm(player, button) {
  const stages = player.parts.filter(({ stage }) => stage);
  button.hidden = !possible() || !stages.length;
  const label = () => (button.textContent = `${player.film ? "■" : "●"} ${tr(player.film ? "Stop recording" : "Record a film")}`);
  translated(label);
  const stop = () => {
    player.film?.stop();
    player.film = null;
    player.play(false);
    label();
  };
  button.addEventListener("click", () => {
    if (player.film) return stop();
    const parts = stages.map(({ panel }) => ({ canvas: panel.view, title: () => panel.title, state: () => `${player.clock.time.toFixed(2)} s   ${panel.now.textContent}` }));
    player.film = new Film(parts, (file, ending) => download(file, `${player.runs[0].info.title.replace(/[^\p{L}\p{N}]+/gu, "_")}.${ending}`));
    player.play(true);
    label();
  });
  player.ended = () => player.film && stop();
}

/** Whether the focused control needs a key itself: a list its arrows, a button or the menu reached by keyboard its space. */
function needed({ key, target }, tabbed) {
  if (target instanceof HTMLSelectElement) return key === " " || key.startsWith("Arrow") || key === "Home" || key === "End";
  return key === " " && tabbed && (target instanceof HTMLButtonElement || target.matches("summary") || (target instanceof HTMLInputElement && target.type === "checkbox"));
}

/** Marks of events on the time line; a click goes to the event. */
function addTicks(place, events, player) {
  for (const event of events) {
    const tick = element("i");
    tick.style.left = `${(100 * event.time) / player.clock.end}%`;
    tick.addEventListener("click", () => player.seek(event.time));
    translated(() => (tick.title = `${event.time.toFixed(1)} s ${event.text}`));
    place.append(tick);
  }
}

/** Show the last event for a while below its mark, within the time line. */
function announce(place, events, { time: now, end }) {
  const event = events.findLast(({ time }) => time <= now + 1e-6 && now - time < ANNOUNCED);
  const text = event ? event.text : "";
  if (place.textContent === text) return;
  place.textContent = text;
  if (!event) return;
  const share = (100 * event.time) / end;
  Object.assign(place.style, { left: `${share}%`, transform: `translateX(${-share}%)` });
}
