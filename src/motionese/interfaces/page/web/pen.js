// Drawing with mouse, pen or touch: every sample the device took, with the time it was taken.

/**
 * Let a surface be drawn on.
 *
 * @param {HTMLElement} surface
 * @param {object} to - `at(x, y)` turns a place in the window into one in the view; `down(point)`
 *   says whether a drawing may begin; `move(points)` and `up()` follow it. Points: [t_ms, x, y].
 */
export function drawable(surface, to) {
  let pointer = null;
  const sample = (event) => [event.timeStamp, ...to.at(event.clientX, event.clientY)];

  surface.addEventListener("pointerdown", (event) => {
    if (pointer !== null || event.button !== 0) return;
    if (!to.down(sample(event))) return;
    pointer = event.pointerId;
    surface.setPointerCapture(pointer);
  });
  surface.addEventListener("pointermove", (event) => {
    if (event.pointerId !== pointer) return;
    const taken = event.getCoalescedEvents();
    to.move((taken.length ? taken : [event]).map(sample));
  });
  const ended = (event) => {
    if (event.pointerId !== pointer) return;
    pointer = null;
    to.up();
  };
  for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) {
    surface.addEventListener(name, ended);
  }
}
