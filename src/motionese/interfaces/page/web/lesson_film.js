// A lesson as a short film to show to others: the first try, every practice, the one that was kept.

import { colours, part, say } from "./dom.js";
import { inWords, primitivesOf, read } from "./task.js";

/** Pictures a second: a GIF counts hundredths of a second, and this is eight of them. */
const HZ = 12.5;
/** A film lasts so long at most; the first try and the last take what practices and the end leave. */
const MOST_S = 15;
const [PRACTICE_S, REST_S, CLOSING_S] = [0.8, 0.3, 2.8];
const GIVE_BACK_MS = 60_000;

/** Return the parts of a film {seconds, speed, attempt, rest, last}: tries, and how each is played. */
export function timeline(lasts, attempts, kept) {
  const practices = attempts - 1;
  const left = MOST_S - CLOSING_S - practices * (PRACTICE_S + REST_S) - REST_S;
  const slow = Math.max(1, (2 * lasts) / left);
  const played = (attempt, speed, rest) => {
    return { attempt, speed, seconds: lasts / speed + rest };
  };
  const quick = lasts / PRACTICE_S;
  return [
    played(0, slow, REST_S),
    ...Array.from({ length: practices }, (_, i) => played(i + 1, quick, REST_S)),
    { ...played(kept, slow, CLOSING_S), last: true },
  ];
}

export class LessonFilm {
  /** `stage` has the robot as it is looked at; `tell` says what has become of the film. */
  constructor(stage, tell) {
    Object.assign(this, { stage, tell, lesson: null, making: false, made: null });
    part("film").addEventListener("click", () => (this.making ? this.cancel() : this.#make()));
  }

  /** Take the `scene` in which all this happens. */
  take(scene) {
    this.scene = scene;
  }

  /** Take all tries of a lesson, what it has brought, and what its robot is called. */
  learned(tries, result, robot) {
    this.lesson = { tries, result, robot };
    this.#label();
  }

  /** Forget the lesson. */
  drop() {
    this.cancel();
    this.lesson = null;
    this.#label();
  }

  /** Leave off. */
  cancel() {
    this.making = false;
  }

  async #make() {
    this.making = true;
    this.#label(0);
    let writer;
    try {
      // What draws and writes is large: it is fetched by those alone who want a film.
      const { FilmPicture, HEIGHT, WIDTH } = await import("./film_picture.js");
      const { filmWriter } = await import("./film_writer.js");
      writer = await filmWriter(WIDTH, HEIGHT, HZ);
      const { robot } = this.stage;
      const seconds = await this.#write(
        writer,
        new FilmPicture(this.scene, this.lesson, robot, colours()),
      );
      if (this.making) this.#save(await writer.file(), seconds, nameOf(this.lesson, writer.suffix));
      else this.tell("The film was left off.");
    } catch (error) {
      this.tell(`The film could not be made: ${error.message}`);
    } finally {
      writer?.drop();
      this.making = false;
      this.#label();
    }
  }

  /** Draw picture after picture; return how long the film is [s]. */
  async #write(writer, picture) {
    const { tries, result } = picture.lesson;
    const { poses, rate_hz: rate } = tries[0].film;
    const parts = timeline((poses.length - 1) / rate, tries.length, result.kept);
    const seconds = parts.reduce((sum, one) => sum + one.seconds, 0);
    const count = Math.round(seconds * HZ);
    try {
      for (let i = 0; i < count && this.making; i += 1) {
        picture.draw(...momentOf(parts, i / HZ));
        await writer.add(picture.canvas);
        this.#label(i / count);
      }
    } finally {
      picture.release();
    }
    return count / HZ;
  }

  #save(file, seconds, name) {
    const link = document.createElement("a");
    Object.assign(link, { href: URL.createObjectURL(file), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), GIVE_BACK_MS);
    this.made = { name, seconds, bytes: file.size };
    this.tell(`The film is saved as ${name} (${seconds.toFixed(0)} s).`);
  }

  #label(share = null) {
    const button = part("film");
    button.hidden = !this.lesson;
    if (!this.lesson) return;
    say(button, share === null ? "Film" : `Cancel ${Math.round(100 * share)} %`);
    const motion = inWords(this.lesson.result.motion);
    const does = `Save the last lesson as a short film: ${motion}`;
    button.setAttribute("aria-label", share === null ? does : "Cancel the film");
    button.title = share === null ? does : "Cancel the film";
  }
}

/** Return the part of a film that is shown at a time [s], and the time in it. */
function momentOf(parts, time) {
  let begin = 0;
  const found = parts.find((one) => {
    begin += one.seconds;
    return time < begin;
  });
  const one = found ?? parts.at(-1);
  return [one, found ? time - begin + one.seconds : one.seconds];
}

/** Return a file's name that tells motion and robot. */
function nameOf({ result: { motion }, robot }, suffix) {
  const { start } = read(motion);
  const ways = start ? [start, ...primitivesOf(motion).map(({ words }) => words)] : [motion];
  return `${slug(["motionese", ...ways, robot].join("-"))}.${suffix}`;
}

const slug = (text) => {
  const plain = text.toLowerCase().normalize("NFKD");
  return plain.replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "");
};
