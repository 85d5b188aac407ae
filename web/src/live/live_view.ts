// The mission as it stands by now, from above, drawn by the layers that show it later.
import { h } from "../base/dom";
import { Run } from "../report/run";
import type { Report } from "../report/types";
import { PlanView } from "../watch/plan_view";

export class LiveView {
  readonly element = h("div", { class: "stage" });
  private view: PlanView | null = null;
  private run: Run | null = null;
  private report: Report | null = null;
  private frame = 0;

  close(): void {
    cancelAnimationFrame(this.frame);
    this.frame = -1;
    this.view?.close();
  }

  /** The same report with more in it, or another. */
  show(report: Report): void {
    this.report = report;
    this.invalidate();
  }

  private invalidate(): void {
    if (this.frame === 0) this.frame = requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    this.frame = 0;
    if (this.report) this.take(this.report);
    this.report = null;
    const { run, view } = this;
    if (run) view?.draw({ t: run.duration, shot: run.flights.at(-1) ?? null, target: null, speed: 0 });
  }

  private take(report: Report): void {
    this.run = new Run(report);
    if (this.view) {
      this.view.renew(this.run);
      return;
    }
    const ignore = (): void => undefined;
    this.view = new PlanView(this.run, { redraw: () => this.invalidate(), selectShot: ignore, selectTarget: ignore });
    this.element.append(this.view.element);
  }
}
