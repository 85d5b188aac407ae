// Plots of a run over its time. Their cursors follow the clock; a click or a drag on one moves the clock.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { h } from "../base/dom";
import { figures } from "../base/numbers";
import { onTheme, theme } from "../base/theme";
import type { Run } from "../log/run";
import { valueAt, type Series } from "./plotted";
import { seriesOf } from "./series";

const height = 128;

/** A plot, with what it says of a place on its axis: a dot on each line, and the values beside its title. */
interface Shown { series: Series; plot: uPlot; time: HTMLElement; values: HTMLElement[]; dots: HTMLElement[] }

const dataOf = ({ time, lines }: Series): uPlot.AlignedData => [time, ...lines.map((line) => line.values)];

export class Plots {
  readonly element = h("section", { class: "plots scrolls", tabindex: 0, "aria-label": "Plots" });
  private shown: Shown[] = [];
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
    if (this.shown.length === 0 || shape(before) !== shape(this.all)) {
      this.build();
      return;
    }
    this.shown.forEach((one, i) => {
      one.series = this.all[i]!;
      one.plot.setData(dataOf(one.series));
    });
  }

  close(): void {
    this.off();
    this.watcher.disconnect();
    for (const { plot } of this.shown) plot.destroy();
  }

  private build(): void {
    for (const { plot } of this.shown) plot.destroy();
    this.element.replaceChildren();
    const width = this.element.clientWidth - 20;
    this.shown = width > 0 ? this.all.map((series) => this.made(series, width)) : [];
    this.show(this.t);
  }

  private resize(): void {
    const width = this.element.clientWidth - 20;
    if (this.shown.length === 0 && width > 0) this.build();
    else if (width > 0) for (const { plot } of this.shown) plot.setSize({ width, height });
    this.show(this.t);
  }

  private made(series: Series, width: number): Shown {
    const time = h("b", {});
    const values = series.lines.map(() => h("b", {}));
    const dots = series.lines.map(({ colour }) => h("i", { class: "dot", style: `background:var(--${colour})` }));
    const place = h("figure", {}, h("figcaption", {}, series.title, series.unit ? h("span", {}, ` ${series.unit}`) : null),
      h("ul", { class: "values" }, h("li", {}, series.along ?? "time", time),
        ...series.lines.map(({ name, colour }, i) => h("li", {}, h("i", { class: "line", style: `border-color:var(--${colour})` }), name, values[i]!))));
    this.element.append(place);
    const axis: uPlot.Axis = { stroke: theme.soft, font: `10.5px ${theme.sans}`, grid: { stroke: theme.grid, width: 1 }, ticks: { show: false } };
    const plot = new uPlot({
      width, height,
      padding: [6, 18, 0, 0],
      scales: { x: { time: false }, y: { range: (_, low, high) => [Math.min(0, low), high > 0 ? high * 1.05 : 1] } },
      axes: [{ ...axis, size: 22, values: (_, values) => values.map((v) => (series.along ? v.toLocaleString("en") : `${v} s`)) }, { ...axis, size: 46 }],
      cursor: { y: false, drag: { x: false, y: false }, points: { show: false } },
      legend: { show: false },
      series: [{}, ...series.lines.map((line) => ({
        label: line.name, stroke: theme[line.colour], width: 1.6, points: { show: false },
        ...(line.steps ? { paths: uPlot.paths.stepped!({ align: 1 }) } : {}),
      }))],
    }, dataOf(series), place);
    plot.over.append(...dots);
    const one = { series, plot, time, values, dots };
    const under = (event: PointerEvent): number => plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x");
    plot.over.addEventListener("pointermove", (event) => this.tell(one, under(event)));
    plot.over.addEventListener("pointerleave", () => this.show(this.t));
    if (!series.along) this.seekOn(plot, under);
    return one;
  }

  private seekOn(plot: uPlot, under: (event: PointerEvent) => number): void {
    const go = (event: PointerEvent): void => {
      if (event.buttons & 1) this.seek(under(event));
    };
    plot.over.addEventListener("pointerdown", go);
    plot.over.addEventListener("pointermove", go);
  }

  show(t: number): void {
    this.t = t;
    if (this.element.hidden) return;
    if (this.run !== this.drawn) this.bringUpToDate();
    for (const one of this.shown) {
      const { series, plot } = one;
      if (!series.along) plot.setCursor({ left: plot.valToPos(t, "x"), top: 0 }, false);
      this.tell(one, series.along ? series.time.at(-1) ?? 0 : t);
    }
  }

  /** Tells what holds at a place on the axis, with a dot on each line there. */
  private tell({ series, plot, time, values, dots }: Shown, x: number): void {
    time.textContent = series.along ? Math.round(x).toLocaleString("en") : `${x.toFixed(1)} s`;
    const left = plot.valToPos(x, "x");
    const width = plot.bbox.width / uPlot.pxRatio;  // asking the element would have the page laid out again
    series.lines.forEach((line, i) => {
      const value = valueAt(series.time, line, x);
      values[i]!.textContent = value === null ? "\u2013" : Number.isInteger(value) ? value.toLocaleString("en") : figures(value);
      dots[i]!.hidden = value === null || left < 0 || left > width;
      if (value !== null) dots[i]!.style.translate = `${left}px ${plot.valToPos(value, "y")}px`;
    });
  }
}
