// The numbers of a run: metrics, warnings, settings.
import { h } from "../base/dom";
import { fixed, metric } from "../base/numbers";
import type { Report } from "../report/types";

export function facts(report: Report): HTMLElement {
  const metrics = Object.entries(report.metrics).map(([name, number]) => {
    const { label, value, unit } = metric(name, number);
    return h("div", {}, h("dt", {}, label), h("dd", {}, value, unit ? h("small", {}, unit) : null));
  });
  const settings = Object.entries(report.settings).map(([name, value]) =>
    h("div", {}, h("dt", {}, name.replaceAll("_", " ")), h("dd", {}, value)));
  const refused = report.explore?.refused ?? [];
  return h("section", { class: "facts scrolls", tabindex: 0, "aria-label": "Numbers" },
    h("dl", { class: "metrics" }, ...metrics),
    report.warnings.length > 0 && h("h3", {}, report.warnings.length === 1 ? "1 warning" : `${report.warnings.length} warnings`),
    h("ul", { class: "warnings" }, ...report.warnings.map((text) => h("li", {}, text))),
    refused.length > 0 && h("h3", {}, "Frontiers refused"),
    h("ul", { class: "warnings" }, ...refused.map(({ position: [x, y], reason }) => h("li", {}, `(${fixed(x, 2)}, ${fixed(y, 2)}) ${reason}`))),
    settings.length > 0 && h("h3", {}, `${settings.length} settings`),
    h("dl", { class: "settings" }, ...settings));
}
