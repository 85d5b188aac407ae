// Every event of the run; the present one is marked, a click goes there.
import { h } from "../base/dom";
import { GrowingList } from "../base/growing_list";
import { clockText } from "../base/numbers";
import type { Run } from "../report/run";
import type { Event } from "../report/types";

export class EventList {
  readonly element = h("ol", { class: "events scrolls", tabindex: 0, "aria-label": "Events" });
  private list: GrowingList<Event>;
  private run!: Run;
  private current: HTMLElement | undefined;

  constructor(run: Run, seek: (t: number) => void) {
    this.list = new GrowingList(this.element, ({ time_s, kind, text }) => `${time_s} ${kind} ${text}`, ({ time_s, kind, text }) =>
      h("li", {}, h("button", { type: "button", class: kind, onclick: () => seek(time_s ?? 0) }, h("time", {}, clockText(time_s, 1)), h("span", {}, text))));
    this.renew(run);
  }

  get empty(): boolean { return this.run.report.events.length === 0; }

  renew(run: Run): void {
    this.run = run;
    this.list.show(run.report.events);
  }

  /** Where the rows stand is asked only of those in sight: the answer takes a layout of the page. */
  show(t: number): void {
    if (this.element.hidden) return;
    const row = this.list.elements[this.run.eventIndex(t)];
    if (row === this.current) return;
    this.current?.removeAttribute("aria-current");
    this.current = row;
    if (!row) return;
    row.setAttribute("aria-current", "step");
    const { element } = this;
    if (row.offsetTop < element.scrollTop || row.offsetTop + row.offsetHeight > element.scrollTop + element.clientHeight) {
      element.scrollTop = row.offsetTop - element.clientHeight / 3;
    }
  }
}
