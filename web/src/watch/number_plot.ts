// A plot of numbers over the time, or over something else, with what it says of a place on its axis: a dot on each line, and the
// values below its title.
import uPlot from "uplot";
import { h } from "../base/dom";
import { figures } from "../base/numbers";
import { theme } from "../base/theme";
import { valueAt, type Series } from "./plotted";

export interface PlotActs {
  /** The pointer is at a time, or left. */
  point: (t: number | null) => void;
  seek: (t: number) => void;
  zoom: (from: number, to: number) => void;
  whole: () => void;
  remove: (key: string) => void;
}

const leastDrag_px = 6;

export const dataOf = ({ time, lines }: Series): uPlot.AlignedData => [time, ...lines.map((line) => line.values)];

export class NumberPlot {
  static readonly height = 128;
  readonly plot: uPlot;
  private time = h("b", {});
  private values: HTMLElement[];
  private dots: HTMLElement[];
  private element: HTMLElement;

  constructor(public series: Series, into: HTMLElement, width: number, private acts: PlotActs) {
    const { key } = series;
    this.values = series.lines.map(() => h("b", {}));
    this.dots = series.lines.map(({ colour }) => h("i", { class: "dot", style: `background:var(--${colour})` }));
    this.element = h("figure", {}, h("figcaption", {}, series.title, series.unit ? h("span", {}, ` ${series.unit}`) : null,
      key !== undefined && h("button", { type: "button", class: "quiet", "aria-label": `Remove ${series.title}`, title: "Remove", onclick: () => acts.remove(key) }, "\u00d7")),
    h("ul", { class: "values" }, h("li", {}, series.along ?? "time", this.time),
      ...series.lines.map(({ name, colour }, i) => h("li", {}, h("i", { class: "line", style: `border-color:var(--${colour})` }), name, this.values[i]!))));
    into.append(this.element);
    this.plot = new uPlot(this.options(width), dataOf(series), this.element);
    this.plot.over.append(...this.dots);
    this.listen();
  }

  close(): void { this.plot.destroy(); }

  renew(series: Series): void {
    this.series = series;
    this.plot.setData(dataOf(series));
  }

  private options(width: number): uPlot.Options {
    const { series } = this;
    const axis: uPlot.Axis = { stroke: theme.soft, font: `10.5px ${theme.sans}`, grid: { stroke: theme.grid, width: 1 }, ticks: { show: false } };
    const low = (least: number): number => (series.key === undefined ? Math.min(0, least) : least);
    const high = (least: number, most: number): number => (most > least ? most + 0.05 * (most - least) : least + 1);
    return {
      width, height: NumberPlot.height,
      padding: [6, 18, 0, 0],
      scales: { x: { time: false }, y: { range: (_, least, most) => [low(least ?? 0), high(low(least ?? 0), most ?? 1)] } },
      axes: [{ ...axis, size: 22, values: (_, values) => values.map((v) => (series.along ? v.toLocaleString("en") : `${v} s`)) }, { ...axis, size: 46 }],
      cursor: { y: false, drag: { x: !series.along, y: false, setScale: false, dist: leastDrag_px }, points: { show: false } },
      legend: { show: false },
      hooks: { setSelect: [(plot) => {
        if (plot.select.width < leastDrag_px) return;
        const [from, to] = [plot.posToVal(plot.select.left, "x"), plot.posToVal(plot.select.left + plot.select.width, "x")];
        plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
        this.acts.zoom(from, to);
      }] },
      series: [{}, ...series.lines.map((line) => ({
        label: line.name, stroke: theme[line.colour], width: 1.6, points: { show: false },
        ...(line.steps ? { paths: uPlot.paths.stepped!({ align: 1 }) } : {}),
      }))],
    };
  }

  private listen(): void {
    const { over } = this.plot;
    const under = (event: MouseEvent): number => this.plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x");
    if (this.series.along) {
      over.addEventListener("pointermove", (event) => this.tell(under(event)));
      over.addEventListener("pointerleave", () => this.show(0));
      return;
    }
    let pressed = 0;
    over.addEventListener("pointerdown", (event) => { pressed = event.clientX; });
    over.addEventListener("pointermove", (event) => this.acts.point(under(event)));
    over.addEventListener("pointerleave", () => this.acts.point(null));
    over.addEventListener("click", (event) => { if (Math.abs(event.clientX - pressed) < leastDrag_px) this.acts.seek(under(event)); });
    over.addEventListener("dblclick", () => this.acts.whole());
  }

  /** Shows what holds at t; over something else, in the end. */
  show(t: number): void {
    const { series, plot } = this;
    if (!series.along) plot.setCursor({ left: plot.valToPos(t, "x"), top: 0 }, false);
    this.tell(series.along ? series.time.at(-1) ?? 0 : t);
  }

  /** Tells what holds at a place on the axis, with a dot on each line there. */
  private tell(x: number): void {
    const { series, plot } = this;
    this.time.textContent = series.along ? Math.round(x).toLocaleString("en") : `${x.toFixed(1)} s`;
    const left = plot.valToPos(x, "x");
    const width = plot.bbox.width / uPlot.pxRatio;  // asking the element would have the page laid out again
    series.lines.forEach((line, i) => {
      const value = valueAt(series.time, line, x);
      this.values[i]!.textContent = value === null ? "\u2013" : Number.isInteger(value) ? value.toLocaleString("en") : figures(value);
      this.dots[i]!.hidden = value === null || left < 0 || left > width;
      if (value !== null) this.dots[i]!.style.translate = `${left}px ${plot.valToPos(value, "y")}px`;
    });
  }
}
