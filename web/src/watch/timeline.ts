// The timeline: play, pause, speed, a slider with a tick for everything that happened, and what happens now.
import { h, icon, iconButton } from "../base/dom";
import { clamp, clockText, degrees, finite, fixed, wrapped } from "../base/numbers";
import type { Run } from "../report/run";
import { speeds, type Clock } from "./clock";
import type { Mark } from "./marks";

export class Timeline {
  readonly element: HTMLElement;
  private play = iconButton("play", "Play or pause", () => this.clock.toggle(), "space");
  private slider = h("input", { type: "range", min: 0, step: "any", value: 0, "aria-label": "Time of the run" });
  private clockText = h("output", { class: "clock" });
  private action = h("p", { class: "action" });
  private state = h("p", { class: "state" });
  private speed = h("select", { title: "Speed of playing (< >)", "aria-label": "Speed" },
    ...speeds.map((one) => h("option", { value: one }, `${one}\u00d7`)));
  private ticks: HTMLElement[];
  private shownPlaying = false;

  constructor(private run: Run, private clock: Clock, private marks: Mark[], private acts: { step: (d: 1 | -1) => void; select: (mark: Mark) => void }) {
    this.play.className = "play";
    this.slider.max = String(clock.duration);
    this.slider.addEventListener("input", () => clock.seek(Number(this.slider.value)));
    this.speed.addEventListener("change", () => { clock.speed = Number(this.speed.value); });
    const share = (t: number): string => `${(100 * clamp(t / clock.duration, 0, 1)).toFixed(3)}%`;
    this.ticks = marks.map((mark) => h("i", { class: `tick ${mark.kind}`, style: `left:${share(mark.t)}`, title: mark.title,
      onclick: () => acts.select(mark) }));
    const legs = run.report.paths.map((path) => h("i", { class: "leg",
      style: `left:${share(finite(path.start_s))};width:${share(finite(path.end_s) - finite(path.start_s))}` }));
    this.element = h("section", { class: "panel transport", "aria-label": "Playing" },
      h("div", { class: "keys" }, iconButton("back", "Previous event", () => this.acts.step(-1), "p"), this.play,
        iconButton("next", "Next event", () => this.acts.step(1), "n"), this.speed),
      h("div", { class: "timeline" }, h("div", { class: "ticks", "aria-hidden": "true" }, ...legs, ...this.ticks), this.slider),
      this.clockText, h("div", { class: "words" }, this.action, this.state));
  }

  show(selected: Mark | null): void {
    const { t, duration, playing, speed } = this.clock;
    this.slider.value = String(t);
    this.slider.style.setProperty("--done", `${((100 * t) / duration).toFixed(2)}%`);
    this.slider.setAttribute("aria-valuetext", `${clockText(t)} of ${clockText(duration)}`);
    this.clockText.textContent = `${clockText(t, 1)} / ${clockText(duration)}`;
    if (this.speed.value !== String(speed)) this.speed.value = String(speed);
    const { events, track, robot } = this.run.report;
    this.action.textContent = events[this.run.eventIndex(t)]?.text ?? "";
    this.marks.forEach((mark, i) => this.ticks[i]!.classList.toggle("selected", mark === selected));
    if (playing !== this.shownPlaying) {
      this.shownPlaying = playing;
      this.play.replaceChildren(icon(playing ? "pause" : "play"));
    }
    if (track.length === 0) return;
    const at = this.run.track.at(t);
    const gun = finite(robot.gun_length_m) > 0 ? `  gun ${degrees(wrapped(at.yaw), 0)} \u2191${degrees(at.pitch, 0)}` : "";
    this.state.textContent = `x ${fixed(at.x, 2)}  y ${fixed(at.y, 2)}  \u2220 ${degrees(wrapped(at.heading), 0)}${gun}`;
  }
}
