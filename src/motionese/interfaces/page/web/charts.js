// What goes on inside: joint angles and the activity of the levels, scrolling; the learning curve.

import { colours, fitted, made, onScheme, titled } from "./dom.js";
import uPlot from "./vendor/uplot.js";

/** How much of the past is shown [s]. */
const SHOWN_S = 5;
const DEGREES = 180 / Math.PI;
/** Levels of more units are shown as heat. */
const MOST_LINES = 8;
const LETTERS = "abcdef";

const font = () => `11px ${getComputedStyle(document.body).fontFamily}`;

/** Lines over time in a small place. */
class Lines {
  constructor(place, series, { range, incrs, unit = "" }) {
    Object.assign(this, { place, series, range, incrs, unit, size: 30 });
    this.#build();
    new ResizeObserver(() => this.plot.setSize(this.#extent())).observe(place);
    onScheme(() => this.#build());
  }

  show(data, end) {
    this.data = data;
    this.end = end;
    this.plot.setData(data, false);
    this.plot.setScale("x", { min: Math.max(end - SHOWN_S, 0), max: Math.max(end, SHOWN_S) });
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
        cursor: { show: false },
        padding: [6, 4, 0, 0],
        scales: {
          x: { time: false, range: (_, min, max) => [min ?? 0, max ?? SHOWN_S] },
          y: { range: this.range },
        },
        axes: [
          { ...axis, show: false },
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
    if (this.data) this.show(this.data, this.end);
    else this.plot.setScale("x", { min: 0, max: SHOWN_S });
  }
}

/** The activity of many units as a strip of heat: forty lines could not be told apart. */
class Heat {
  constructor(place, label) {
    this.canvas = made("canvas", "", [], { role: "img", "aria-label": label });
    place.append(this.canvas);
    place.classList.add("heat");
    this.show([[]], 0);
    new ResizeObserver(() => this.show(this.data, this.end)).observe(this.canvas);
    onScheme(() => this.show(this.data, this.end));
  }

  show(data, end) {
    Object.assign(this, { data, end });
    const { context, width, height } = fitted(this.canvas);
    const c = colours();
    context.fillStyle = c.band;
    context.fillRect(0, 0, width, height);
    const [times, ...units] = data;
    if (times.length < 2) return;
    const from = Math.max(end - SHOWN_S, 0);
    const wide = ((times[1] - times[0]) / SHOWN_S) * width;
    const tall = height / units.length;
    context.fillStyle = c.blue;
    times.forEach((time, i) => {
      if (time < from - 1) return;
      const x = ((time - from) / SHOWN_S) * width;
      units.forEach((unit, k) => {
        context.globalAlpha = Math.min(Math.max(unit[i], 0), 1);
        context.fillRect(x, k * tall, wide + 0.5, tall);
      });
    });
    context.globalAlpha = 1;
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

  /** Make the charts of some joints and levels. */
  build(joints, levels) {
    if (this.built === JSON.stringify([joints, levels])) return;
    this.built = JSON.stringify([joints, levels]);
    this.widths = { actual: joints.length, commanded: joints.length };
    const keys = [...joints.map((joint, i) => made("i", `key ${LETTERS[i]}`, joint))];
    const figures = [
      figure("joints", ["Arm ", ...keys.flatMap((key) => [key, " "]), made("i", "key dashed", "goal")]),
      ...levels.map(({ name }, i) =>
        figure(name, [`${titled(name)} `, made("small", "", role(i, levels.length))]),
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
          : new Lines(others[i], (c) => strokes(c, size), { range: [-0.05, 1.05], incrs: [0.5] });
    });
    this.clear();
  }

  clear() {
    this.rows = Object.fromEntries(Object.keys(this.widths ?? {}).map((name) => [name, []]));
    this.times = Object.fromEntries(Object.keys(this.rows).map((name) => [name, []]));
    this.end = 0;
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

  /** Show everything up to a time [s]. */
  show(end) {
    this.end = end;
    for (const [name, chart] of Object.entries(this.charts)) {
      if (name !== "joints") chart.show(this.#until(name, 1), end);
    }
    const sensed = this.#until("actual", DEGREES);
    this.charts.joints?.show([...sensed, ...this.#until("commanded", DEGREES).slice(1)], end);
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

const figure = (name, caption) =>
  made("figure", "", [made("figcaption", "", caption), made("div")], {
    "data-testid": `chart-${name}`,
  });

function role(index, count) {
  if (index === 0) return "input and output";
  if (index === 1) return "fast context";
  return index === count - 1 ? "slow context" : "context";
}

/** The learning curve: the mean error [cm] after every lesson. */
export class Curve {
  constructor(place) {
    this.place = place;
    this.points = [];
    this.#build();
    new ResizeObserver(() => this.plot.setSize(this.#extent())).observe(place);
    onScheme(() => this.#build());
  }

  show(points) {
    this.points = points;
    this.plot.setData(this.#data());
  }

  #data() {
    return [this.points.map((p) => p.n), this.points.map((p) => p.error_cm)];
  }

  #extent() {
    return { width: this.place.clientWidth || 240, height: this.place.clientHeight || 220 };
  }

  #build() {
    this.plot?.destroy();
    const c = colours();
    const axis = {
      stroke: c.soft,
      font: font(),
      grid: { stroke: c.rule, width: 1 },
      ticks: { show: false },
    };
    this.plot = new uPlot(
      {
        ...this.#extent(),
        legend: { show: false },
        cursor: { show: false },
        padding: [8, 10, 0, 0],
        scales: {
          x: { time: false, range: (_, min, max) => [0, Math.max(max ?? 0, 5)] },
          y: { range: (_, min, max) => [0, Math.max((max ?? 0) * 1.15, 2)] },
        },
        axes: [
          {
            ...axis,
            size: 26,
            label: "lessons",
            labelSize: 20,
            labelGap: 0,
            labelFont: font(),
            incrs: [1, 2, 5, 10, 20, 50],
          },
          { ...axis, size: 34, label: "error [cm]", labelSize: 18, labelFont: font() },
        ],
        series: [{}, { stroke: c.blue, width: 2.2, points: { show: true, size: 7, fill: c.blue } }],
      },
      this.#data(),
      this.place,
    );
  }
}
