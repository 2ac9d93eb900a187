// What goes on inside: joint angles and the activity of the levels, scrolling; the learning curve.

import { colours, fitted, onScheme } from "./dom.js";
import uPlot from "./vendor/uplot.js";

/** How much of the past is shown [s]. */
const SHOWN_S = 5;
const DEGREES = 180 / Math.PI;

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

/** Joint angles, IO and Cs as lines, Cf as a strip of heat: forty lines could not be told apart. */
export class Activity {
  constructor({ joints, io, cf, cs }) {
    const line = (stroke, dash) => ({ stroke, ...(dash && { dash: [5, 4], width: 1.3 }) });
    const unit = [-0.05, 1.05];
    this.joints = new Lines(
      joints,
      (c) => [line(c.blue), line(c.orange), line(c.blue, true), line(c.orange, true)],
      {
        range: (_, low, high) => [Math.min(low ?? -20, -20) - 5, Math.max(high ?? 40, 40) + 5],
        incrs: [20, 40, 80],
        unit: "°",
      },
    );
    this.io = new Lines(
      io,
      (c) => [c.blue, c.orange, c.sky, c.amber, c.green, c.pink].map((s) => line(s)),
      { range: unit, incrs: [0.5] },
    );
    this.cs = new Lines(cs, (c) => [c.green, c.pink, c.blue, c.orange].map((s) => line(s)), {
      range: unit,
      incrs: [0.5],
    });
    this.cf = cf;
    this.clear();
    new ResizeObserver(() => this.#heat(this.end)).observe(cf);
    onScheme(() => this.#heat(this.end));
  }

  clear() {
    this.rows = { actual: [], commanded: [], io: [], cf: [], cs: [] };
    this.times = { actual: [], commanded: [], io: [], cf: [], cs: [] };
    this.end = 0;
  }

  /** Take a chunk of `frames`; its rows lie evenly between its first pose and the next chunk. */
  take(frames) {
    if (frames.from === 0) this.clear();
    for (const name of Object.keys(this.rows)) {
      const rows = frames[name] ?? [];
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
    const { actual, commanded } = this.rows;
    const [seconds, sensed] = this.#until(actual, this.times.actual, 2, DEGREES);
    const asked = this.#until(commanded, this.times.commanded, 2, DEGREES)[1];
    this.joints.show([seconds, ...sensed, ...asked], end);
    for (const [name, width] of [
      ["io", 6],
      ["cs", 4],
    ]) {
      const [times, columns] = this.#until(this.rows[name], this.times[name], width, 1);
      this[name].show([times, ...columns], end);
    }
    this.#heat(end);
  }

  #until(rows, times, width, factor) {
    const count = times.filter((t) => t <= this.end + 1e-9).length;
    const columns = Array.from({ length: width }, (_, k) =>
      rows.slice(0, count).map((row) => (k < row.length ? row[k] * factor : null)),
    );
    return [times.slice(0, count), columns];
  }

  #heat(end) {
    const { context, width, height } = fitted(this.cf);
    const c = colours();
    context.fillStyle = c.band;
    context.fillRect(0, 0, width, height);
    const { cf: rows } = this.rows;
    const { cf: times } = this.times;
    if (rows.length < 2) return;
    const from = Math.max(end - SHOWN_S, 0);
    const wide = ((times[1] - times[0]) / SHOWN_S) * width;
    const tall = height / rows[0].length;
    context.fillStyle = c.blue;
    rows.forEach((row, i) => {
      if (times[i] > end || times[i] < from - 1) return;
      const x = ((times[i] - from) / SHOWN_S) * width;
      row.forEach((value, k) => {
        context.globalAlpha = Math.min(Math.max(value, 0), 1);
        context.fillRect(x, k * tall, wide + 0.5, tall);
      });
    });
    context.globalAlpha = 1;
  }
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
