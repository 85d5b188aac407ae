// Steps through a search: play, pause, one expansion forward or back.
import { h, icon, iconButton } from "../base/dom";
import { clamp } from "../base/numbers";

export class Steps {
  readonly element: HTMLElement;
  private length = 0;
  private present = 0;
  private playing = false;
  private asked = 0;
  private play = iconButton("play", "Play or pause the search", () => this.toggle(), "space");
  private slider = h("input", { type: "range", min: 0, max: 0, step: 1, value: 0, "aria-label": "Expansions shown" });
  private text = h("output", { class: "clock" });

  constructor(private changed: () => void, words: HTMLElement) {
    this.play.className = "play";
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)));
    this.element = h("section", { class: "panel transport", "aria-label": "The search" },
      h("div", { class: "keys" }, iconButton("back", "One expansion back", () => this.go(this.present - 1), "\u2190"), this.play,
        iconButton("next", "One expansion on", () => this.go(this.present + 1), "\u2192")),
      h("div", {}, this.slider), this.text, h("div", { class: "words" }, words));
    this.show();
  }

  get step(): number { return this.present; }
  get end(): number { return this.length; }

  /** Takes another search and shows it to its end, unless a step is given. */
  take(length: number, step = length): void {
    this.length = length;
    this.playing = false;
    this.go(step);
  }

  go(step: number): void {
    this.present = clamp(Math.round(step), 0, this.length);
    this.show();
    this.changed();
  }

  toggle(on = !this.playing): void {
    this.playing = on && this.length > 0;
    if (this.playing && this.present >= this.length) this.present = 0;
    this.show();
    if (this.playing && this.asked === 0) this.asked = requestAnimationFrame(() => this.frame());
  }

  close(): void {
    cancelAnimationFrame(this.asked);
  }

  /** Plays the whole search in about five seconds; a short one at one expansion per frame. */
  private frame(): void {
    this.asked = 0;
    if (!this.playing) return;
    this.go(this.present + Math.max(1, this.length / 300));
    if (this.present >= this.length) this.playing = false;
    this.show();
    if (this.playing) this.asked = requestAnimationFrame(() => this.frame());
  }

  private show(): void {
    this.element.classList.toggle("idle", this.length === 0);
    this.slider.max = String(this.length);
    this.slider.value = String(this.present);
    this.slider.disabled = this.length === 0;
    this.slider.style.setProperty("--done", `${this.length > 0 ? (100 * this.present) / this.length : 0}%`);
    this.text.textContent = this.length > 0 ? `${this.present.toLocaleString("en")} / ${this.length.toLocaleString("en")}` : "";
    this.play.replaceChildren(icon(this.playing ? "pause" : "play"));
  }
}
