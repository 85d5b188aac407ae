// The legend is the list of layers: each is a switch with its signs, and once the list is opened, an opacity.
import { h, iconButton } from "../base/dom";
import type { Run } from "../log/run";
import type { LayerChoice } from "./layer_choice";
import { signsOf } from "./parts";

export class Legend {
  readonly element = h("ul", { class: "legend", "aria-label": "Legend and layers" });
  readonly button = iconButton("layers", "Layers and their opacity", () => this.open(), "y");
  private shown = "";
  private run: Run | null = null;
  private away = (event: PointerEvent): void => {
    const at = event.target as Node;
    if (!this.element.contains(at) && !this.button.contains(at)) this.open(false);
  };

  private escape = (event: KeyboardEvent): void => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    this.open(false);
    this.button.focus();
  };

  constructor(private choice: LayerChoice, private changed: () => void) {
    this.button.setAttribute("aria-expanded", "false");
  }

  close(): void {
    removeEventListener("pointerdown", this.away);
    removeEventListener("keydown", this.escape, true);
  }

  get isOpen(): boolean { return this.element.classList.contains("open"); }

  open(open = !this.isOpen): void {
    this.element.classList.toggle("open", open);
    this.button.setAttribute("aria-expanded", String(open));
    this.close();
    if (!open) return;
    addEventListener("pointerdown", this.away);
    addEventListener("keydown", this.escape, true);
    this.element.querySelector("input")?.focus();
  }

  /** Lists the layers of a view, of which the last lies on top and comes first; writes only what has changed. */
  show(run: Run, names: readonly string[]): void {
    const key = `${names.join()}${this.choice.planning ? " planned" : ""}`;
    if (run === this.run && key === this.shown) return;
    const rows = new Map([...new Set(names)].reverse().flatMap((name): [string, HTMLElement[]][] => {
      const signs = signsOf(run, name);
      return signs ? [[name, signs]] : [];
    }));
    const same = key === this.shown && rows.size === this.element.children.length && [...this.element.children].every((row) => row.querySelector(".signs")?.textContent === rows.get((row as HTMLElement).dataset.layer!)?.map((one) => one.textContent).join(""));
    [this.run, this.shown] = [run, key];
    if (!same) this.element.replaceChildren(...[...rows].map(([name, signs]) => this.row(name, signs)));
  }

  private row(name: string, signs: HTMLElement[]): HTMLElement {
    const box = h("input", { type: "checkbox", "aria-label": name, checked: this.choice.of(name) > 0 });
    const slider = h("input", { type: "range", min: 0.1, max: 1, step: 0.05, value: this.choice.of(name) || 1, disabled: !box.checked, "aria-label": `Opacity of ${name}` });
    const row = h("li", { class: "layer", "data-layer": name }, h("label", { title: `Show or hide: ${name}` }, box, signs.map((one) => one.textContent).join() !== name && h("b", {}, name), h("span", { class: "signs" }, ...signs)), slider);
    row.firstElementChild!.addEventListener("click", (event) => { if ((event as MouseEvent).detail > 0 && !this.isOpen) setTimeout(() => box.blur()); });  // the keyboard stays with the view
    const keep = (): void => {
      slider.disabled = !box.checked;
      slider.style.setProperty("--done", `${(100 * (Number(slider.value) - 0.1)) / 0.9}%`);
      row.classList.toggle("off", !box.checked);
      row.classList.toggle("unasked", !box.checked && this.choice.usual(name) === 0);
    };
    for (const one of [box, slider]) {
      one.addEventListener("input", () => {
        this.choice.set(name, box.checked ? Number(slider.value) : 0);
        keep();
        this.changed();
      });
    }
    keep();
    return row;
  }
}
