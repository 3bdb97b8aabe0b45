// SPDX-License-Identifier: GPL-2.0-or-later

/** The time that is shown, and how fast it goes. */
export class Clock {
  constructor(end) {
    Object.assign(this, { end, time: 0, speed: 1, playing: false, last: null });
  }

  /** Go to a time [s], or to the nearest there is. */
  seek(t) {
    this.time = Math.min(Math.max(t, 0), this.end);
    this.last = null;
  }

  /** Start or stop; from the end it starts again at the beginning. */
  play(on) {
    if (on && this.time >= this.end) this.time = 0;
    this.playing = on;
    this.last = null;
  }

  /** now: a time of the browser [ms]. Pictures that come late do not make jumps of more than 0.25 s. */
  advance(now) {
    if (!this.playing) return;
    const passed = this.last === null ? 0 : Math.min((now - this.last) / 1000, 0.25);
    this.last = now;
    this.time = Math.min(this.time + passed * this.speed, this.end);
    if (this.time >= this.end) this.playing = false;
  }
}
