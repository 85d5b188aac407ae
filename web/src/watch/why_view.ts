// The reasons of a run as lists; the one that holds at the present time is marked, a click goes to its time.
import { h } from "../base/dom";
import type { Run } from "../log/run";
import { indexAt } from "../log/run_log";
import { reasonsOf, type Choices, type Reason, type Reasons } from "./reasons";

const most = 500;  // rows that are listed

/** Shown below the decision that holds. */
const choiceTable = ({ head, rows }: Choices): HTMLElement => h("table", { class: "candidates" }, h("thead", {}, h("tr", {}, ...head.map((text) => h("th", { scope: "col" }, text || h("span", { class: "unseen" }, "rank"))))),
  h("tbody", {}, ...rows.map(({ cells, chosen }) => h("tr", chosen ? { class: "chosen" } : {}, ...cells.map((text, i) => h("td", {}, chosen && i === 0 ? `${text} \u2713` : text))))));

export class WhyView {
  readonly element = h("section", { class: "why scrolls", tabindex: 0, "aria-label": "Why" });
  private all: Reasons[] = [];
  private timed: { t: number; row: HTMLElement; table?: Choices | undefined }[] = [];
  private current: HTMLElement | undefined;
  private shown = "";

  constructor(run: Run, private seek: (t: number) => void) { this.renew(run); }

  get empty(): boolean { return this.all.length === 0; }

  renew(run: Run): void {
    this.all = reasonsOf(run);
    const shown = JSON.stringify(this.all);
    if (shown === this.shown) return;
    this.shown = shown;
    this.timed = [];
    this.element.replaceChildren(...this.all.flatMap(({ title, about, rows }) => [h("h2", {}, title), h("p", { class: "about" }, about), h("ol", {}, ...rows.slice(0, most).map((row) => this.row(row)))]));
    this.timed.sort((a, b) => a.t - b.t);
    this.current = undefined;
  }

  private row({ t, head, text, table }: Reason): HTMLElement {
    const words = [h("b", {}, head), h("span", {}, text)];
    if (t === undefined) return h("li", {}, h("p", {}, ...words));
    const row = h("li", {}, h("button", { type: "button", onclick: () => this.seek(t) }, ...words));
    this.timed.push({ t, row, table });
    return row;
  }

  show(t: number): void {
    if (this.element.hidden) return;
    const { row, table } = this.timed[indexAt(this.timed, t)] ?? {};
    if (row === this.current) return;
    this.current?.removeAttribute("aria-current");
    this.current?.querySelector("table")?.remove();
    row?.setAttribute("aria-current", "step");
    if (table) row?.append(choiceTable(table));
    this.current = row;
  }
}
