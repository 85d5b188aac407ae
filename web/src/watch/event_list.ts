// Every event of the run; the present one is marked, a click goes there.
import { h } from "../base/dom";
import { clockText } from "../base/numbers";
import type { Run } from "../report/run";

export class EventList {
  readonly element: HTMLElement;
  private rows: HTMLElement[];
  private shown = -2;

  constructor(private run: Run, seek: (t: number) => void) {
    this.rows = run.report.events.map((event) => h("li", {}, h("button", { type: "button", class: event.kind, onclick: () => seek(event.time_s ?? 0) },
      h("time", {}, clockText(event.time_s, 1)), h("span", {}, event.text))));
    this.element = h("ol", { class: "events scrolls", tabindex: 0, "aria-label": "Events" }, ...this.rows);
  }

  show(t: number): void {
    const index = this.run.eventIndex(t);
    if (index === this.shown) return;
    this.rows[this.shown]?.removeAttribute("aria-current");
    this.shown = index;
    const row = this.rows[index];
    if (!row) return;
    row.setAttribute("aria-current", "step");
    const { element } = this;
    if (row.offsetTop < element.scrollTop || row.offsetTop + row.offsetHeight > element.scrollTop + element.clientHeight) {
      element.scrollTop = row.offsetTop - element.clientHeight / 3;
    }
  }
}
