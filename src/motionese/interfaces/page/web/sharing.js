// The whole session as one file: sent to the robot to be opened. Saving it is a link.

import { allowed, part } from "./dom.js";

const MOST_BYTES = 64 * 2 ** 20;

/** Let a session's file be opened; `send` asks for it once it has arrived, `tell` says why not. */
export function openable(send, tell) {
  const [button, file] = [part("open"), part("open-file")];
  button.addEventListener("click", () => allowed(button) && file.click());
  file.addEventListener("change", async () => {
    const [chosen] = file.files;
    if (!chosen) return;
    tell("Looking at the file …");
    const sent = await arrived(chosen);
    file.value = "";
    if (sent.file) send({ type: "open", file: sent.file });
    else tell(sent.sentence);
  });
}

/** Send a file; return its name there, or why it was refused. */
async function arrived(chosen) {
  if (chosen.size > MOST_BYTES) return { sentence: "This file is larger than a session can be." };
  try {
    const answer = await fetch("session.motionese", { method: "POST", body: chosen });
    return answer.ok ? await answer.json() : { sentence: await answer.text() };
  } catch {
    return { sentence: "The file did not arrive; try again." };
  }
}
