// What goes on inside: joint angles and the activity of the levels over time.

import { colours, fitted, made, onScheme, titled } from "./dom.js";
import { term } from "./explain.js";
import uPlot from "./vendor/uplot.js";

/** How much of the past is shown [s]. */
const SHOWN_S = 5;
const DEGREES = 180 / Math.PI;
/** Levels of more units are shown as heat. */
const MOST_LINES = 8;
const LETTERS = "abcdef";
/** Steps of the time axis [s]. */
const SECONDS = [0.5, 1, 2, 5];
const inSeconds = (value) => `${value} s`;
/** Heat is drawn where lines are: beside their numbers, above the time. */
const [BESIDE, ABOVE, RIM] = [30, 17, 4];

const font = () => `11px ${getComputedStyle(document.body).fontFamily}`;

/** Lines over time in a small place. */
class Lines {
  constructor(place, series, { range, incrs, unit = "" }) {
    Object.assign(this, { place, series, range, incrs, unit, size: 30 });
    this.#build();
    new ResizeObserver(() => this.plot.setSize(this.#extent())).observe(place);
    onScheme(() => this.#build());
  }

  show(data, span, begins) {
    Object.assign(this, { data, span, begins, cursor: null });
    this.plot.setData(data, false);
    this.plot.setScale("x", { min: span[0], max: span[1] });
  }

  /** Mark a time [s]. */
  mark(time) {
    this.cursor = time;
    this.plot.redraw(false);
  }

  /** Draw where primitives begin, and the time that is shown. */
  #times({ ctx: context, bbox, valToPos }) {
    const c = colours();
    const lines = (this.begins ?? []).slice(1).map((time) => [time, c.soft, [3, 3]]);
    if (this.cursor !== null) lines.push([this.cursor, c.ink, []]);
    context.save();
    context.lineWidth = devicePixelRatio;
    for (const [time, colour, dash] of lines) {
      const x = valToPos(time, "x", true);
      context.strokeStyle = colour;
      context.setLineDash(dash.map((length) => length * devicePixelRatio));
      context.beginPath();
      context.moveTo(x, bbox.top);
      context.lineTo(x, bbox.top + bbox.height);
      context.stroke();
    }
    context.restore();
  }

  #extent() {
    return { width: this.place.clientWidth || 200, height: this.place.clientHeight || 66 };
  }

  #build() {
    this.plot?.destroy();
    const c = colours();
    const grid = { stroke: c.rule, width: 1 };
    const axis = { stroke: c.soft, font: font(), grid, ticks: { show: false }, gap: 3 };
    this.plot = new uPlot(
      {
        ...this.#extent(),
        legend: { show: false },
        hooks: { draw: [(plot) => this.#times(plot)] },
        cursor: { show: false },
        padding: [6, 4, 0, 0],
        scales: {
          x: { time: false, range: (_, min, max) => [min ?? 0, max ?? SHOWN_S] },
          y: { range: this.range },
        },
        axes: [
          {
            ...axis,
            size: 17,
            space: 44,
            incrs: SECONDS,
            values: (_, values) => values.map(inSeconds),
          },
          {
            ...axis,
            size: this.size,
            space: 18,
            incrs: this.incrs,
            values: (_, values) => values.map((value) => `${value}${this.unit}`),
          },
        ],
        series: [
          {},
          ...this.series(c).map((one) => ({ width: 1.7, points: { show: false }, ...one })),
        ],
      },
      this.data ?? Array.from({ length: this.series(c).length + 1 }, () => []),
      this.place,
    );
    if (this.data) {
      const { data, span, begins, cursor } = this;
      this.show(data, span, begins);
      this.mark(cursor);
    } else this.plot.setScale("x", { min: 0, max: SHOWN_S });
  }
}

/** The activity of many units as a strip of heat: forty lines could not be told apart. */
class Heat {
  constructor(place, label) {
    this.canvas = made("canvas", "", [], { role: "img", "aria-label": label });
    place.append(this.canvas);
    place.classList.add("heat");
    this.show([[]], [0, SHOWN_S]);
    new ResizeObserver(() => this.#draw()).observe(this.canvas);
    onScheme(() => this.#draw());
  }

  show(data, span, begins) {
    Object.assign(this, { data, span, begins, cursor: null });
    this.#draw();
  }

  /** Mark a time [s]. */
  mark(time) {
    this.cursor = time;
    this.#draw();
  }

  #draw() {
    const { context, width: whole, height: tall } = fitted(this.canvas);
    const [width, height, c] = [whole - BESIDE - RIM, tall - ABOVE, colours()];
    const [from, to] = this.span;
    const x = (time) => BESIDE + ((time - from) / (to - from)) * width;
    context.clearRect(0, 0, whole, tall);
    context.fillStyle = c.band;
    context.fillRect(BESIDE, 0, width, height);
    const [times, ...units] = this.data;
    const wide = times.length > 1 ? x(times[1]) - x(times[0]) : 0;
    context.fillStyle = c.blue;
    times.forEach((time, i) => {
      if (time < from) return;
      units.forEach((unit, k) => {
        context.globalAlpha = Math.min(Math.max(unit[i], 0), 1);
        const begin = Math.max(x(time) - wide / 2, BESIDE);
        const end = Math.min(x(time) + wide / 2 + 0.5, BESIDE + width);
        context.fillRect(begin, (k * height) / units.length, end - begin, height / units.length);
      });
    });
    context.globalAlpha = 1;
    this.#times(context, x, height, c);
  }

  #times(context, x, height, c) {
    const [from, to] = this.span;
    Object.assign(context, { font: font(), fillStyle: c.soft, textAlign: "center" });
    const step = SECONDS.find((each) => ((x(to) - x(from)) * each) / (to - from) >= 44) ?? 5;
    for (let time = Math.ceil(from / step) * step; time <= to + 1e-6; time += step)
      context.fillText(inSeconds(time), Math.min(x(time), x(to) - 8), height + 13);
    const lines = (this.begins ?? []).slice(1).map((time) => [time, c.soft]);
    if (this.cursor !== null) lines.push([this.cursor, c.ink]);
    for (const [time, colour] of lines) {
      context.fillStyle = colour;
      context.fillRect(x(time) - 0.5, 0, 1, height);
    }
  }
}

/** Joint angles, and the activity of the network's levels: lines of few units, heat of many. */
export class Activity {
  constructor(place) {
    this.place = place;
    this.built = "";
    this.charts = {};
    this.clear();
  }

  /** Make the charts of some joints and levels; the channels are what IO is wired to. */
  build(joints, levels, channels) {
    if (this.built === JSON.stringify([joints, levels])) return;
    this.built = JSON.stringify([joints, levels]);
    this.widths = { actual: joints.length, commanded: joints.length };
    const goal = made("i", "key dashed", "commanded");
    // The unit is said once, after the last channel that has it.
    const io = keys(
      channels.map(({ name, unit }, i) =>
        unit && channels[i + 1]?.unit !== unit ? `${name} [${unit}]` : name,
      ),
    );
    const figures = [
      figure("joints", ["Arm [°] ", ...keys(joints), goal]),
      ...levels.map(({ name, size }, i) =>
        figure(name, [
          term(name, titled(name)),
          " ",
          ...(i ? [made("small", "", `${role(i, levels.length)}, ${size} units`)] : io),
        ]),
      ),
    ];
    this.place.replaceChildren(...figures);
    const [arm, ...others] = figures.map((each) => each.lastElementChild);
    const dashed = (one) => ({ ...one, dash: [5, 4], width: 1.3 });
    this.charts = {
      joints: new Lines(
        arm,
        (c) => [...strokes(c, joints.length), ...strokes(c, joints.length).map(dashed)],
        {
          range: (_, low, high) => [Math.min(low ?? -20, -20) - 5, Math.max(high ?? 40, 40) + 5],
          incrs: [20, 40, 80],
          unit: "°",
        },
      ),
    };
    levels.forEach(({ name, size }, i) => {
      this.widths[name] = size;
      this.charts[name] =
        size > MOST_LINES
          ? new Heat(others[i], `Activity of the ${titled(name)} units over time`)
          : new Lines(others[i], (c) => strokes(c, size), {
              range: [-0.05, 1.05],
              incrs: [0.5, 1],
            });
    });
    this.clear();
  }

  clear() {
    this.rows = Object.fromEntries(Object.keys(this.widths ?? {}).map((name) => [name, []]));
    this.times = Object.fromEntries(Object.keys(this.rows).map((name) => [name, []]));
    Object.assign(this, { end: 0, begins: null });
  }

  /** Take a chunk of `frames`; its rows lie evenly between its first pose and the next chunk. */
  take(frames) {
    if (frames.from === 0) this.clear();
    for (const name of Object.keys(this.rows)) {
      const rows = frames[name] ?? frames.activity[name] ?? [];
      rows.forEach((row, i) => {
        this.times[name].push(
          (frames.from + (i * frames.poses.length) / rows.length) / frames.rate_hz,
        );
        this.rows[name].push(row);
      });
    }
  }

  /** Show everything up to a time [s]; of a whole film, where that is. */
  show(end) {
    this.end = end;
    if (this.begins) Object.values(this.charts).forEach((chart) => chart.mark(end));
    else this.#draw([Math.max(end - SHOWN_S, 0), Math.max(end, SHOWN_S)]);
  }

  /** Show all that was taken, whose primitives begin at these times [s]. */
  whole(begins) {
    this.begins = begins;
    this.end = Infinity;
    this.#draw([0, Math.max(...Object.values(this.times).flat(), 0.1)]);
  }

  #draw(span) {
    for (const [name, chart] of Object.entries(this.charts)) {
      if (name !== "joints") chart.show(this.#until(name, 1), span, this.begins);
    }
    const sensed = this.#until("actual", DEGREES);
    const joints = [...sensed, ...this.#until("commanded", DEGREES).slice(1)];
    this.charts.joints?.show(joints, span, this.begins);
  }

  #until(name, factor) {
    const [rows, times] = [this.rows[name], this.times[name]];
    const count = times.filter((t) => t <= this.end + 1e-9).length;
    const columns = Array.from({ length: this.widths[name] }, (_, k) =>
      rows.slice(0, count).map((row) => (k < row.length ? row[k] * factor : null)),
    );
    return [times.slice(0, count), ...columns];
  }
}

const strokes = (c, count) =>
  Array.from({ length: count }, (_, i) => {
    const paints = [c.blue, c.orange, c.sky, c.amber, c.green, c.pink];
    return { stroke: paints[i % paints.length] };
  });

/** Return names, each with the line it belongs to. */
const keys = (names) => names.flatMap((name, i) => [made("i", `key ${LETTERS[i]}`, name), " "]);

const figure = (name, caption) =>
  made("figure", "", [made("figcaption", "", caption), made("div")], {
    "data-testid": `chart-${name}`,
  });

function role(index, count) {
  if (index === 0) return "input and output";
  if (index === 1) return "fast context";
  return index === count - 1 ? "slow context" : "context";
}
