// All robots side by side: what they are, what they had, and what each does of the same motions.

import { allowed, made, part, titled } from "./dom.js";
import { pictured } from "./task.js";

const GROWS = { told: "when you say", beginning: "from the beginning", never: "never" };
const UNKNOWN = "–";

/** Rows of the table, each with what is said of a robot. */
const ROWS = [
  ["Grows", ({ grows }) => GROWS[grows]],
  ["Levels open", ({ levels }) => levels.map(titled).join(", ")],
  ["Lessons", ({ lessons }) => lessons],
  ["Clear strokes", ({ clear }) => clear || UNKNOWN],
  ["Can do", ({ can, of }) => (can === null ? UNKNOWN : `${can} of ${of}`)],
  ["Mean error", ({ error_cm: error }) => (error === null ? UNKNOWN : cm(error))],
];

/** Show all robots; `call(id, name)` names one, `repeat(id)` gives its lessons to the taught one. */
export function showComparison({ robots, taught }, call, repeat) {
  const table = part("comparison");
  const focused = table.contains(document.activeElement) && document.activeElement.dataset.robot;
  const [head, body, foot] = ["thead", "tbody", "tfoot"].map((tag) => table.querySelector(tag));
  head.replaceChildren(line("", robots, (robot) => nameOf(robot, call), "col"));
  const own = robots.findIndex(({ id }) => id === taught);
  head.rows[0].cells[own + 1].setAttribute("aria-current", "true");
  const motions = robots.find(({ tries }) => tries)?.tries.map(({ motion }) => motion) ?? [];
  body.replaceChildren(
    ...ROWS.map(([title, of]) => line(title, robots, (robot) => `${of(robot)}`)),
    ...motions.map((motion) => line(pictured(motion), robots, (robot) => tryAt(robot, motion))),
  );
  const others = robots.filter(({ id, left }) => id !== taught && left);
  const again = (robot) => (others.includes(robot) ? lessonsFor(robots[own], robot, repeat) : "");
  foot.replaceChildren(...(others.length ? [line("", robots, again)] : []));
  if (focused) table.querySelector(`input[data-robot="${focused}"]`)?.focus();
}

function line(title, robots, cell, scope = "row") {
  const cells = robots.map((robot) =>
    made(scope === "col" ? "th" : "td", "", cell(robot), scope === "col" ? { scope } : {}),
  );
  return made("tr", "", [title ? made("th", "", title, { scope: "row" }) : made("td"), ...cells]);
}

function nameOf({ id, name }, call) {
  const it = made("input", "", [], {
    type: "text",
    value: name,
    maxlength: 24,
    autocomplete: "off",
    spellcheck: "false",
    "aria-label": `Name of ${name}`,
    "data-robot": id,
  });
  it.addEventListener("change", () => {
    if (it.value.trim()) call(id, it.value);
    else it.value = name;
  });
  return it;
}

function tryAt({ tries }, motion) {
  const found = tries?.find((one) => one.motion === motion);
  if (!found) return UNKNOWN;
  return found.good ? made("b", "", `✓ ${cm(found.error_cm)}`) : cm(found.error_cm);
}

function lessonsFor(own, { id, name, left }, repeat) {
  const label = left === 1 ? "Pass on 1 lesson" : `Pass on ${left} lessons`;
  const it = made("button", "small", label, {
    type: "button",
    "aria-label": `${label} of ${name} to ${own.name}`,
    title: `${own.name} is shown what ${name} was shown, and practises it`,
  });
  it.toggleAttribute("data-free", true);
  it.addEventListener("click", () => allowed(it) && repeat(id));
  return it;
}

const cm = (value) => `${value.toFixed(1)} cm`;
