// The numbers of a run: metrics, warnings, settings.
import { h } from "../base/dom";
import { fixed, metric, type Num } from "../base/numbers";
import type { Run } from "../report/run";
import { soFar } from "../report/so_far";
import type { Report } from "../report/types";

const metrics = (numbers: Record<string, Num>): HTMLElement => h("dl", { class: "metrics" }, ...Object.entries(numbers).map(([name, number]) => {
  const { label, value, unit } = metric(name, number);
  return h("div", {}, h("dt", {}, label), h("dd", {}, value, unit ? h("small", {}, unit) : null));
}));

function notes(report: Report): HTMLElement {
  const settings = Object.entries(report.settings).map(([name, value]) =>
    h("div", {}, h("dt", {}, name.replaceAll("_", " ")), h("dd", {}, value)));
  const refused = report.explore?.refused ?? [];
  return h("div", {},
    report.warnings.length > 0 && h("h3", {}, report.warnings.length === 1 ? "1 warning" : `${report.warnings.length} warnings`),
    h("ul", { class: "warnings" }, ...report.warnings.map((text) => h("li", {}, text))),
    refused.length > 0 && h("h3", {}, "Frontiers refused"),
    h("ul", { class: "warnings" }, ...refused.map(({ position: [x, y], reason }) => h("li", {}, `(${fixed(x, 2)}, ${fixed(y, 2)}) ${reason}`))),
    settings.length > 0 && h("h3", {}, `${settings.length} settings`),
    h("dl", { class: "settings" }, ...settings));
}

export class Facts {
  readonly element = h("section", { class: "facts scrolls", tabindex: 0, "aria-label": "Numbers" });
  private noted = "";

  /** What is known so far of a run that is not over. */
  renew(run: Run, goesOn: boolean): void {
    const numbers = metrics(goesOn ? soFar(run) : run.report.metrics);
    const { settings, warnings, explore } = run.report;
    const noted = JSON.stringify([settings, warnings, explore?.refused]);
    if (noted === this.noted) {
      this.element.firstElementChild!.replaceWith(numbers);
      return;
    }
    this.noted = noted;
    this.element.replaceChildren(numbers, notes(run.report));
  }
}
