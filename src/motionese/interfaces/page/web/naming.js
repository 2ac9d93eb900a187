// Motions of one's own get a name, which is typed.

import { made, part } from "./dom.js";

let renamed;

/** Let the dialog work; `send` gets what is to be renamed. */
export function furnishNaming(send) {
  const dialog = part("name-dialog");
  dialog.addEventListener("close", () => {
    const name = part("name").value.trim();
    if (dialog.returnValue === "name" && name && name !== renamed)
      send({ type: "rename", motion: renamed, name });
    dialog.returnValue = "";
  });
}

/** Return the name of a motion of one's own, to be pressed for another. */
export function named(motion) {
  const button = made("button", "named", motion, {
    type: "button",
    "data-testid": "name",
    "aria-label": `${motion}: give it a name`,
    title: "Give it a name",
  });
  button.addEventListener("click", () => ask(motion));
  return button;
}

function ask(motion) {
  renamed = motion;
  part("name").value = motion;
  part("name-dialog").showModal();
  part("name").select();
}
