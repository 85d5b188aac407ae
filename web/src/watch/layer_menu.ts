// The list of layers: a switch and an opacity for each that this run has.
import { h, iconButton } from "../base/dom";
import type { LayerChoice } from "./layer_choice";

export class LayerMenu {
  readonly element: HTMLElement;
  private button = iconButton("layers", "Layers", () => this.show(this.panel.hidden), "y");
  private panel = h("section", { class: "menu layers", "aria-label": "Layers", hidden: true });
  private away = (event: PointerEvent): void => { if (!this.element.contains(event.target as Node)) this.show(false); };

  /** `names` is asked each time the list opens. */
  constructor(private choice: LayerChoice, private names: () => string[], private changed: () => void) {
    this.button.setAttribute("aria-expanded", "false");
    this.element = h("div", { class: "menu-holder" }, this.button, this.panel);
    this.element.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || this.panel.hidden) return;
      event.stopPropagation();
      this.show(false);
      this.button.focus();
    });
  }

  close(): void { removeEventListener("pointerdown", this.away); }

  show(open = this.panel.hidden): void {
    this.panel.hidden = !open;
    this.button.setAttribute("aria-expanded", String(open));
    removeEventListener("pointerdown", this.away);
    if (!open) return;
    addEventListener("pointerdown", this.away);
    this.panel.replaceChildren(...this.names().map((name) => this.row(name)));
    this.panel.querySelector("input")?.focus();
  }

  private row(name: string): HTMLElement {
    const box = h("input", { type: "checkbox", checked: this.choice.of(name) > 0 });
    const slider = h("input", { type: "range", min: 0.1, max: 1, step: 0.05, value: this.choice.of(name) || 1, disabled: !box.checked, "aria-label": `Opacity of ${name}` });
    const keep = (): void => {
      slider.disabled = !box.checked;
      slider.style.setProperty("--done", `${(100 * (Number(slider.value) - 0.1)) / 0.9}%`);
      this.choice.set(name, box.checked ? Number(slider.value) : 0);
    };
    for (const one of [box, slider]) one.addEventListener("input", () => { keep(); this.changed(); });
    keep();
    return h("div", { class: "layer" }, h("label", {}, box, name), slider);
  }
}
