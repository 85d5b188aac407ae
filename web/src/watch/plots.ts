// Plots of a run over its time. They share a cursor, which follows the clock or the pointer, and the part of the time that is shown:
// a drag on one shows what it spans, a click moves the clock, a double click shows everything.
import "uplot/dist/uPlot.min.css";
import { h } from "../base/dom";
import { onTheme } from "../base/theme";
import { keepInAddress } from "../base/url";
import type { Run } from "../log/run";
import { channelSeries } from "./channel_series";
import { ChannelPicker } from "./channel_picker";
import { LanePlot } from "./lane_plot";
import { lanesOf } from "./lanes";
import { NumberPlot } from "./number_plot";
import type { Series } from "./plotted";
import { seriesOf } from "./series";

export class Plots {
  readonly element = h("section", { class: "plots scrolls", tabindex: 0, "aria-label": "Plots" });
  private list = h("div", { class: "plot-list" });
  private whole = h("button", { type: "button", class: "button", hidden: true, onclick: () => this.zoom(null) }, "Whole run");
  private picker: ChannelPicker;
  private shown: NumberPlot[] = [];
  private lanes: LanePlot[] = [];
  private all: Series[] = [];
  private run!: Run;
  private drawn: Run | null = null;
  private range: [number, number] | null = null;  // of the time that is shown; null for all of it
  private t = 0;
  private width = 0;
  private off: () => void;
  private watcher = new ResizeObserver(() => this.resize());

  /** `chosen` are the channels that somebody added, as the address has them. */
  constructor(run: Run, private seek: (t: number) => void, private chosen: string[] = []) {
    this.picker = new ChannelPicker(() => this.run, (key) => this.choose([...this.chosen.filter((one) => one !== key), key]));
    this.element.append(h("div", { class: "plot-tools" }, this.picker.element, this.whole), this.list);
    this.off = onTheme(() => this.build());
    this.watcher.observe(this.element);
    this.renew(run);
  }

  get empty(): boolean { return this.all.length === 0; }

  private series(): Series[] { return [...channelSeries(this.run, this.chosen), ...seriesOf(this.run)]; }

  /** Renews the plots; one that is not in sight is brought up to date when it comes there. */
  renew(run: Run): void {
    this.run = run;
    if (this.empty) this.all = this.series();
  }

  private choose(chosen: string[]): void {
    this.chosen = chosen;
    keepInAddress({ plots: chosen.join(",") });
    this.all = this.series();
    this.build();
  }

  private bringUpToDate(): void {
    this.drawn = this.run;
    const before = this.all;
    this.all = this.series();
    const shape = (all: Series[]): string => JSON.stringify(all.map(({ title, lines }) => [title, lines.map(({ name }) => name)]));
    const lanes = lanesOf(this.run);
    if (this.shown.length === 0 || shape(before) !== shape(this.all) || lanes.length !== this.lanes.length) {
      this.build();
      return;
    }
    this.shown.forEach((one, i) => one.renew(this.all[i]!));
    this.lanes.forEach((one, i) => one.renew(lanes[i]!));
    this.spread();
  }

  close(): void {
    this.off();
    this.watcher.disconnect();
    for (const one of this.shown) one.close();
  }

  private build(): void {
    for (const one of this.shown) one.close();
    this.list.replaceChildren();
    this.width = this.element.clientWidth - 20;
    const acts = { point: (t: number | null) => this.point(t), seek: this.seek, zoom: (from: number, to: number) => this.zoom([from, to]), whole: () => this.zoom(null),
      remove: (key: string) => this.choose(this.chosen.filter((one) => one !== key)) };
    this.shown = this.width > 0 ? this.all.map((series) => new NumberPlot(series, this.list, this.width, acts)) : [];
    this.lanes = this.width > 0 ? lanesOf(this.run).map((lanes) => new LanePlot(lanes, acts)) : [];
    this.list.append(...this.lanes.map(({ element }) => element));
    this.spread();
    this.show(this.t);
  }

  private resize(): void {
    const width = this.element.clientWidth - 20;
    if (this.shown.length === 0 && width > 0) this.build();
    else if (width > 0) {
      this.width = width;
      for (const { plot } of this.shown) plot.setSize({ width, height: NumberPlot.height });
      this.spread();
    }
    this.show(this.t);
  }

  private zoom(range: [number, number] | null): void {
    this.range = range;
    this.spread();
    this.show(this.t);
  }

  /** Shows the same part of the time in all. */
  private spread(): void {
    this.whole.hidden = this.range === null;
    const range = this.range ?? [0, this.run.duration];
    for (const { plot, series } of this.shown) {
      if (!series.along) plot.setScale("x", { min: range[0], max: Math.max(range[1], range[0] + 1e-6) });
    }
    for (const one of this.lanes) one.draw(range, this.width);
  }

  /** The pointer is at a time, or at none any more. */
  private point(t: number | null): void { this.tell(t ?? this.t); }

  show(t: number): void {
    this.t = t;
    if (this.element.hidden) return;
    if (this.run !== this.drawn) this.bringUpToDate();
    this.tell(t);
  }

  private tell(t: number): void {
    for (const one of this.shown) one.show(t);
    for (const one of this.lanes) one.show(t);
  }
}

