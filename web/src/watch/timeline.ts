// The timeline: play, pause, speed, a slider with a tick for everything that happened, and what happens now.
import { h, icon, iconButton } from "../base/dom";
import { GrowingList } from "../base/growing_list";
import { clockText, degrees, fixed, wrapped } from "../base/numbers";
import { plansOf, type PlannedPath } from "../log/plans";
import type { Run } from "../log/run";
import { speeds, type Clock } from "./clock";
import type { Mark } from "./marks";

export class Timeline {
  readonly element: HTMLElement;
  private play = iconButton("play", "Play or pause", () => this.clock.toggle(), "space");
  private live = h("button", { type: "button", class: "live", title: "Keep to what happens now (l)", onclick: () => this.clock.follow() }, "Live");
  private slider = h("input", { type: "range", min: 0, step: "any", value: 0, "aria-label": "Time of the run" });
  private clockText = h("output", { class: "clock" });
  private action = h("p", { class: "action" });
  private state = h("p", { class: "state" });
  private speed = h("select", { title: "Speed of playing (< >)", "aria-label": "Speed" },
    ...speeds.map((one) => h("option", { value: one }, `${one}\u00d7`)));
  // A second is one per cent of what they stand in, whose width alone changes when the end moves.
  private line = h("div", { class: "timeline" }, h("div", { class: "legs", "aria-hidden": "true" }), this.slider, h("div", { class: "ticks", "aria-hidden": "true" }));
  private legs = new GrowingList<PlannedPath>(this.line.firstElementChild!, ({ start, end }) => `${start} ${end}`,
    ({ start, end }) => h("i", { class: "leg", style: `left:${start}%;width:${end - start}%` }));
  private ticks = new GrowingList<Mark>(this.line.lastElementChild!, (mark) => `${mark.t} ${mark.kind} ${mark.title}`,
    (mark, i) => h("i", { class: `tick ${mark.kind}`, style: `left:${mark.t}%`, title: mark.title, onclick: () => this.acts.select(this.marks[i]!) }));
  private run!: Run;
  private marks: Mark[] = [];
  private shownMoving = false;
  private shownTick: HTMLElement | undefined;

  constructor(private clock: Clock, private acts: { step: (d: 1 | -1) => void; select: (mark: Mark) => void }) {
    this.play.className = "play";
    this.slider.addEventListener("input", () => clock.seek(Number(this.slider.value)));
    this.speed.addEventListener("change", () => { clock.speed = Number(this.speed.value); });
    this.element = h("section", { class: "panel transport", "aria-label": "Playing" },
      h("div", { class: "keys" }, iconButton("back", "Previous event", () => this.acts.step(-1), "p"), this.play,
        iconButton("next", "Next event", () => this.acts.step(1), "n"), this.speed, this.live),
      this.line, this.clockText, h("div", { class: "words" }, this.action, this.state));
  }

  renew(run: Run, marks: Mark[]): void {
    this.run = run;
    this.marks = marks;
    this.slider.max = String(this.clock.duration);
    for (const place of this.line.querySelectorAll("div")) place.style.width = `calc((100% - 14px) * ${100 / this.clock.duration})`;
    this.legs.show(plansOf(run));
    this.ticks.show(marks);
    this.live.hidden = !this.clock.goesOn;
  }

  show(selected: Mark | null): void {
    const { t, duration, playing, live, speed } = this.clock;
    this.slider.value = String(t);
    this.slider.style.setProperty("--done", `${((100 * t) / duration).toFixed(2)}%`);
    this.slider.setAttribute("aria-valuetext", `${clockText(t)} of ${clockText(duration)}`);
    this.clockText.textContent = `${clockText(t, 1)} / ${clockText(duration)}`;
    if (this.speed.value !== String(speed)) this.speed.value = String(speed);
    this.live.setAttribute("aria-pressed", String(live));
    const { track, info } = this.run;
    this.action.textContent = this.run.eventText(t);
    const tick = selected ? this.ticks.elements[this.marks.indexOf(selected)] : undefined;
    if (tick !== this.shownTick) {
      this.shownTick?.classList.remove("selected");
      tick?.classList.add("selected");
      this.shownTick = tick;
    }
    if ((playing || live) !== this.shownMoving) {
      this.shownMoving = playing || live;
      this.play.replaceChildren(icon(this.shownMoving ? "pause" : "play"));
    }
    if (track.length === 0) return;
    const at = track.at(t);
    const gun = info.gun_length > 0 ? `  gun ${degrees(wrapped(at.yaw), 0)} \u2191${degrees(at.pitch, 0)}` : "";
    this.state.textContent = `x ${fixed(at.x, 2)}  y ${fixed(at.y, 2)}  \u2220 ${degrees(wrapped(at.heading), 0)}${gun}`;
  }
}
