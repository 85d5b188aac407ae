// A button with a menu below it, as the ARIA practices describe one: arrows walk through it, Escape and a click beside it close it.
import { announce } from "./announce";
import { h, icon } from "./dom";

export interface MenuItem {
  name: string;
  /** A description in a few words. */
  about: string;
  key?: string;
  act: () => void;
  /** Why it cannot be chosen now; the menu says so, and its key announces it. */
  refusal?: string | false;
}

/** Acts as somebody chose, by the menu or by a key, unless it cannot be chosen now. */
export function perform(item: MenuItem | undefined): void {
  if (item?.refusal) announce(`${item.name}: ${item.refusal}.`);
  else item?.act();
}

export class MenuButton {
  readonly element: HTMLElement;
  private button: HTMLButtonElement;
  private list = h("ul", { class: "menu", role: "menu", hidden: true });
  private away = (event: PointerEvent): void => { if (!this.element.contains(event.target as Node)) this.show(false); };

  /** `items` is asked each time the menu opens. */
  constructor(iconName: string, words: string, private items: () => MenuItem[]) {
    this.button = h("button", { type: "button", class: "quiet", title: words, "aria-label": words, "aria-haspopup": "menu", "aria-expanded": "false", onclick: () => this.show(this.list.hidden) }, icon(iconName));
    this.list.setAttribute("aria-label", words);
    this.element = h("div", { class: "menu-holder" }, this.button, this.list);
    this.element.addEventListener("keydown", (event) => this.walk(event));
    this.element.addEventListener("focusout", (event) => { if (!this.list.hidden && event.relatedTarget && !this.element.contains(event.relatedTarget as Node)) this.show(false); });
  }

  close(): void { removeEventListener("pointerdown", this.away); }

  private show(open: boolean): void {
    this.list.hidden = !open;
    this.button.setAttribute("aria-expanded", String(open));
    removeEventListener("pointerdown", this.away);
    if (!open) return;
    addEventListener("pointerdown", this.away);
    this.list.replaceChildren(...this.items().map((item) => h("li", { role: "none" },
      h("button", { type: "button", role: "menuitem", tabindex: -1, "aria-disabled": item.refusal ? "true" : null, onclick: () => this.choose(item) },
        h("b", {}, item.name), h("span", {}, item.refusal || item.about), item.key ? h("kbd", {}, item.key) : null))));
    this.list.querySelector("button")?.focus();
  }

  private choose(item: MenuItem): void {
    if (!item.refusal) {
      this.show(false);
      this.button.focus();
    }
    perform(item);
  }

  private walk(event: KeyboardEvent): void {
    if (this.list.hidden) return;
    const all = [...this.list.querySelectorAll("button")];
    const at = all.indexOf(document.activeElement as HTMLButtonElement);
    const to: Record<string, number> = { ArrowDown: at + 1, ArrowUp: at - 1 + all.length, Home: 0, End: all.length - 1 };
    event.stopPropagation();
    if (event.key === "Escape") {
      this.show(false);
      this.button.focus();
    } else if (event.key in to) {
      event.preventDefault();
      all[to[event.key]! % all.length]?.focus();
    }
  }
}
