// The fields of messages at the present time: of a channel that is chosen, or of the thing that was selected in plan or space.
import { h } from "../base/dom";
import { fixed, minus } from "../base/numbers";
import { fieldsOf, type Field } from "../log/fields";
import type { Run } from "../log/run";
import type { Told } from "./layer";

const most = 400;  // fields that are listed

const valueText = (value: Field["value"]): string =>
  (typeof value !== "number" ? String(value) : Number.isNaN(value) ? "unknown" : Number.isInteger(value) ? minus(value.toLocaleString("en")) : minus(String(+value.toPrecision(7))));

export class MessageView {
  readonly element: HTMLElement;
  private select = h("select", { "aria-label": "Channel" });
  private title = h("h2");
  private about = h("p", { class: "message-about" });
  private list = h("dl", { class: "settings fields" });
  private picked: Told | null = null;
  private shown: unknown = null;

  constructor(private run: Run) {
    this.element = h("section", { class: "facts messages scrolls", tabindex: 0, "aria-label": "Messages" }, this.select, this.title, this.about, this.list);
    this.select.addEventListener("change", () => {
      this.picked = null;
      this.shown = null;
      this.show(this.t);
    });
    this.renew(run);
  }

  private t = 0;

  renew(run: Run): void {
    this.run = run;
    const names = [...run.log.channels.values()].filter(({ topic }) => run.log.has(topic)).map(({ topic }) => topic).sort();
    if (names.join() === this.select.dataset.names) return;
    const before = this.select.value;
    this.select.dataset.names = names.join();
    this.select.replaceChildren(...names.map((name) => h("option", { value: name, selected: name === before }, name)));
  }

  /** Shows the message of a thing, whatever it is at the time. */
  pick(told: Told): void {
    this.picked = told;
    this.shown = null;
    this.select.value = told.topic;
  }

  show(t: number): void {
    this.t = t;
    if (this.element.hidden) return;
    const { log } = this.run;
    const topic = this.select.value;
    const found = log.at<unknown>(topic, t);
    const message = this.picked ? this.picked.at(t) : found?.message;
    this.title.textContent = this.picked?.name ?? "";
    this.title.hidden = this.picked === null;
    const type = log.channels.get(topic)?.type ?? "";
    this.about.textContent = message === undefined ? `no message by ${fixed(t, 2)} s` : this.picked ? type : `${type}, of ${fixed(found?.t, 3)} s`;
    if (message === this.shown) return;
    this.shown = message;
    this.list.replaceChildren(...fieldsOf(message).slice(0, most).map(({ name, depth, value }) =>
      h("div", { style: `padding-left:${12 * depth}px` }, h("dt", {}, name.replaceAll("_", " ")), h("dd", {}, valueText(value)))));
  }
}
