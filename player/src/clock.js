// SPDX-License-Identifier: GPL-2.0-or-later

const SLOW = 0.25; // factor on the speed around the main event
const [BEFORE, AFTER] = [0.7, 1.8]; // of the main event [s]

/** The time shown, and its speed. main: time of the main event [s], or null */
export class Clock {
  constructor(end, main) {
    Object.assign(this, { end, main, time: 0, speed: 1, slows: false, playing: false, last: null });
  }

  /** Speed at the present time. */
  get pace() {
    const near = this.slows && this.main !== null && this.time > this.main - BEFORE && this.time < this.main + AFTER;
    return this.speed * (near ? SLOW : 1);
  }

  /** Go to a time [s], limited to the run. */
  seek(t) {
    this.time = Math.min(Math.max(t, 0), this.end);
    this.last = null;
  }

  /** Start or stop; at the end it restarts from the beginning. */
  play(on) {
    if (on && this.time >= this.end) this.time = 0;
    this.playing = on;
    this.last = null;
  }

  /** Advance to a time of the browser [ms]; a late frame advances it by at most 0.25 s. */
  advance(now) {
    if (!this.playing) return;
    const passed = this.last === null ? 0 : Math.min((now - this.last) / 1000, 0.25);
    this.last = now;
    this.time = Math.min(this.time + passed * this.pace, this.end);
    if (this.time >= this.end) this.playing = false;
  }
}
