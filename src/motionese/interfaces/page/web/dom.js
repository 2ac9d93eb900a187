// Finding and making elements. No element gets a style attribute: the page's policy forbids them.

/** Return the element with this id. */
export const part = (id) => document.getElementById(id);

/** Return a new element with a class, a text, and children. */
export function made(tag, name = "", content = [], attributes = {}) {
  const element = document.createElement(tag);
  if (name) element.className = name;
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...[content].flat());
  return element;
}

/** Return a new element of an SVG. */
export function shape(tag, attributes, text = "") {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text) element.textContent = text;
  return element;
}

/** Set a text only where it changes, so that a live region is not read out twice. */
export function say(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Return a level's name as it is written, such as "IO" or "Cf". */
export const titled = (name) => (name === "io" ? "IO" : name[0].toUpperCase() + name.slice(1));

/** Return the colours of the style sheet, which follow the light or dark scheme. */
export function colours() {
  const style = getComputedStyle(document.documentElement);
  const names = [
    "ink",
    "soft",
    "paper",
    "card",
    "band",
    "rule",
    "blue",
    "sky",
    "orange",
    "amber",
    "pink",
    "green",
    "button-right",
    "button-left",
    "hand",
    "crayon",
  ];
  return Object.fromEntries(
    names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]),
  );
}

const dark = matchMedia("(prefers-color-scheme: dark)");
const still = matchMedia("(prefers-reduced-motion: reduce)");

/** Whether the dark scheme is on. */
export const isDark = () => dark.matches;

/** Whether the visitor wants things not to move by themselves. */
export const prefersStillness = () => still.matches;

/** Let a button be pressed or not; one that may not keeps the focus that it has. */
export function allow(button, on) {
  button.setAttribute("aria-disabled", String(!on));
}

/** Whether a button may be pressed now. */
export const allowed = (button) => button.getAttribute("aria-disabled") !== "true";

/** Call when the scheme changes between light and dark. */
export const onScheme = (changed) => dark.addEventListener("change", changed);

/** Fit a canvas's pixels to its place in the page; return its context in CSS pixels. */
export function fitted(canvas) {
  const ratio = Math.min(window.devicePixelRatio || 1, 2);
  const { clientWidth: width, clientHeight: height } = canvas;
  const [across, down] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== across || canvas.height !== down) {
    canvas.width = across;
    canvas.height = down;
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { context, width, height };
}
