// Watch: one run from its log. One time, one selected shot and target, and the views that show them.
import type { SceneAnswer } from "../api";
import { h } from "../base/dom";
import { keepInAddress } from "../base/url";
import { keys } from "../base/keys";
import { clockText, finite } from "../base/numbers";
import { perform, type MenuItem } from "../base/menu";
import { saveBlob, saveCanvas, saveText } from "../base/save";
import { flightsOf, type Flight } from "../log/flights";
import { Run } from "../log/run";
import type { RunLog } from "../log/run_log";
import { targetsOf, type TargetStory } from "../log/targets";
import { topic } from "../log/topics";
import { Clock, neighbour } from "./clock";
import { hasEncoder } from "./encode";
import { EventList } from "./event_list";
import { Facts } from "./facts";
import { showFilmDialog } from "./film_dialog";
import { Frame } from "./frame";
import type { Now, Told } from "./layer";
import { LayerChoice } from "./layer_choice";
import { marksOf, type Mark } from "./marks";
import { MessageView } from "./message_view";
import { playingKeys } from "./playing_keys";
import { Plots } from "./plots";
import { SideView } from "./side_view";
import { Stage } from "./stage";
import { Tabs } from "./tabs";
import { TargetTable } from "./target_table";
import { Timeline } from "./timeline";
import { WhyView } from "./why_view";

const calm = matchMedia("(prefers-reduced-motion: reduce)");

export class Watch {
  readonly element: HTMLElement;
  private run: Run;
  private clock: Clock;
  private marks: Mark[];
  private selected: { mark: Mark | null; shot: Flight | null; target: TargetStory | null } = { mark: null, shot: null, target: null };
  private stage: Stage;
  private side: SideView;
  private table: TargetTable;
  private events: EventList;
  private plots: Plots;
  private facts = new Facts();
  private messages: MessageView;
  private why: WhyView;
  private tabs: Tabs;
  private timeline: Timeline;
  private frameAsked = 0;
  private renewAsked = 0;
  private rest_ms = 150;  // until more of a large file is shown
  private before = 0;
  private last: Flight | undefined;

  /** `goesOn`: the run is not over; renew() shows more of it. */
  constructor(private log: RunLog, query: Record<string, string>, goesOn = false) {
    this.run = new Run(log, goesOn);
    this.clock = new Clock(this.run.duration, () => this.invalidate(), goesOn);
    this.marks = marksOf(this.run);
    this.stage = new Stage(this.run, { redraw: () => this.invalidate(), selectShot: (shot) => this.selectShot(shot), selectTarget: (one) => this.selectTarget(one),
      exports: () => this.exports(), tell: (told) => this.tell(told) }, new LayerChoice(query.layers));
    this.events = new EventList(this.run, (t) => this.clock.seek(t));
    this.plots = new Plots(this.run, (t) => this.clock.seek(t), query.plots?.split(",").filter(Boolean));
    this.messages = new MessageView(this.run);
    this.why = new WhyView(this.run, (t) => this.clock.seek(t));
    this.side = new SideView(this.run, () => this.invalidate());
    this.table = new TargetTable(this.run, (target) => this.selectTarget(target));
    this.timeline = new Timeline(this.clock, { step: (d) => this.step(d), select: (mark) => this.selectMark(mark) });
    this.timeline.renew(this.run, this.marks);
    this.facts.renew(this.run, goesOn);
    this.tabs = this.madeTabs();
    this.element = h("div", { class: "watch" }, this.stage.element, this.timeline.element, h("section", { class: "panel aside" }, this.tabs.element));
    this.listen(log);
    this.bindKeys();
    this.begin(query);
  }

  close(): void {
    cancelAnimationFrame(this.frameAsked);
    this.frameAsked = -1;
    this.log.changed = () => undefined;
    clearTimeout(this.renewAsked);
    keys.drop(this);
    this.stage.close();
    this.side.close();
    this.plots.close();
  }

  /** Shows the scenario of a run until its log tells more. */
  expect(scene: SceneAnswer): void { this.stage.expect(scene); }

  private madeTabs(): Tabs {
    return new Tabs([
      { name: "Targets", element: h("div", { class: "split" }, this.side.element, this.table.element), empty: () => targetsOf(this.run).length === 0 },
      { name: "Plots", element: this.plots.element, empty: () => this.plots.empty },
      { name: "Events", element: this.events.element, empty: () => this.events.empty },
      { name: "Why", element: this.why.element, empty: () => this.why.empty },
      { name: "Numbers", element: this.facts.element, empty: () => false },
      { name: "Messages", element: this.messages.element, empty: () => false },
    ], (name) => { keepInAddress({ tab: name.toLowerCase() }); this.invalidate(); });
  }

  /** Shows more of the run, or all of it in the end, and else what it showed: the time, the shot, the tab, the view. */
  renew(log: RunLog, goesOn: boolean): void {
    const run = new Run(log, goesOn);
    this.listen(log);
    const { shot, target, mark } = this.selected;
    this.run = run;
    this.marks = marksOf(run);
    for (const part of [this.stage, this.side, this.table, this.events, this.plots, this.messages, this.why]) part.renew(run);
    this.clock.grow(run.duration, goesOn);
    this.timeline.renew(run, this.marks);
    this.facts.renew(run, goesOn);
    this.tabs.renew();
    const same = (shot ? flightsOf(run)[shot.index] : flightsOf(run).find((one) => one.target === target?.name)) ?? null;
    this.last = this.last && flightsOf(run)[this.last.index];
    this.select(same, this.named(target?.name) ?? targetsOf(run)[0] ?? null);
    if (mark && !same) this.selected.mark = this.marks.find((one) => one.t === mark.t && one.title === mark.title) ?? null;
    if (!goesOn) this.bindKeys();
  }

  /** As the address says: t, shot, view, tab, follow. Without a time it plays, or keeps to the head of a run that goes on. */
  private begin(query: Record<string, string>): void {
    this.tabs.choose(query.tab ?? "", false);
    const flights = flightsOf(this.run);
    const shot = flights[Number(query.shot ?? 1) - 1] ?? flights[0] ?? null;
    this.choose(shot, this.named(shot?.target) ?? targetsOf(this.run)[0] ?? null);
    if (query.view === "3d") void this.stage.show(true);
    if (query.follow) this.stage.setFollow(true);
    if (query.t !== undefined) this.clock.seek(finite(Number(query.t)));
    else if (query.shot !== undefined && shot) this.clock.seek(shot.start);
    else if (this.clock.goesOn) this.clock.follow();
    else if (!calm.matches) this.clock.toggle(true);
    else this.invalidate();
  }

  /** A part of a large file that was asked for has been read. */
  private listen(log: RunLog): void {
    if (log !== this.log) this.log.changed = () => undefined;
    this.log = log;
    log.changed = (grew) => {
      if (grew) this.renewAsked ||= window.setTimeout(() => this.renewRead(), this.rest_ms);
      else this.invalidate();
    };
  }

  private renewRead(): void {
    this.renewAsked = 0;
    this.rest_ms *= 1.5;  // all of it is worked out again each time
    if (this.frameAsked >= 0) this.renew(this.log, this.run.goesOn);
  }

  private named(name: string | undefined): TargetStory | null { return targetsOf(this.run).find((one) => one.name === name) ?? null; }

  private invalidate(): void {
    if (this.frameAsked === 0) this.frameAsked = requestAnimationFrame((now) => this.frame(now));
  }

  private frame(now: number): void {
    this.frameAsked = 0;
    const { clock } = this;
    clock.advance(clock.live && calm.matches ? Infinity : (now - this.before) / 1000);
    this.before = now;
    this.followShots();
    this.stage.draw(this.present);
    this.side.draw(clock.t);
    this.table.show(clock.t, this.selected.target);
    this.events.show(clock.t);
    this.plots.show(clock.t);
    this.messages.show(clock.t);
    this.why.show(clock.t);
    this.timeline.show(this.selected.mark);
    if (clock.moves) this.invalidate();
    else keepInAddress({ t: clock.live ? "" : clock.t.toFixed(2) });
  }

  private get present(): Now {
    const { clock, selected: { shot, target } } = this;
    return { t: clock.t, shot, target, speed: clock.moves && !calm.matches ? clock.speed : 0 };
  }

  /** While time passes, the side view shows the shot that was fired last. */
  private followShots(): void {
    if (!this.clock.playing && !this.clock.live) return;
    const last = flightsOf(this.run).findLast((shot) => shot.start <= this.clock.t);
    if (last && last !== this.last) this.choose(last, this.named(last.target));
    this.last = last;
  }

  private select(shot: Flight | null, target: TargetStory | null): void {
    this.selected = { shot, target, mark: this.marks.find((mark) => shot !== null && mark.shot === shot) ?? null };
    this.side.select(shot, target);
    this.invalidate();
  }

  private choose(shot: Flight | null, target: TargetStory | null): void {
    this.select(shot, target);
    if (target) this.table.reveal(target);
  }

  private selectShot(shot: Flight): void {
    this.choose(shot, this.named(shot.target));
    this.last = shot;
    this.clock.seek(shot.start);
    keepInAddress({ shot: String(shot.index + 1) });
  }

  /** Again and again: the target's shots in turn, the last one first. */
  private selectTarget(target: TargetStory): void {
    const fired = flightsOf(this.run).filter((shot) => shot.target === target.name);
    const shown = fired.findIndex((shot) => shot === this.selected.shot);
    const next = fired.at(shown < 0 ? -1 : (shown + 1) % fired.length);
    if (next) this.selectShot(next);
    else this.choose(null, target);
  }

  /** Something was clicked: its message is shown, on top where nothing else here tells of it. */
  private tell(told: Told): void {
    this.messages.pick(told);
    if (told.topic === topic.targets || told.topic === topic.shots) this.invalidate();
    else this.tabs.choose("Messages");
  }

  private selectMark(mark: Mark): void {
    if (mark.shot) {
      this.selectShot(mark.shot);
      return;
    }
    this.selected.mark = mark;
    this.clock.seek(mark.t);
  }

  private step(direction: 1 | -1): void {
    const mark = neighbour(this.marks, this.clock.t, direction);
    if (mark) this.selectMark(mark);
  }

  private get name(): string { return this.run.name || "run"; }
  private get instant(): string { return `${this.name}-${clockText(this.clock.t, 1).replace(":", "m")}s`; }

  /** Returns the items that save something: the view at this instant, a film of it, the run. */
  private exports(): MenuItem[] {
    const { log } = this;
    const later = "when the run is over";
    return [
      { name: "PNG", about: "this view as a picture", key: "s", act: () => saveCanvas(this.stage.canvas, `${this.instant}.png`) },
      { name: "SVG", about: "the plan as shapes and text", key: "g", act: () => saveText(this.stage.svg(this.present), `${this.instant}.svg`, "image/svg+xml") },
      { name: hasEncoder() ? "WebM" : "Frames", about: "a film of this view", key: "m", act: () => this.saveFilm() },
      { name: "JSON", about: "how the run ended, its numbers", key: "J", refusal: !log.summary && (this.run.goesOn ? later : "the log was cut short, before its end"), act: () => saveText(JSON.stringify(log.summary, null, 1), "run.json") },
      { name: "MCAP", about: "the log of the run", key: "j", refusal: !log.file && later, act: () => void log.file!.whole().then((blob) => saveBlob(blob, "run.mcap")) },
    ];
  }

  /** Opens the dialog that saves frames of the current view; a frame depends on the time alone. */
  private saveFilm(): void {
    const { clock, run } = this;
    clock.toggle(false);
    const frame = new Frame(run);
    showFilmDialog({ duration: clock.duration, now: clock.t, name: this.name, done: () => this.invalidate(), draw: (t) => {
      const shot = flightsOf(run).findLast((one) => one.start <= t) ?? null;
      this.stage.draw({ t, shot, target: this.named(shot?.target), speed: 1 });
      return frame.of(this.stage.canvas, t);
    } });
  }

  private bindKeys(): void {
    const { clock, stage } = this;
    keys.set("Playing", playingKeys(clock, (direction) => this.step(direction)), this);
    keys.set("View", [
      { key: "v", words: "plan or space", act: () => void stage.show(!stage.inSpace) },
      { key: "r", words: "measure in the plan", act: () => stage.measure() },
      { key: "y", words: "layers", act: () => stage.showLayers() },
      { key: "f", words: "follow the robot", act: () => stage.setFollow(!stage.following) },
      { key: "+", words: "zoom in", act: () => stage.zoom(true) },
      { key: "-", words: "zoom out", act: () => stage.zoom(false) },
      { key: "0", words: "show everything", act: () => stage.reset() },
      { key: "t", words: "next tab", act: () => this.tabs.next() },
      ...this.exports().map(({ name, about, key }, i) => ({ key: key!, words: `save ${about} (${name})`, act: () => perform(this.exports()[i]) })),
    ], this);
  }
}
