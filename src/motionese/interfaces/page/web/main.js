// The page: what arrives goes to the parts that show it, what a person does goes to the robot.

import { showBelief } from "./belief.js";
import { showComparison } from "./comparison.js";
import { showCurves } from "./curves.js";
import { furnish, listMotions, notice, showProgress, tell, tidy } from "./desk.js";
import { onScheme, part, prefersStillness, say } from "./dom.js";
import { showEmergence } from "./emergence.js";
import { explain } from "./explain.js";
import { Ghost } from "./ghost.js";
import { Lesson } from "./lesson.js";
import { LessonFilm } from "./lesson_film.js";
import { Live } from "./live.js";
import { showManner } from "./manner.js";
import { StateMap } from "./map.js";
import { furnishNaming } from "./naming.js";
import { showGrown, showNotebook } from "./notebook.js";
import { pathAlong } from "./paths.js";
import { Playback } from "./playback.js";
import { Pace } from "./playing.js";
import { robotsBegun, showRobots } from "./robots.js";
import { openable } from "./sharing.js";
import { Showing } from "./showing.js";
import { Stage } from "./stage.js";
import { primitivesOf, read, takeTask, task } from "./task.js";
import {
  clearVerdict,
  showClaim,
  showMotion,
  showResult,
  showSaw,
  showUnderstanding,
  showVerdict,
} from "./verdict.js";
import { View } from "./view.js";

const now = {
  connection: "lost",
  yours: true,
  worker: { state: "starting", sentence: "" },
  scene: null,
  session: {
    id: "",
    notebook: [],
    curves: [],
    began: "",
    watched: [],
    phase: 1,
    levels: [],
    busy: "",
    suggest: "",
    chapter: null,
    shown: null,
    can_grow: false,
  },
  robots: 0,
  robot: "",
  step: "",
  verdict: null,
  performed: null,
  learned: null,
  replayed: null,
  grown: null,
  awaited: false,
  touched: false,
  pending: null,
  understandings: 0,
  saw: 0,
};

const send = (message) => live.send(message);
const view = new View({ ground: part("ground"), ink: part("ink"), surface: part("surface") });
const ghost = new Ghost(view, new Pace(24));
const stage = new Stage(() => view.refresh());
/** Whether the robot's arm follows the pen. */
const follows = () => part("follow").checked;
const playback = new Playback(stage, view, () => refresh());
const lessonFilm = new LessonFilm(stage, tell);
const lesson = new Lesson(playback, (learned, tries) => {
  lessonFilm.learned(tries, learned, now.robot);
  Object.assign(now, { learned, step: "learned" });
  showMotion(learned.motion);
  showClaim(learned.claim);
  say(part("attempt"), `${learned.motion}: ${learned.after_cm.toFixed(1)} cm off`);
  refresh();
});
const map = new StateMap((slow, primitive) => send({ type: "hover", slow, primitive }));
const showing = new Showing(view, {
  may() {
    if (canWatch() && now.session.busy) tell("One moment: the robot is busy. You can press Stop.");
    return canWatch() && !now.session.busy;
  },
  follows,
  send,
  tell,
  began,
  ended,
  touched,
  changed: refresh,
});
const live = new Live((message) => {
  heard[message.type]?.(message);
  refresh();
}, connectionChanged);

/** What is done with every kind of message. */
const heard = {
  scene(message) {
    now.scene = message;
    takeTask(message.task, message.view.aspect);
    stage.take(message);
    lessonFilm.take(message);
    view.take((width, height) => stage.seen(message.view.camera, width, height));
    listMotions(message.task.motions);
  },
  session(message) {
    if (message.id !== now.session.id) beginAnew();
    else if (isUndone(message)) takenBack(message);
    now.session = message;
    showCurves(part("chart-curve"), message.curves, message.grown);
    showNotebook(
      part("notebook"),
      message.notebook,
      (entry) => send({ type: "replay", entry }),
      (entry) => send({ type: "forget", entry }),
    );
    showManner(message.manner);
    if (!message.busy) lesson.stopped();
  },
  robots(message) {
    now.robots = message.robots.length;
    now.robot = message.robots.find(({ id }) => id === message.taught).name;
    showRobots(message, (robot) => send({ type: "teach", robot }));
    showComparison(
      message,
      (robot, name) => send({ type: "call", robot, name }),
      (robot) => {
        touched();
        if (send({ type: "repeat", robot })) toTheStage();
      },
    );
  },
  understanding(message) {
    now.understandings += 1;
    if (!showing.drawing && !ghost.plays) return;
    showUnderstanding(message);
    showBelief(message.belief);
    view.mark({ recognised: message.path, next: message.next });
  },
  shown({ path }) {
    touched();
    clearResult();
    ghost.play(path, () => {
      judge();
      refresh();
    });
  },
  saw(message) {
    if (ghost.plays) return;
    now.saw += 1;
    showSaw(message);
  },
  verdict(message) {
    now.verdict = now.pending = message;
    now.awaited = false;
    if (!ghost.plays) judge();
  },
  frames(message) {
    if (message.from === 0) {
      explore(false);
      playback.close();
    }
    stage.perform(message);
  },
  performed(message) {
    now.performed = message;
    now.step = "performed";
    showResult(message);
    view.mark({ recognised: null, next: null });
    playback.load({ ...message, motion: motionOf(message.entry), film: stage.film });
    say(part("attempt"), `Attempt ${message.attempt}: ${message.error_cm.toFixed(1)} cm off`);
  },
  progress: showProgress,
  practice(message) {
    explore(false);
    view.mark({ recognised: null, next: null });
    lesson.take(message);
  },
  learned(message) {
    lesson.learned(message);
  },
  replayed(message) {
    explore(false);
    clearResult();
    Object.assign(now, { replayed: message, step: "replayed" });
    showMotion(message.motion);
    view.mark({ drawn: message.drawn });
    const { attempt, error_cm: error, motion } = message;
    say(part("attempt"), `${motion}, try ${attempt}: ${error.toFixed(1)} cm off`);
    playback.load(message);
    if (!prefersStillness()) playback.play(1);
    toTheStage(part("robot"));
  },
  grown(message) {
    Object.assign(now, { grown: message, step: "grown" });
    showClaim(null);
    showGrown(part("grown"), message);
  },
  map(message) {
    map.take(message);
  },
  hovered(message) {
    if (explores() && map.isChosen(message)) view.mark({ hovered: message.path });
  },
  emergence(message) {
    say(part("emergence-note"), message.sentence);
    showEmergence(part("emergence"), message);
    map.clear();
    if (explores()) send({ type: "map" });
  },
  worker(message) {
    if (message.state === "ready" && now.worker.state === "restarted") {
      tell("The robot is awake again, and knows what you taught it.");
    }
    now.worker = message;
    if (message.state === "restarted" || message.state === "failed") leave();
  },
  owner({ yours, sentence }) {
    now.yours = yours;
    if (!yours) leave();
    notice(yours ? "" : sentence, true);
  },
  begun: beginAnew,
  told({ sentence }) {
    now.awaited = false;
    tell(sentence);
  },
};

const isReady = () => now.connection === "open" && now.yours && now.worker.state === "ready";

/** What is shown to a robot that is still waking up is understood as soon as it is awake. */
function canWatch() {
  const isWaking = now.scene && now.worker.state === "starting";
  return now.connection === "open" && now.yours && (now.worker.state === "ready" || isWaking);
}

function connectionChanged(state, reason) {
  now.connection = state;
  if (state !== "open") leave();
  if (state === "refused") tell(`The robot closed the connection: ${reason}.`);
  notice(state === "open" ? "" : "The connection to the robot is lost. Trying again …");
  refresh();
}

/** Leave what was under way: the robot is not there to see it, or its end will not come. */
function leave() {
  now.awaited = false;
  lesson.drop();
  playback.stop();
  showing.drop();
  stage.stop();
  ghost.stop();
}

/** Forget what was shown of another robot. */
function beginAnew() {
  Object.assign(now, { touched: false, learned: null, grown: null });
  explore(false);
  clearResult();
  say(part("attempt"), "What the robot does");
  stage.clear();
  map.clear();
  lessonFilm.drop();
  part("grown").hidden = true;
}

/** Whether the map is seen, in the robot's place. */
const explores = () => !part("explore").hidden;

/** Show the map beside the eye view, or the robot again. */
function explore(on) {
  if (on === explores()) return;
  part("explore").hidden = !on;
  part("body").hidden = on;
  part("stage").classList.toggle("exploring", on);
  if (on) {
    if (!map.map) send({ type: "map" });
    part("map").focus({ preventScroll: true });
    toTheStage(part("view"), part("map"));
  } else {
    if (document.activeElement === document.body) part("map-draw").focus({ preventScroll: true });
    view.mark({ hovered: null });
  }
  refresh();
}

function touched() {
  now.touched = true;
  ghost.stop();
}

function clearResult() {
  Object.assign(now, { verdict: null, pending: null, performed: null, step: "" });
  lesson.drop();
  playback.close();
  clearVerdict();
  showBelief([]);
  view.clearInk();
  view.mark({
    recognised: null,
    next: null,
    done: null,
    drawn: null,
    hovered: null,
    shown: null,
    hand: null,
    plan: null,
  });
}

function began() {
  clearResult();
  say(part("attempt"), "What the robot does");
  stage.hold(!follows());
  refresh();
}

function ended() {
  now.awaited = true;
  stage.hold(false);
  refresh();
}

/** Show the verdict that has arrived; one on a demonstration waits until that has been seen. */
function judge() {
  const verdict = now.pending;
  if (!verdict) return;
  now.pending = null;
  now.step = "judged";
  showVerdict(verdict);
  showBelief([]);
  view.clearInk();
  view.mark({
    drawn: verdict.drawn,
    recognised: verdict.path,
    next: verdict.next,
    shown: null,
    hand: null,
  });
}

/** Return the motion to be shown next: what was never shown, else what goes worst. */
function nextMotion() {
  const { chapter, phase: strokes } = now.session;
  if (chapter?.act === "show") return chapter.motion;
  const known = task.motions.filter((motion) => read(motion).signs.length === strokes);
  const errors = new Map(now.session.notebook.map((e) => [e.motion, e.errors.at(-1) ?? Infinity]));
  const fresh = known.find((motion) => !errors.has(motion));
  return fresh ?? known.toSorted((a, b) => errors.get(b) - errors.get(a))[0] ?? "";
}

/** Whether something is no longer in the notebook. */
function isUndone({ notebook }) {
  const left = new Set(notebook.map(({ entry }) => entry));
  return now.session.notebook.some(({ entry }) => !left.has(entry));
}

/** Say no longer what is not so any more: of what was undone, or by a network that is no more. */
function takenBack({ shown }) {
  if (shown === null) clearResult();
  now.step = "";
  showClaim(null);
  say(part("attempt"), "What the robot does");
}

const motionOf = (entry) => now.session.notebook.find((one) => one.entry === entry)?.motion ?? "";

/** Show what the robot was shown last where nothing else is: that is what it would imitate. */
function remember() {
  const isIdle =
    !showing.drawing && !ghost.plays && !now.awaited && !now.pending && !now.session.busy;
  if (!isIdle || now.step || now.session.shown === null || view.marks.drawn?.length) return;
  view.mark({ drawn: now.session.watched });
  showMotion(motionOf(now.session.shown));
}

/** Bring the stage into the window where some parts of it are not, as on a phone. */
function toTheStage(...wanted) {
  const places = wanted.map((one) => one.getBoundingClientRect());
  if (places.every(({ top, bottom }) => top >= 0 && bottom <= innerHeight)) return;
  part("stage").scrollIntoView({
    behavior: prefersStillness() ? "auto" : "smooth",
    block: "start",
  });
}

function invite() {
  const isFirst = now.session.id && now.session.notebook.length === 0;
  const wanted = canWatch() && now.scene && isFirst && !now.touched && !now.session.busy;
  if (!wanted || ghost.plays) return;
  const ways = primitivesOf(nextMotion()).map(({ way }) => way);
  if (ways.length) ghost.invite(pathAlong(ways));
}

/** Bring everything that depends on the whole state up to date. */
function refresh() {
  invite();
  remember();
  tidy({
    ...now,
    ready: isReady(),
    watching: canWatch(),
    lines: {
      drawn: showing.drawing || view.marks.drawn?.length,
      understood: view.marks.recognised?.length,
      next: view.marks.next?.length,
      done: view.marks.done?.length,
      first: view.marks.first?.length,
      hovered: view.marks.hovered?.length,
    },
    practising: lesson.plays,
    drawing: showing.drawing,
    webcam: showing.filmed,
    keyed: showing.keyed,
    ghost: ghost.plays && now.touched,
    busy: now.session.busy || (now.awaited ? "recognising" : ""),
    mapped: Boolean(map.map),
    next: nextMotion(),
  });
}

furnishNaming(send);
explain();
const watch = () => toTheStage(part("robot"));
furnish(send, touched, watch, explore, () => live.greet(true));
robotsBegun(send);
openable(send, tell);
onScheme(() => view.refresh());
live.connect();
refresh();

window.teach = {
  /** What tests ask for. */
  state: () => ({
    verdict: now.verdict,
    understandings: now.understandings,
    saw: now.saw,
    points: showing.sent,
    frames: stage.frames,
    notebook: now.session.notebook.length,
    phase: now.session.phase,
    robots: now.robots,
    session: now.session.id,
    busy: now.session.busy,
    step: now.step,
    hand: view.marks.hand?.slice(-2),
    ready: isReady(),
    watching: Boolean(canWatch()),
    drawing: showing.drawing,
    performed: now.performed,
    learned: now.learned,
    drawn3d: Boolean(stage.robot),
    tries: lesson.shown,
    at: playback.at,
    plays: playback.plays,
    ghostly: Boolean(playback.first),
    point: map.cell,
    hovered: view.marks.hovered ?? null,
    film: lessonFilm.made,
  }),
  /** Where a place [x, y] of the view lies in the window. */
  pixel(place) {
    const box = part("surface").getBoundingClientRect();
    return [box.left + place[0] * box.width, box.top + place[1] * box.height];
  },
  /** Where a place of the task lies in the view. */
  place: (name) => task.places[name].at,
};
