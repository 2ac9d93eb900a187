// Paths in the view: rows of [t_ms, x, y].

const STROKE_MS = 1200;
const REST_MS = 250;
const STEP_MS = 1000 / 60;

/** Return a motion along ways, each through places [x, y], with minimum-jerk strokes and rests. */
export function pathAlong(ways, from = 0) {
  const rows = [];
  let t = from;
  for (const way of ways) {
    const until = t + STROKE_MS + REST_MS;
    for (let now = t; now < until; now += STEP_MS) {
      rows.push([now, ...placeOn(way, minimumJerk(Math.min((now - t) / STROKE_MS, 1)))]);
    }
    t = until;
  }
  return rows;
}

/** Return the straight ways from place to place. */
export const waysThrough = (places) => places.slice(1).map((place, i) => [places[i], place]);

function placeOn(way, share) {
  const at = share * (way.length - 1);
  const index = Math.min(Math.floor(at), way.length - 2);
  return way[index].map((value, k) => value + (at - index) * (way[index + 1][k] - value));
}

const minimumJerk = (s) => s ** 3 * (10 - 15 * s + 6 * s * s);

/** Return the number of rows of a path up to a time. */
export function rowsUntil(path, t) {
  let count = 0;
  while (count < path.length && path[count][0] <= t) count += 1;
  return count;
}
