// SPDX-License-Identifier: GPL-2.0-or-later

/** The time shown, and its speed. */
export class Clock {
  constructor(end) {
    Object.assign(this, { end, time: 0, speed: 1, playing: false, last: null });
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
    this.time = Math.min(this.time + passed * this.speed, this.end);
    if (this.time >= this.end) this.playing = false;
  }
}
