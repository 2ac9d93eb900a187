// Showing with something red before the camera. Pictures are looked at here and go nowhere.

const [ACROSS, DOWN] = [160, 120];
/** How far red must exceed green and blue [of 255]. */
const REDNESS = 70;
/** Smallest blob [px] that counts as something held in the hand. */
const SMALLEST = 25;

export class Webcam {
  /**
   * @param {HTMLCanvasElement} picture - where the mirrored picture is shown.
   * @param {(place: number[] | null, t_ms: number) => void} seen - shares of width and height.
   */
  constructor(picture, seen) {
    Object.assign(this, { picture, seen });
    this.context = picture.getContext("2d", { willReadFrequently: true });
  }

  /** Whether the camera is on. */
  get on() {
    return Boolean(this.stream);
  }

  /** Switch the camera on; rejects where there is none or it is not allowed. */
  async start() {
    const wanted = { video: { width: 640, height: 480, facingMode: "user" }, audio: false };
    this.stream = await navigator.mediaDevices.getUserMedia(wanted);
    this.video = Object.assign(document.createElement("video"), { muted: true, playsInline: true });
    this.video.srcObject = this.stream;
    await this.video.play();
    this.#next();
  }

  stop() {
    this.stream?.getTracks().forEach((track) => track.stop());
    this.stream = null;
  }

  #next() {
    if (!this.stream) return;
    const look = (now) => {
      if (this.stream) this.#look(now);
      this.#next();
    };
    if (this.video.requestVideoFrameCallback) this.video.requestVideoFrameCallback(look);
    else setTimeout(() => look(performance.now()), 33);
  }

  #look(now) {
    const context = this.context;
    context.setTransform(-1, 0, 0, 1, ACROSS, 0);
    context.drawImage(this.video, 0, 0, ACROSS, DOWN);
    context.setTransform(1, 0, 0, 1, 0, 0);
    const place = reddest(context.getImageData(0, 0, ACROSS, DOWN).data, ACROSS, DOWN);
    if (place) {
      context.strokeStyle = "#ffffff";
      context.lineWidth = 2;
      context.beginPath();
      context.arc(place[0] * ACROSS, place[1] * DOWN, 8, 0, 2 * Math.PI);
      context.stroke();
    }
    this.seen(place, now);
  }
}

/** Return the middle of the largest red blob in shares of width and height; null without one. */
export function reddest(pixels, across, down) {
  const red = new Uint8Array(across * down);
  for (let i = 0; i < red.length; i += 1) {
    red[i] = pixels[4 * i] - Math.max(pixels[4 * i + 1], pixels[4 * i + 2]) > REDNESS ? 1 : 0;
  }
  let best = null;
  for (let i = 0; i < red.length; i += 1) {
    if (!red[i]) continue;
    const blob = flooded(red, i, across);
    if (blob.count >= SMALLEST && blob.count > (best?.count ?? 0)) best = blob;
  }
  if (!best) return null;
  return [(best.x / best.count + 0.5) / across, (best.y / best.count + 0.5) / down];
}

/** Take a blob out of the marked pixels; return its size and the sums of its coordinates. */
function flooded(red, from, across) {
  const blob = { count: 0, x: 0, y: 0 };
  const left = [from];
  red[from] = 0;
  while (left.length) {
    const at = left.pop();
    const x = at % across;
    blob.count += 1;
    blob.x += x;
    blob.y += (at - x) / across;
    const around = [at - across, at + across];
    if (x > 0) around.push(at - 1);
    if (x < across - 1) around.push(at + 1);
    for (const near of around) {
      if (red[near]) {
        red[near] = 0;
        left.push(near);
      }
    }
  }
  return blob;
}
