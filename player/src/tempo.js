// SPDX-License-Identifier: GPL-2.0-or-later

const LONGEST = 45; // time of a picture that is drawn fast enough [ms]
const COUNT = 5; // pictures of which the median counts

/** Times between the pictures that are played. */
export class Tempo {
  times = [];
  last = null;

  /** Whether the pictures up to this one, at a time of the browser [ms], take too long; counts anew after each answer. */
  isSlow(now) {
    const passed = now - this.last;
    if (this.last !== null && passed < 5000) this.times.push(passed); // longer: it was paused
    this.last = now;
    if (this.times.length < COUNT) return false;
    const median = this.times.toSorted((a, b) => a - b)[COUNT >> 1];
    this.times = [];
    return median > LONGEST;
  }
}
