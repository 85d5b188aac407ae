// The numbers of a run: metrics, warnings, settings.
import { h } from "../base/dom";
import { fixed, metric, type Num } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import { typeset } from "../base/typeset";
import { refusalsOf } from "../log/plans";
import type { Run } from "../log/run";
import { soFar } from "../log/so_far";

const metrics = (numbers: Record<string, Num>): HTMLElement => h("dl", { class: "metrics" }, ...Object.entries(numbers).map(([name, number]) => {
  const { label, value, unit } = metric(name, number);
  return h("div", {}, h("dt", {}, label), h("dd", {}, value, unit ? h("small", {}, unit) : null));
}));

interface Notes { warnings: string[]; settings: [string, string][]; refused: { at: Vec2; reason: string }[] }

const notesOf = (run: Run): Notes => ({ warnings: run.log.summary?.warnings ?? [], settings: Object.entries(run.log.summary?.settings ?? {}), refused: refusalsOf(run) });

function shownNotes({ warnings, settings: all, refused }: Notes): HTMLElement {
  const settings = all.map(([name, value]) => h("div", {}, h("dt", {}, name.replaceAll("_", " ")), h("dd", {}, typeset(value) || "\u2013")));
  return h("div", {},
    warnings.length > 0 && h("h2", {}, warnings.length === 1 ? "1 warning" : `${warnings.length} warnings`),
    h("ul", { class: "warnings" }, ...warnings.map((text) => h("li", {}, typeset(text)))),
    refused.length > 0 && h("h2", {}, "Frontiers refused"),
    h("ul", { class: "warnings" }, ...refused.map(({ at: [x, y], reason }) => h("li", {}, `(${fixed(x, 2)}, ${fixed(y, 2)}) ${typeset(reason)}`))),
    settings.length > 0 && h("h2", {}, `${settings.length} settings`),
    h("dl", { class: "settings" }, ...settings));
}

export class Facts {
  readonly element = h("section", { class: "facts scrolls", tabindex: 0, "aria-label": "Numbers" });
  private noted = "";

  /** Shows the facts known so far of a run that is not over. */
  renew(run: Run, goesOn: boolean): void {
    const numbers = metrics((goesOn ? null : run.log.summary?.metrics) ?? soFar(run));
    const notes = notesOf(run);
    const noted = JSON.stringify(notes);
    if (noted === this.noted) {
      this.element.firstElementChild!.replaceWith(numbers);
      return;
    }
    this.noted = noted;
    this.element.replaceChildren(numbers, shownNotes(notes));
  }
}
