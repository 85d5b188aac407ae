// Plots of a run over its time. Their cursors follow the clock; a click or a drag on one moves the clock.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { h } from "../base/dom";
import { figures } from "../base/numbers";
import { onTheme, theme } from "../base/theme";
import type { Run } from "../log/run";
import { nearest } from "../log/track";
import type { Series } from "./plotted";
import { seriesOf } from "./series";

const height = 128;

const dataOf = ({ time, lines }: Series): uPlot.AlignedData => [time, ...lines.map((line) => line.values)];

export class Plots {
  readonly element = h("section", { class: "plots scrolls", tabindex: 0, "aria-label": "Plots" });
  private plots: uPlot[] = [];
  private timed: uPlot[] = [];  // those whose cursors follow the clock
  private all: Series[] = [];
  private run!: Run;
  private drawn: Run | null = null;
  private t = 0;
  private off: () => void;
  private watcher = new ResizeObserver(() => this.resize());

  constructor(run: Run, private seek: (t: number) => void) {
    this.off = onTheme(() => this.build());
    this.watcher.observe(this.element);
    this.renew(run);
  }

  get empty(): boolean { return this.all.length === 0; }

  /** What is not in sight is brought up to date when it comes there. */
  renew(run: Run): void {
    this.run = run;
    if (this.empty) this.all = seriesOf(run);
  }

  private bringUpToDate(): void {
    this.drawn = this.run;
    const before = this.all;
    this.all = seriesOf(this.run);
    const shape = (all: Series[]): string => JSON.stringify(all.map(({ title, lines }) => [title, lines.map(({ name }) => name)]));
    if (this.plots.length === 0 || shape(before) !== shape(this.all)) this.build();
    else this.plots.forEach((plot, i) => plot.setData(dataOf(this.all[i]!)));
  }

  close(): void {
    this.off();
    this.watcher.disconnect();
    for (const plot of this.plots) plot.destroy();
  }

  private build(): void {
    for (const plot of this.plots) plot.destroy();
    this.element.replaceChildren();
    this.timed = [];
    const width = this.element.clientWidth - 20;
    this.plots = width > 0 ? this.all.map((series) => this.made(series, width)) : [];
    this.show(this.t);
  }

  private resize(): void {
    const width = this.element.clientWidth - 20;
    if (this.plots.length === 0 && width > 0) this.build();
    else if (width > 0) for (const plot of this.plots) plot.setSize({ width, height });
  }

  private made(series: Series, width: number): uPlot {
    const place = h("figure", {}, h("figcaption", {}, series.title, series.unit ? h("span", {}, ` ${series.unit}`) : null));
    this.element.append(place);
    const axis: uPlot.Axis = { stroke: theme.soft, font: `10.5px ${theme.sans}`, grid: { stroke: theme.grid, width: 1 }, ticks: { show: false } };
    const plot = new uPlot({
      width, height,
      padding: [6, 18, 0, 0],
      scales: { x: { time: false }, y: { range: (_, low, high) => [Math.min(0, low), high > 0 ? high * 1.05 : 1] } },
      axes: [{ ...axis, size: 22, values: (_, values) => values.map((v) => (series.along ? v.toLocaleString("en") : `${v} s`)) }, { ...axis, size: 46 }],
      cursor: { y: false, drag: { x: false, y: false }, points: { size: 7 } },
      series: [{ label: series.along ?? "time", value: (_, v) => (v === null ? "" : series.along ? v.toLocaleString("en") : `${v.toFixed(1)} s`) }, ...series.lines.map((line) => ({
        label: line.name, stroke: theme[line.colour], width: 1.6, points: { show: false },
        value: (_: uPlot, v: number | null) => (v === null ? "\u2013" : figures(v)),
        ...(line.steps ? { paths: uPlot.paths.stepped!({ align: 1 }) } : {}),
      }))],
    }, dataOf(series), place);
    if (series.along) return plot;
    this.seekOn(plot);
    this.timed.push(plot);
    return plot;
  }

  private seekOn(plot: uPlot): void {
    const go = (event: PointerEvent): void => {
      if (event.buttons & 1) this.seek(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x"));
    };
    plot.over.addEventListener("pointerdown", go);
    plot.over.addEventListener("pointermove", go);
    plot.over.addEventListener("pointerleave", () => this.show(this.t));
  }

  show(t: number): void {
    this.t = t;
    if (this.element.hidden) return;
    if (this.run !== this.drawn) this.bringUpToDate();
    for (const plot of this.timed) plot.setCursor({ left: plot.valToPos(t, "x"), top: 0 }, false);
    for (const plot of this.timed) plot.setLegend({ idx: nearest(plot.data[0] as number[], t) }, false);
  }
}
