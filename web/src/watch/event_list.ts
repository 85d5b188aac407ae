// Every event of the run; the present one is marked, a click goes there.
import { h } from "../base/dom";
import { GrowingList } from "../base/growing_list";
import { clockText } from "../base/numbers";
import { typeset } from "../base/typeset";
import type { LogLine } from "../log/messages";
import type { Run } from "../log/run";
import type { Stamped } from "../log/run_log";

export class EventList {
  readonly element = h("section", { class: "events scrolls", tabindex: 0, "aria-label": "Events" }, h("ol"));
  private list: GrowingList<Stamped<LogLine>>;
  private run!: Run;
  private current: HTMLElement | undefined;

  constructor(run: Run, seek: (t: number) => void) {
    this.list = new GrowingList(this.element.firstElementChild!, ({ t, message: { name, msg } }) => `${t} ${name} ${msg}`, ({ t, message: { name, msg } }) =>
      h("li", {}, h("button", { type: "button", class: name, onclick: () => seek(t) }, h("time", {}, clockText(t, 1)), h("span", {}, typeset(msg)))));
    this.renew(run);
  }

  get empty(): boolean { return this.run.events.length === 0; }

  renew(run: Run): void {
    this.run = run;
    this.list.show(run.events);
  }

  /** Shows the time; only rows in sight are asked for their places, because the answer takes a layout of the page. */
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
