#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# sac2mseed 1.13 (Debian 12): each component of a record is multiplied by a power of ten of its own.
# Guess: SAC files of 9.0 (N) and 11.0 m/s2 (E) come back from miniSEED with these peaks, or as counts of one
# scale.
# Seen: with 900000 (N) and 110000 (E): the weaker component is eight times the stronger one; the files do not state
# the factors. With -e 4 (floats) the values stay.
# Needs Debian 12 with apt-get and Python 3. Status 1 if what is seen changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
apt-get -qq -o APT::Sandbox::User=root download sac2mseed=1.13+ds1-1+b1 mseed2sac=2.3+ds1-1 libmseed2=2.19.8-1
for package in *.deb; do dpkg -x "$package" .; done
cat >run.py <<'PY'
import array, glob, math, os, subprocess, sys

os.environ["LD_LIBRARY_PATH"] = os.path.dirname(glob.glob("usr/lib/*/libmseed.so.2*")[0])
DT, COUNT, UNSET = 0.01, 4000, -12345


def write(name, channel, peak):
    """A SAC file (version 6) of one wave with this peak. [m/s2]"""
    wave = [math.sin(2 * math.pi * 1.25 * DT * k) * math.exp(-((DT * k - 20.2) / 5) ** 2) for k in range(COUNT)]
    scale = peak / max(map(abs, wave))
    wave = array.array("f", [scale * value for value in wave])
    reals, integers = array.array("f", [UNSET] * 70), array.array("i", [UNSET] * 40)
    reals[0], reals[1], reals[2], reals[5], reals[6] = DT, min(wave), max(wave), 0, DT * (COUNT - 1)
    integers[0:6] = array.array("i", [2024, 1, 0, 0, 0, 0])  # year, day, hour, minute, second, millisecond
    integers[6], integers[9], integers[15] = 6, COUNT, 1  # version, samples, time series
    integers[35:39] = array.array("i", [1, 1, 1, 0])  # evenly spaced
    words = [b"-12345  "] * 24
    words[0], words[20], words[21] = b"STA     ", channel.ljust(8).encode(), b"XX      "
    with open(name, "wb") as out:
        out.write(reals.tobytes() + integers.tobytes() + b"".join(words) + wave.tobytes())


def peak(name, *options):
    """Largest value after a way there and back."""
    for old in glob.glob("*.SAC"):
        os.remove(old)
    subprocess.run(["usr/bin/sac2mseed", *options, "-o", "wave.mseed", name], check=True, stderr=subprocess.DEVNULL)
    subprocess.run(["usr/bin/mseed2sac", "wave.mseed"], check=True, stderr=subprocess.DEVNULL)
    (back,) = glob.glob("*.SAC")
    with open(back, "rb") as file:
        return max(map(abs, array.array("f", file.read()[632:])))


status = 0
for name, channel, stated, seen in (("north", "HNN", 9.0, 9e5), ("east", "HNE", 11.0, 1.1e5)):
    write(name, channel, stated)
    counts, floats = peak(name), peak(name, "-e", "4")
    print(f"{name}, {stated} m/s2: {counts:.0f}, seen {seen:.0f}; as floats {floats:.3f}, seen {stated}")
    status |= not (abs(counts - seen) <= 1 and abs(floats - stated) < 1e-5)
sys.exit(status)
PY
python3 run.py
