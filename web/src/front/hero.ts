// The hero: the example run in plan view, over and over, while it is in sight.
import { h, icon } from "../base/dom";
import type { Run } from "../log/run";
import { Clock } from "../watch/clock";
import type { PlanView } from "../watch/plan_view";
import { openExample } from "./example";

/** The time at which a still picture shows what it is about: a ball in flight. */
const best_s = 20.2;
const speed = 2;

export class Hero {
  readonly element: HTMLElement;
  private button = h("button", { type: "button", class: "play", onclick: () => this.toggle() });
  private stage = h("div", { class: "hero-stage" });
  private caption = h("figcaption", {}, "An example: a robot with a water gun guards a garden.");
  private clock: Clock | null = null;
  private view: PlanView | null = null;
  private run: Run | null = null;
  private inSight = false;
  private closed = false;
  private frame = 0;
  private before = 0;
  private watcher = new IntersectionObserver(([entry]) => {
    this.inSight = entry?.isIntersecting ?? false;
    this.invalidate();
  });

  constructor(private wantsMotion = !matchMedia("(prefers-reduced-motion: reduce)").matches) {
    this.element = h("figure", { class: "hero panel" }, this.stage, this.caption, this.button);
    this.label(false);
    this.button.disabled = true;
    this.watcher.observe(this.element);
    void this.open().catch((error: Error) => { this.caption.textContent = error.message; });
  }

  close(): void {
    this.closed = true;
    cancelAnimationFrame(this.frame);
    this.watcher.disconnect();
    this.view?.close();
  }

  private async open(): Promise<void> {
    const [log, { Run: Opened }, { PlanView: View }] = await Promise.all([openExample(), import("../log/run"), import("../watch/plan_view")]);
    if (this.closed) return;
    this.run = new Opened(log);
    this.clock = new Clock(this.run.duration, () => this.invalidate());
    this.clock.speed = speed;
    this.view = new View(this.run, { redraw: () => this.invalidate(), selectShot: () => undefined, selectTarget: () => undefined }, true);
    this.stage.append(this.view.element);
    this.button.disabled = false;
    this.clock.seek(best_s);
    if (this.wantsMotion) this.toggle();
  }

  private toggle(): void {
    this.clock?.toggle();
    this.label(this.clock?.playing ?? false);
  }

  private label(playing: boolean): void {
    this.button.replaceChildren(icon(playing ? "pause" : "play"));
    this.button.setAttribute("aria-label", playing ? "Pause the example" : "Play the example");
    this.element.dataset.playing = String(playing);
  }

  private invalidate(): void {
    if (this.frame === 0 && this.inSight && this.view && !this.closed) this.frame = requestAnimationFrame((now) => this.draw(now));
  }

  private draw(now: number): void {
    this.frame = 0;
    const { clock, view, run } = this;
    if (!clock || !view || !run) return;
    const { playing } = clock;
    clock.advance((now - this.before) / 1000);
    this.before = now;
    if (playing && !clock.playing) clock.toggle(true);  // from the beginning again
    view.draw({ t: clock.t, shot: null, target: null, speed: 0 });
    this.element.dataset.t = clock.t.toFixed(2);
    this.caption.textContent = run.eventText(clock.t);
    if (clock.playing) this.invalidate();
  }
}
