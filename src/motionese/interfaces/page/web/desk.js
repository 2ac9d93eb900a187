// The desk around the view: the one line, buttons and what they do, and passing messages.

import { allow, allowed, made, part, say } from "./dom.js";
import { chapterInWords, due, guide } from "./guide.js";
import { showNetwork } from "./network.js";
import { read, withPlaces } from "./task.js";

const TOAST_MS = 7000;
/** What takes long enough for a bar, and can be stopped. */
const LONG = ["learning", "growing", "comparing"];
/** The buttons of what is to be done. */
const NEXT = { imitate: "imitate", learn: "learn", grow: "grow", map: "map-draw" };
const PHASES = { 1: "Phase 1: single strokes", 2: "Phase 2: sequences" };

/**
 * Let every button do what it is for; `touched()` is called before, `seen()` where one must look,
 * `explore(on)` where the map is to be seen, or the robot again.
 */
export function furnish(send, touched, seen, explore, takeOver) {
  const pressed = {
    demonstrate: () => send({ type: "demonstrate", motion: part("motions").value }),
    imitate: () => send({ type: "imitate" }) && seen(),
    learn: () => send({ type: "learn" }) && seen(),
    grow: () => send({ type: "grow" }),
    compare: () => send({ type: "compare" }),
    "map-draw": () => explore(true),
    "map-close": () => explore(false),
    stop: () => send({ type: "stop" }),
    begin: () => part("begin-dialog").showModal(),
    "take-over": takeOver,
  };
  for (const [id, act] of Object.entries(pressed)) {
    part(id).addEventListener("click", () => {
      if (!allowed(part(id))) return;
      touched();
      act();
    });
  }
}

/** Offer the motions that can be shown by themselves. */
export function listMotions(motions) {
  const groups = ["One stroke", "Two strokes", "Three strokes"].map((label, i) => {
    const those = motions.filter((motion) => read(motion).signs.length === i + 1);
    return made(
      "optgroup",
      "",
      those.map((m) => made("option", "", m, { value: m })),
      { label },
    );
  });
  part("motions").replaceChildren(...groups.filter((group) => group.children.length));
}

/** Bring the desk up to date with the state of everything. */
export function tidy(now) {
  const { session, scene } = now;
  const open = now.connection === "open";
  document.body.dataset.state = !open ? "lost" : now.ready ? "ready" : "connecting";
  say(part("connection"), connectionInWords(now, open));
  say(part("phase"), PHASES[session.phase] ?? `Phase ${session.phase}`);
  speak(guide(now));
  // While it is played what comes of it, the chapter is what it was.
  if (!session.busy && !now.practising) say(part("chapter"), chapterInWords(session));
  say(part("network-note"), session.suggest || "Levels, from fast to slow.");
  const free = now.ready && !session.busy && !now.drawing;
  const enabled = {
    demonstrate: free,
    begin: free,
    compare: free,
    open: free,
    webcam: now.watching,
    "webcam-show": now.watching,
    imitate: free && session.shown !== null,
    learn: free && session.shown !== null,
    grow: free && session.can_grow,
    "map-draw": free,
    stop: Boolean(session.busy),
  };
  for (const [id, on] of Object.entries(enabled)) allow(part(id), on);
  for (const button of document.querySelectorAll("button[data-free]")) allow(button, free);
  for (const name of part("comparison").querySelectorAll("input")) name.readOnly = !free;
  part("motions").disabled = !free;
  const { act } = due(now);
  for (const [id, button] of Object.entries(NEXT))
    part(button).classList.toggle("next", act === id);
  const isLong = LONG.includes(session.busy);
  // A button that goes does not take the focus with it.
  if (!isLong && document.activeElement === part("stop")) part("learn").focus();
  part("progress").classList.toggle("on", isLong);
  part("skip").hidden = !now.practising;
  say(part("origin"), origin(session.began));
  for (const line of part("legend").children) line.hidden = !now.lines[line.className];
  part("legend").hidden = !Object.values(now.lines).some(Boolean);
  part("notebook-empty").hidden = session.notebook.length > 0;
  offerExport(session.notebook.length > 0);
  if (scene) showNetwork(part("network"), scene.levels, session.levels, scene.channels);
}

/** Say the one line, once, with its places as they are in the view. */
function speak(sentence) {
  if (part("guide").textContent === sentence) return;
  part("guide").replaceChildren(made("span", "", withPlaces(sentence)));
}

/** Return which robot this is. */
function origin(began) {
  if (!began) return "";
  return (
    { babbling: "A robot that began by babbling", fresh: "A newborn robot" }[began] ??
    `Robot of ${began}`
  );
}

/** A link without an address can be neither pressed nor reached by keys. */
function offerExport(isOffered) {
  const link = part("export");
  link.setAttribute("aria-disabled", String(!isOffered));
  if (isOffered) link.setAttribute("href", "export.npz");
  else link.removeAttribute("href");
}

function connectionInWords(now, open) {
  if (!open) return "No connection";
  if (!now.yours) return "Taught on another page";
  return now.ready ? "The robot is awake" : "The robot is waking up";
}

/** Show how far something is. */
export function showProgress({ what, done, of, loss }) {
  part("progress-bar").value = of ? done / of : 0;
  const reached = loss === undefined ? "" : ` · loss ${loss.toPrecision(2)}`;
  say(part("progress-text"), `${what} ${done} of ${of}${reached}`);
}

let toasting;

/** Say something for a few seconds. */
export function tell(sentence) {
  if (!sentence) return;
  clearTimeout(toasting);
  part("toast").hidden = false;
  say(part("toast"), sentence);
  toasting = setTimeout(() => (part("toast").hidden = true), TOAST_MS);
}

/** Say what keeps the page from its robot; nothing where nothing does. */
export function notice(sentence, mayTakeOver = false) {
  part("notice").hidden = !sentence;
  say(part("notice-text"), sentence);
  part("take-over").hidden = !mayTakeOver;
}
