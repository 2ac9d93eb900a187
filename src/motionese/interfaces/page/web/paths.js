// Paths in the view: rows of [t_ms, x, y].

const STROKE_MS = 1200;
const REST_MS = 250;
const STEP_MS = 1000 / 60;

/** Return a motion through places [x, y] of the view, with minimum-jerk strokes and short rests. */
export function pathThrough(places, from = 0) {
  const rows = [];
  let t = from;
  for (const [a, b] of places.slice(1).map((place, i) => [places[i], place])) {
    const until = t + STROKE_MS + REST_MS;
    for (let now = t; now < until; now += STEP_MS) {
      const s = minimumJerk(Math.min((now - t) / STROKE_MS, 1));
      rows.push([now, a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])]);
    }
    t = until;
  }
  return rows;
}

const minimumJerk = (s) => s ** 3 * (10 - 15 * s + 6 * s * s);

/** Return the number of rows of a path up to a time. */
export function rowsUntil(path, t) {
  let count = 0;
  while (count < path.length && path[count][0] <= t) count += 1;
  return count;
}
