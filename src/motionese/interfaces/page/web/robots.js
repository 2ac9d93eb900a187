// The robots of the session: which is being taught, switched by name; and the dialog for a new one.

import { allowed, made, part, say } from "./dom.js";

/** Let robots be begun; `send` says so. */
export function robotsBegun(send) {
  const dialog = part("begin-dialog");
  dialog.addEventListener("close", () => {
    const chosen = dialog.returnValue;
    dialog.returnValue = "";
    if (!chosen) return;
    const form = dialog.querySelector("form");
    const { name, grows, away = "" } = Object.fromEntries(new FormData(form));
    form.reset();
    send({ type: "begin", with: chosen, grows, name, away });
  });
}

/** Show the robots, the taught one pressed, and prepare the dialog; `teach(id)` switches. */
export function showRobots({ robots, taught, most }, teach) {
  const list = part("robots");
  const focused = list.contains(document.activeElement) && document.activeElement.dataset.robot;
  list.replaceChildren(
    ...robots.map(({ id, name }) => {
      const state = { type: "button", "aria-pressed": id === taught, title: name };
      const it = made("button", "quiet small", name, { ...state, "data-robot": id });
      it.toggleAttribute("data-free", true);
      it.addEventListener("click", () => allowed(it) && teach(id));
      return made("li", "", it);
    }),
  );
  if (focused) list.querySelector(`[data-robot="${focused}"]`)?.focus();
  const isFull = robots.length >= most;
  part("begin-away").hidden = !isFull;
  part("begin-away-label").hidden = !isFull;
  part("begin-away").disabled = !isFull;
  const options = robots.map(({ id, name }) => made("option", "", name, { value: id }));
  part("begin-away").replaceChildren(...options);
  const full = `A session has ${most} robots at most: one of them must be put away for it.`;
  say(part("begin-room"), isFull ? full : "The others stay as they are.");
}
