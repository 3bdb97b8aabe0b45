# SPDX-License-Identifier: GPL-2.0-or-later
"""Films of a recorded run, or of two runs side by side: MP4 by ffmpeg, or animated WebP by Pillow.

Positions are interpolated between recorded frames, the ground moves as recorded, the camera stands still.
The pictures come from the renderer of the sheets. Recorded from the player in headless Chromium, which draws on the
processor (SwiftShader), a picture of 1280 x 800 takes seconds; here one of 1920 x 1080 takes 0.1 s.
"""
import subprocess
import tempfile
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image

from ..base.atomic_write import written_whole
from ..base.errors import RunError
from ..recording.summary import TownSummary, collapse_time
from .caption import Caption, Strip
from .key_times import first_shown, last_change
from .provenance import parts
from .stage import stages

ENCODING = ("-c:v", "libx264", "-preset", "veryfast", "-crf", "21", "-pix_fmt", "yuv420p", "-movflags", "+faststart",
            "-f", "mp4")
WEBP = dict(loop=0, method=2, kmin=0, kmax=1)
"""Each picture is a key frame: a difference to the picture before leaves traces of what has moved."""
SLOW, BEFORE_FALL, AFTER_FALL = 0.25, 0.7, 1.8
"""Speed around the first fall [-], from and to these times before and after it [s]."""
HOLD = 2.0
"""Time for which the last picture stays. [s]"""
ROUNDING = 1e-6
"""Of sums of time steps. [s]"""
LONGEST = 36000
"""Largest number of pictures in a film. [-]"""


MOST_DRAWN = 160_000
"""Elements times pictures of a film that is made in half a minute in SMALL_SIZE on one processor. [-]"""
SMALL_SIZE, SLOWEST_RATE = (960, 540), 4.0
"""Of films of towns: size [pixel], lowest rate [1/s]."""


@dataclass(frozen=True)
class Format:
    """width, height [pixel]; rate [1/s]; speed, None: 1, and SLOW around the first fall; quality: of WebP, 0 to 100."""

    width: int = 1920
    height: int = 1080
    rate: float = 30.0
    speed: float | None = None
    quality: int = 60


def chosen_form(runs, size=None, rate=None, **others):
    """Format with a size [pixel] and a rate [1/s] that are given; by default a town has smaller and fewer pictures."""
    usual = Format()
    if any(isinstance(run.summary, TownSummary) for run in runs):
        span = max(map(last_change, runs)) - min(map(first_shown, runs))
        fitting = MOST_DRAWN / (sum(len(run.shown) for run in runs) * max(span, 1.0))
        usual = replace(usual, width=SMALL_SIZE[0], height=SMALL_SIZE[1],
                        rate=min(usual.rate, max(SLOWEST_RATE, fitting)))
    width, height = size or (usual.width, usual.height)
    return Format(width, height, rate or usual.rate, **others)


def write(path, runs, view="space", form=Format(), begin=None, end=None):
    """Write a film, .mp4 or .webp; returns the number of its pictures.

    runs: one or two Frames; view: a key of camera.CAMERAS; begin, end [s]: by default from shortly before the shaking
    (or the start) until no picture differs visibly from the last one. Raises RunError, OSError.
    """
    if not all(len(run.time) for run in runs):
        raise RunError("a run without frames")
    end = max(map(last_change, runs)) if end is None else min(end, max(run.time[-1] for run in runs))
    if begin is None:
        begin = min(first_shown(run) for run in runs)
        begin = begin if begin < end else min(run.time[0] for run in runs)
    if not begin < end:
        raise RunError(f"a film from {begin:g} s to {end:g} s has no pictures")
    form = replace(form, width=form.width // len(runs) * len(runs))
    times = picture_times(runs, form, begin, end)
    with written_whole(path) as part:
        write_film = _write_mp4 if path.suffix.lower() == ".mp4" else _write_webp
        write_film(part, map(Pictures(runs, view, form).at, times), form, len(times))
    return len(times)


def picture_times(runs, form, begin, end):
    """Times of the pictures from `begin` to `end`. [s]"""
    fall = min((time for run in runs for time in (collapse_time(run.summary),) if time is not None), default=np.inf)
    times = [begin]
    while times[-1] < end - ROUNDING and len(times) <= LONGEST:
        slow = form.speed is None and fall - BEFORE_FALL <= times[-1] < fall + AFTER_FALL
        times.append(times[-1] + (SLOW if slow else form.speed or 1.0) / form.rate)
    if len(times) > LONGEST:
        raise RunError(f"a film of more than {LONGEST} pictures: choose a shorter time, a higher speed or fewer"
                       " pictures per second")
    return times[:-1]


class Pictures:
    """Draws the runs side by side with one camera, a caption on each, and one strip below for a common origin."""

    def __init__(self, runs, view, form):
        self.picture = Image.new("RGB", (form.width, form.height))
        origins = [parts(run) for run in runs]
        below = runs[:1] if origins[0] == origins[-1] else runs
        self.strips = [Strip(run, origin, (form.width // len(below), form.height))
                       for run, origin in zip(below, origins)]
        size = form.width // len(runs), form.height - self.strips[0].height
        self.stages = stages(runs, size, view)
        self.captions = [Caption(run, size) for run in runs]

    def at(self, time):
        """Image (of Pillow) at a time [s]; it reuses the memory of the one before."""
        for number, (stage, caption) in enumerate(zip(self.stages, self.captions)):
            part = stage.picture(min(time, stage.frames.time[-1]))
            caption.on(part, time)
            self.picture.paste(part, (number * part.width, 0))
        for number, strip in enumerate(self.strips):
            self.picture.paste(strip.at(time), (number * strip.width, self.picture.height - strip.height))
        return self.picture


def _write_mp4(path, images, form, _count):
    """Pass the images to ffmpeg, which encodes them in another process; the last one is repeated."""
    source = ("-f", "rawvideo", "-pix_fmt", "rgb0", "-s", f"{form.width}x{form.height}", "-r", f"{form.rate:g}", "-i",
              "-")
    even = ("-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2:0:0")  # of yuv420p
    command = ["ffmpeg", "-v", "error", "-y", *source, *even, *ENCODING, str(path)]
    with tempfile.TemporaryFile() as said:
        try:
            process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=said,
                                       restore_signals=False)  # a limit of the file's size: ffmpeg reports the error
        except FileNotFoundError:
            raise RunError("a film in MP4 needs ffmpeg: install the package ffmpeg, or choose a name that ends in"
                           " .webp") from None
        try:
            for image in images:
                process.stdin.write(image.tobytes("raw", "RGBX"))
            for _ in range(round(HOLD * form.rate)):
                process.stdin.write(image.tobytes("raw", "RGBX"))
            process.stdin.close()
        except BrokenPipeError:
            pass
        except BaseException:
            process.kill()
            raise
        finally:
            status = process.wait()
        said.seek(0)
        words = " ".join(said.read().decode(errors="replace").split())[-300:]
    if status:
        raise RunError(f"ffmpeg: {words or f'exit status {status}'}")


def _write_webp(path, images, form, count):
    durations = [round(1000 / form.rate)] * (count - 1) + [round(1000 * (HOLD + 1 / form.rate))]
    try:
        Reel(images, count).save(path, "webp", save_all=True, duration=durations, quality=form.quality, **WEBP)
    except (KeyError, ValueError) as problem:  # Pillow without WebP; a size that WebP does not have
        raise RunError(f"Pillow cannot write this film as WebP ({problem})") from None


class Reel(Image.Image):
    """Images as an animated one of Pillow, taken one after the other: together they would take gigabytes."""

    is_animated = True

    def __init__(self, images, count):
        super().__init__()
        self.images, self.n_frames, self.number = images, count, -1
        self.seek(0)

    def seek(self, frame):
        """Take the next image. Pillow asks for each once, in order, and for the first one again at the end."""
        if frame > self.number:
            image = next(self.images)
            # pixels, size and mode, which are read-only properties since Pillow 10.1
            self.__dict__.update(image.__dict__)
            self.number = frame

    def tell(self):
        return 0
