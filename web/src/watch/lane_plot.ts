// A plot of lanes, which shares the axis of time with the plots of numbers.
import { h } from "../base/dom";
import { clamp } from "../base/numbers";
import { theme } from "../base/theme";
import { stretchAt, type Lanes } from "./lanes";

const left = 46;   // as the axes of numbers
const right = 18;
const thick = 7;

export class LanePlot {
  readonly element: HTMLElement;
  private canvas = h("canvas", { role: "img" });
  private cursor = h("i", { class: "lane-cursor" });
  private words = h("p", { class: "lane-words" });
  private pointed = false;
  private t = 0;
  private range: [number, number] = [0, 1];

  constructor(private lanes: Lanes, private acts: { point: (t: number | null) => void; seek: (t: number) => void }) {
    this.canvas.setAttribute("aria-label", lanes.title);
    const area = h("div", { class: "lane-area" }, this.canvas, this.cursor);
    this.element = h("figure", { class: "lane-plot" }, h("figcaption", {}, lanes.title), this.words, area);
    area.addEventListener("pointermove", (event) => {
      this.acts.point(this.timeAt(event));
      this.tell(event);
    });
    area.addEventListener("pointerleave", () => {
      this.pointed = false;
      this.sayPresent();
      this.acts.point(null);
    });
    area.addEventListener("click", (event) => this.acts.seek(this.timeAt(event)));
  }

  renew(lanes: Lanes): void { this.lanes = lanes; }

  /** Says what each colour means, and how many are in that state at the present time. */
  private sayPresent(): void {
    if (this.pointed) return;
    const { lanes } = this.lanes;
    const states = new Map(lanes.flatMap(({ stretches }) => stretches).map((one) => [one.words, one]));
    const now = lanes.map((lane) => stretchAt(lane, this.t)?.words);
    const text = [...states.keys()].map((words) => `${words} ${now.filter((one) => one === words).length}`).join();
    if (text === this.words.dataset.text) return;
    this.words.dataset.text = text;
    this.words.replaceChildren(...[...states].map(([words, { colour, faint }]) => {
      const count = now.filter((one) => one === words).length;
      return h("span", { class: count > 0 ? "present" : null }, h("i", { class: "swatch", style: `background:var(--${colour});opacity:${faint ? 0.4 : 1}` }), words, lanes.length > 1 && h("b", {}, String(count)));
    }));
  }

  private get across(): number { return Math.max(1, this.canvas.clientWidth - left - right); }

  private timeAt(event: MouseEvent): number {
    const [from, to] = this.range;
    return from + clamp((event.clientX - this.canvas.getBoundingClientRect().left - left) / this.across, 0, 1) * (to - from);
  }

  private tell(event: MouseEvent): void {
    const lane = this.lanes.lanes[Math.floor((event.clientY - this.canvas.getBoundingClientRect().top) / thick)];
    const there = lane && stretchAt(lane, this.timeAt(event));
    this.pointed = there !== undefined;
    if (!there) {
      this.sayPresent();
      return;
    }
    this.words.textContent = this.words.dataset.text = `${lane!.name}: ${there.words}`;
  }

  draw(range: [number, number], width: number): void {
    this.range = range;
    const { canvas } = this;
    const height = thick * this.lanes.lanes.length;
    const dpr = Math.min(3, devicePixelRatio || 1);
    Object.assign(canvas.style, { width: `${width}px`, height: `${height}px` });
    [canvas.width, canvas.height] = [Math.round(width * dpr), Math.round(height * dpr)];
    const ctx = canvas.getContext("2d")!;
    ctx.scale(dpr, dpr);
    const at = (t: number): number => left + clamp((t - range[0]) / (range[1] - range[0]), 0, 1) * (width - left - right);
    this.lanes.lanes.forEach(({ stretches }, row) => {
      for (const { from, to, colour, faint } of stretches) {
        if (to < range[0] || from > range[1]) continue;
        ctx.globalAlpha = faint ? 0.25 : 1;
        ctx.fillStyle = theme[colour];
        ctx.fillRect(at(from), row * thick + 1, Math.max(0.8, at(to) - at(from) - 0.4), thick - 2);
      }
    });
  }

  show(t: number): void {
    this.t = t;
    this.sayPresent();
    const [from, to] = this.range;
    this.cursor.hidden = t < from || t > to;
    this.cursor.style.left = `${left + ((t - from) / (to - from)) * this.across}px`;
  }
}
