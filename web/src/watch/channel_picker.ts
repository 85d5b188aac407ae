// Adds a plot of any number of any channel.
import { h } from "../base/dom";
import type { Run } from "../log/run";
import { channelsOf } from "./channel_series";

export class ChannelPicker {
  readonly element = h("select", { "aria-label": "Plot a number of a channel" });

  constructor(private run: () => Run, choose: (key: string) => void) {
    this.element.append(h("option", { value: "" }, "Plot a channel \u2026"));
    for (const event of ["pointerdown", "focus"]) this.element.addEventListener(event, () => this.fill());
    this.element.addEventListener("change", () => {
      if (this.element.value) choose(this.element.value);
      this.element.value = "";
    });
  }

  /** When it is about to be opened, since it takes a message of each channel. */
  private fill(): void {
    const groups = channelsOf(this.run());
    const key = JSON.stringify(groups);
    if (this.element.dataset.key === key) return;
    this.element.dataset.key = key;
    this.element.replaceChildren(h("option", { value: "" }, "Plot a channel \u2026"), ...groups.map(({ topic, paths }) =>
      h("optgroup", { label: topic }, ...paths.map((path) => h("option", { value: `${topic}:${path}` }, path.replaceAll(".", " "))))));
  }
}
