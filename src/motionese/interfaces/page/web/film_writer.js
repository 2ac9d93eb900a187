// A film as a file: WebM where the browser can encode video by itself, elsewhere an animated GIF.
//
// Pictures come as quickly as they can be drawn and carry their own times, so that a film is as
// long on a slow machine as on a quick one; a MediaRecorder would take down how long they took.

import { ArrayBufferTarget, GIFEncoder, Muxer, applyPalette, quantize } from "./vendor/films.js";

const [BITS_A_SECOND, SECONDS_A_KEY, MOST_WAITING, COLOURS] = [2_500_000, 2, 4, 256];
const CODEC = { told: "vp8", written: "V_VP8" };

/** Let everything else on the page have its turn. */
export const breath = () => new Promise((done) => setTimeout(done, 0));

/** Return what writes a film of so many pictures a second, of so many pixels each. */
export async function filmWriter(width, height, hz) {
  const video = { codec: CODEC.told, width, height, framerate: hz, bitrate: BITS_A_SECOND };
  // Only pages of this machine, or those that come encrypted, have an encoder.
  const able = window.VideoEncoder && (await VideoEncoder.isConfigSupported(video)).supported;
  return able ? new WebmWriter(video) : new GifWriter(hz);
}

class WebmWriter {
  suffix = "webm";

  constructor(video) {
    const { width, height, framerate: hz } = video;
    Object.assign(this, { hz, count: 0, error: null });
    this.muxer = new Muxer({
      target: new ArrayBufferTarget(),
      video: { codec: CODEC.written, width, height, frameRate: hz },
    });
    this.encoder = new VideoEncoder({
      output: (chunk, described) => this.muxer.addVideoChunk(chunk, described),
      error: (error) => (this.error = error),
    });
    this.encoder.configure(video);
  }

  /** Add a picture; wait where the encoder lags behind. */
  async add(canvas) {
    const duration = 1e6 / this.hz;
    const frame = new VideoFrame(canvas, { timestamp: this.count * duration, duration });
    const keyFrame = this.count % Math.round(SECONDS_A_KEY * this.hz) === 0;
    this.encoder.encode(frame, { keyFrame });
    frame.close();
    this.count += 1;
    do await breath();
    while (this.encoder.encodeQueueSize > MOST_WAITING && !this.error);
    if (this.error) throw this.error;
  }

  /** Return the film. */
  async file() {
    await this.encoder.flush();
    this.muxer.finalize();
    return new Blob([this.muxer.target.buffer], { type: "video/webm" });
  }

  /** Leave off. */
  drop() {
    if (this.encoder.state !== "closed") this.encoder.close();
  }
}

class GifWriter {
  suffix = "gif";

  constructor(hz) {
    Object.assign(this, { delay: 1000 / hz, gif: GIFEncoder() });
  }

  async add(canvas) {
    const { width, height } = canvas;
    const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
    const palette = quantize(data, COLOURS);
    this.gif.writeFrame(applyPalette(data, palette), width, height, { palette, delay: this.delay });
    await breath();
  }

  async file() {
    this.gif.finish();
    return new Blob([this.gif.bytes()], { type: "image/gif" });
  }

  drop() {}
}
