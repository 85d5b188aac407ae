// Tabs of the panel beside the stage, as the ARIA practices describe them.
import { h } from "../base/dom";

export interface Page {
  name: string;
  element: HTMLElement;
  /** There is nothing to show on it yet. */
  empty: () => boolean;
}

export class Tabs {
  readonly element: HTMLElement;
  private buttons: HTMLButtonElement[];
  private wanted = "";

  constructor(private pages: Page[], private changed: (name: string) => void) {
    this.buttons = pages.map(({ name }) => h("button", { type: "button", role: "tab", onclick: () => this.choose(name) }, name));
    const list = h("div", { class: "tabs", role: "tablist" }, ...this.buttons);
    list.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      this.next(by);
      this.buttons.find((one) => one.tabIndex === 0)!.focus();
    });
    for (const { element } of pages) element.setAttribute("role", "tabpanel");
    this.element = h("div", { class: "tabbed" }, list, ...pages.map(({ element }) => element));
  }

  next(by = 1): void {
    const shown = this.pages.filter((page) => !page.empty());
    const chosen = shown.findIndex(({ element }) => !element.hidden);
    this.choose(shown[(chosen + by + shown.length) % shown.length]!.name);
  }

  /** Chooses a tab by its name in any case. */
  choose(name: string, tell = true): void {
    this.wanted = name.toLowerCase();
    this.renew();
    if (tell) this.changed(name);
  }

  /** Shows the page that was chosen last, or the first while that one is empty. */
  renew(): void {
    const shown = this.pages.filter((page) => !page.empty());
    const chosen = shown.find(({ name }) => name.toLowerCase() === this.wanted) ?? shown[0];
    this.pages.forEach((page, i) => {
      const button = this.buttons[i]!;
      button.hidden = !shown.includes(page);
      page.element.hidden = page !== chosen;
      button.setAttribute("aria-selected", String(page === chosen));
      button.tabIndex = page === chosen ? 0 : -1;
    });
  }
}
