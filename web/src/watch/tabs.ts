// Tabs of the panel beside the stage, as the ARIA practices describe them.
import { h } from "../base/dom";

export class Tabs {
  readonly element: HTMLElement;
  private buttons: HTMLButtonElement[];
  private chosen = 0;

  constructor(private pages: [string, HTMLElement][], private changed: (name: string) => void) {
    this.buttons = pages.map(([name], i) => h("button", { type: "button", role: "tab", onclick: () => this.choose(pages[i]![0]) }, name));
    const list = h("div", { class: "tabs", role: "tablist" }, ...this.buttons);
    list.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      this.next(by);
      this.buttons[this.chosen]!.focus();
    });
    pages.forEach(([, page]) => { page.setAttribute("role", "tabpanel"); });
    this.element = h("div", { class: "tabbed" }, list, ...pages.map(([, page]) => page));
  }

  next(by = 1): void {
    this.choose(this.pages[(this.chosen + by + this.pages.length) % this.pages.length]![0]);
  }

  /** By its name in any case; an unknown one chooses the first. */
  choose(name: string, tell = true): void {
    this.chosen = Math.max(0, this.pages.findIndex(([one]) => one.toLowerCase() === name.toLowerCase()));
    this.pages.forEach(([, page], i) => { page.hidden = i !== this.chosen; });
    this.buttons.forEach((button, i) => {
      button.setAttribute("aria-selected", String(i === this.chosen));
      button.tabIndex = i === this.chosen ? 0 : -1;
    });
    if (tell) this.changed(this.pages[this.chosen]![0]);
  }
}
