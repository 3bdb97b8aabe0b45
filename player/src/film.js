// SPDX-License-Identifier: GPL-2.0-or-later
// Records what is played as a film (WebM, MP4 in browsers without it), with a caption, and offers it as a download.
const HEIGHT = 720; // largest [pixel]
const RATE = 30; // pictures per second
const BITS = 8e6; // per second
const TYPES = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];

/** The type of film that the browser can record; undefined: none. */
const recordable = () => typeof MediaRecorder !== "undefined" && "captureStream" in HTMLCanvasElement.prototype ? TYPES.find((type) => MediaRecorder.isTypeSupported(type)) : undefined;

export const possible = () => recordable() !== undefined;

/** A film in the making. parts: [{ canvas, title(), state() }] side by side; done: called with the file (Blob) and the ending of its name after `stop`. */
export class Film {
  constructor(parts, done) {
    this.parts = parts;
    const { clientWidth: width, clientHeight: height } = parts[0].canvas;
    this.scale = Math.min(HEIGHT / height, 1280 / (width * parts.length), 2);
    this.size = [even(width * this.scale), even(height * this.scale)];
    this.canvas = Object.assign(document.createElement("canvas"), { width: this.size[0] * parts.length, height: this.size[1] });
    this.pen = this.canvas.getContext("2d");
    const [pieces, mimeType] = [[], recordable()];
    const [type] = mimeType.split(";");
    this.recorder = new MediaRecorder(this.canvas.captureStream(RATE), { mimeType, videoBitsPerSecond: BITS });
    this.recorder.addEventListener("dataavailable", ({ data }) => pieces.push(data));
    this.recorder.addEventListener("stop", () => done(new Blob(pieces, { type }), type.replace("video/", "")));
    this.recorder.start(1000);
  }

  /** Take over the picture; to be called right after it is drawn. */
  take() {
    const { pen, scale } = this;
    const [width, height] = this.size;
    const sky = pen.createLinearGradient(0, 0, 0, height);
    sky.addColorStop(0, "#cfe0ea");
    sky.addColorStop(0.58, "#eef1ef");
    Object.assign(pen, { fillStyle: sky });
    pen.fillRect(0, 0, this.canvas.width, height);
    this.parts.forEach(({ canvas, title, state }, k) => {
      pen.drawImage(canvas, k * width, 0, width, height);
      Object.assign(pen, { fillStyle: "#20282e", textBaseline: "top" });
      pen.font = `600 ${Math.round(17 * scale)}px system-ui, sans-serif`;
      pen.fillText(title(), k * width + 14 * scale, 12 * scale, width - 28 * scale);
      pen.font = `${Math.round(15 * scale)}px system-ui, sans-serif`;
      pen.fillText(state(), k * width + 14 * scale, height - 30 * scale, width - 28 * scale);
    });
  }

  stop() {
    if (this.recorder.state !== "inactive") this.recorder.stop();
  }
}

const even = (length) => 2 * Math.round(length / 2);

/** Offer a file to the user. */
export function download(file, name) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(file), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
