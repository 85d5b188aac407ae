// The stage: the plan and the view in space of the same instant, which of them is shown, its legend and its tools.
import type { SceneAnswer } from "../api";
import { announce } from "../base/announce";
import { h, iconButton } from "../base/dom";
import { MenuButton, type MenuItem } from "../base/menu";
import { keepInAddress } from "../base/url";
import type { Flight } from "../log/flights";
import type { Run } from "../log/run";
import type { TargetStory } from "../log/targets";
import { isPlanning } from "../log/tours";
import type { Now, Told } from "./layer";
import type { LayerChoice } from "./layer_choice";
import { Legend } from "./legend";
import { PlanView } from "./plan_view";
import type { SpaceView } from "./space_view";

export interface StageActs {
  redraw: () => void;
  selectShot: (shot: Flight) => void;
  selectTarget: (target: TargetStory) => void;
  tell: (told: Told) => void;
  exports: () => MenuItem[];
}

const measuring = "Measure in the plan: drag (r)";

export class Stage {
  readonly element: HTMLElement;
  inSpace = false;
  following = false;
  private plan: PlanView;
  private space: SpaceView | null = null;
  private stage = h("div", { class: "stage" });
  private bar = h("div", { class: "stage-bar" });
  private switcher: HTMLElement;
  private legend: Legend;
  private followButton = iconButton("follow", "Follow the robot", () => this.setFollow(!this.following), "f");
  private rulerButton = iconButton("ruler", "Measure in the plan: drag", () => this.measure(), "r");
  private barWatcher: ResizeObserver;
  private menu: MenuButton;

  constructor(private run: Run, private acts: StageActs, private choice: LayerChoice) {
    choice.planning = isPlanning(run);
    this.plan = new PlanView(run, acts, false, choice);
    this.legend = new Legend(choice, () => {
      keepInAddress({ layers: choice.text });
      this.plan.choiceChanged();
    });
    this.switcher = h("div", { class: "segments", role: "group", "aria-label": "View" },
      h("button", { type: "button", "aria-pressed": "true", onclick: () => void this.show(false), title: "Plan view (v)" }, "Plan"),
      h("button", { type: "button", "aria-pressed": "false", onclick: () => void this.show(true), title: "View in space (v)" }, "3D"));
    this.bar.append(this.switcher, this.legend.element);
    this.barWatcher = new ResizeObserver(() => { this.makeRoom(); });
    this.barWatcher.observe(this.bar);
    this.menu = new MenuButton("save", "Export", acts.exports);
    this.stage.append(this.plan.element, this.bar, h("div", { class: "stage-tools" }, this.legend.button, this.rulerButton, this.followButton, this.menu.element));
    this.element = h("section", { class: "panel stage-panel", "aria-label": "The run" }, this.stage);
  }

  close(): void {
    this.menu.close();
    this.legend.close();
    this.barWatcher.disconnect();
    this.plan.close();
    this.space?.close();
  }

  expect(scene: SceneAnswer): void {
    this.plan.expect(scene);
    this.acts.redraw();
  }

  renew(run: Run): void {
    this.run = run;
    this.choice.planning = isPlanning(run);
    this.plan.renew(run);
    this.space?.renew(run);
  }

  private get view(): PlanView | SpaceView { return this.inSpace && this.space ? this.space : this.plan; }

  /** Keeps room for the bar, which lies over the view; an open list of layers lies over it for a while only. */
  private makeRoom(): void {
    if (this.legend.isOpen) return;
    const room = Math.max(50, this.bar.offsetHeight + 20);
    this.plan.camera.headroom(room);
    this.space?.headroom(room);
  }

  get canvas(): HTMLCanvasElement { return this.view.canvas; }

  draw(now: Now): void {
    if (!this.inSpace) this.plan.draw(now);
    else this.space?.draw(now);
    this.legend.show(this.run, this.view.names);
  }

  svg(now: Now): string { return this.plan.svg(now); }

  async show(space: boolean): Promise<void> {
    this.inSpace = space;
    const [plan, three] = this.switcher.children;
    plan?.setAttribute("aria-pressed", String(!space));
    three?.setAttribute("aria-pressed", String(space));
    keepInAddress({ view: space ? "3d" : "" });
    if (space && !this.space && !await this.openSpace()) return this.show(false);
    this.plan.element.hidden = this.inSpace;
    this.rulerButton.disabled = this.inSpace;
    this.rulerButton.title = this.inSpace ? "Lengths are measured in the plan view" : measuring;
    if (this.space) this.space.element.hidden = !this.inSpace;
    this.acts.redraw();
  }

  /** Returns false, and says so, where the browser cannot draw it. */
  private async openSpace(): Promise<boolean> {
    const { SpaceView: View } = await import("./space_view");
    try {
      this.space ??= new View(this.run, this.acts.redraw, this.choice, (x, y, now) => this.plan.clickPlane(x, y, now));
    } catch {
      this.stage.querySelector(".stage-note")?.remove();
      this.stage.append(h("p", { class: "stage-note", role: "alert" }, "The view in space needs WebGL 2, which this browser does not give; the plan shows the same."));
      return false;
    }
    this.space.follow = this.following;
    this.stage.prepend(this.space.element);
    this.makeRoom();
    return true;
  }

  setFollow(on: boolean): void {
    this.following = on;
    this.followButton.setAttribute("aria-pressed", String(on));
    this.plan.follow = on;
    if (this.space) this.space.follow = on;
    keepInAddress({ follow: on ? "1" : "" });
    this.acts.redraw();
  }

  measure(): void {
    if (this.inSpace) {
      announce("Lengths are measured in the plan view.");
      return;
    }
    this.plan.ruler.toggle();
    this.plan.camera.moved();
    this.rulerButton.setAttribute("aria-pressed", String(this.plan.ruler.on));
    this.acts.redraw();
  }

  showLayers(): void { this.legend.open(); }

  zoom(closer: boolean): void {
    if (this.inSpace) this.space?.zoom(closer ? 1 / 1.3 : 1.3);
    else this.plan.camera.zoom(closer ? 1.5 : 1 / 1.5);
  }

  reset(): void {
    this.setFollow(false);
    this.view.reset();
  }
}
