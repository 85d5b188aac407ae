// The plan view: the world from above, drawn by layers on one canvas.
import type { SceneAnswer } from "../api";
import { Camera, type Box, type Point } from "../base/camera";
import { h, iconButton } from "../base/dom";
import type { Ink } from "../base/ink";
import { clamp, roundStep } from "../base/numbers";
import { SvgInk } from "../base/svg_ink";
import { theme, onTheme } from "../base/theme";
import { onUnits } from "../base/units";
import type { Flight } from "../log/flights";
import type { Run } from "../log/run";
import type { TargetStory } from "../log/targets";
import { areaOf } from "./area";
import type { Found, Layer, Now, Pen, Told } from "./layer";
import { LayerChoice } from "./layer_choice";
import { layersOf, type Named } from "./plan_layers";
import { Ruler } from "./ruler";
import { StillPicture } from "./still_picture";

const bareMargin = { left: 10, right: 10, top: 10, bottom: 10 };

export interface Choices {
  redraw: () => void;
  selectShot: (shot: Flight) => void;
  selectTarget: (target: TargetStory) => void;
  /** Something was clicked whose message can be shown. */
  tell?: (told: Told) => void;
}

export class PlanView {
  readonly element: HTMLElement;
  readonly canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "Plan view" });
  readonly camera: Camera;
  readonly ruler = new Ruler();
  follow = false;
  private tip = h("div", { class: "tip", hidden: true });
  private still: StillPicture;
  private layers: Named[] = [];
  private veil = document.createElement("canvas");
  private drawn: Run | null = null;
  private now: Now = { t: 0, shot: null, target: null, speed: 0 };
  private area: Box;
  private over: Layer | null = null;
  private scene: SceneAnswer | null = null;
  private off: () => void;

  /** `bare`: a picture without scales and buttons, whose view does not move. */
  constructor(private run: Run, private choices: Choices, private bare = false, private choice = new LayerChoice()) {
    this.area = areaOf(run);
    this.element = h("div", { class: "view plan-view" }, this.canvas, this.tip,
      !bare && h("div", { class: "camera", role: "group", "aria-label": "View" },
        iconButton("in", "Zoom in", () => this.camera.zoom(1.5), "+"),
        iconButton("out", "Zoom out", () => this.camera.zoom(1 / 1.5), "-"),
        iconButton("fit", "Show everything", () => this.reset(), "0")));
    this.camera = new Camera(this.canvas, this.area, {
      redraw: () => choices.redraw(),
      click: (at) => this.click(at),
      hover: (at) => this.hover(at),
      grab: (at) => this.grab(at),
      takes: () => this.ruler.on,
      drag: (at) => this.measure(at),
    }, bare ? bareMargin : undefined);
    this.still = new StillPicture(this.camera, (ctx, seen) => this.paintStill(ctx, seen));
    if (bare) this.canvas.removeAttribute("tabindex");
    const off = [onTheme, onUnits].map((on) => on(() => { this.still.forget(); choices.redraw(); }));
    this.off = () => off.forEach((one) => one());
  }

  close(): void {
    this.off();
    this.camera.close();
  }

  /** Until the log tells them, the start and the targets are drawn as the scenario has them. */
  expect(scene: SceneAnswer): void {
    this.scene = scene;
    this.drawn = null;
  }

  /** Draws another layer over all, or none. */
  lay(over: Layer | null): void {
    this.over = over;
    this.drawn = null;
  }

  /** Shows another run, or more of the same one, from its next frame on; a view that somebody moved stays. */
  renew(run: Run): void { this.run = run; }

  private bringUpToDate(): void {
    this.drawn = this.run;
    const area = areaOf(this.run);
    this.layers = [...layersOf(this.run, area, this.bare, this.scene), ...(this.over ? [{ name: "", layer: this.over }] : [])];
    this.still.forget();
    if (area.every((value, i) => value === this.area[i])) return;
    this.area = this.camera.box = area;
    if (this.camera.home) this.reset();
  }

  reset(): void {
    this.follow = false;
    this.camera.reset();
  }

  draw(now: Now): void {
    this.now = now;
    if (this.run !== this.drawn) this.bringUpToDate();
    const { camera } = this;
    if (this.follow && camera.width > 40) {  // the view has its size
      if (camera.home) camera.zoom(2);
      const at = this.run.track.at(now.t);
      camera.centre(at.x, at.y);
    }
    const { ctx } = camera;
    this.still.put(ctx);
    this.drawLayers("moving", { ctx, camera, now });
    this.ruler.draw(ctx, camera);
  }

  private paintStill(ctx: Ink, camera: Camera): void {
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.fillStyle = theme.panel;
    ctx.fillRect(0, 0, ctx.canvas.width, ctx.canvas.height);
    camera.toPlane(ctx);
    const [x0, y0, x1, y1] = this.area;
    ctx.fillStyle = theme.yard;
    ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
    drawGrid(ctx, camera, this.area);
    this.drawLayers("still", { ctx, camera, now: this.now });
  }

  /** Returns the view as SVG. */
  svg(now: Now): string {
    const ctx = new SvgInk(this.canvas);
    this.paintStill(ctx, this.camera);
    this.drawLayers("moving", { ctx, camera: this.camera, now });
    return ctx.text(this.camera.width);
  }

  /** Names of the layers that can be switched. */
  get names(): string[] { return this.layers.flatMap(({ name }) => name || []); }

  /** Layers are to be drawn as strongly as is chosen now. */
  choiceChanged(): void {
    this.still.forget();
    this.choices.redraw();
  }

  private drawLayers(part: "still" | "moving", pen: Pen): void {
    for (const { name, layer } of this.layers) {
      const opacity = this.choice.of(name);
      if (!layer[part] || opacity === 0) continue;
      const faint = opacity < 1 && pen.ctx instanceof CanvasRenderingContext2D ? this.cleanVeil(pen.ctx.canvas) : null;
      const to = { ...pen, ctx: faint ?? pen.ctx };
      to.ctx.save();
      pen.camera.toPlane(to.ctx);
      layer[part](to);
      to.ctx.restore();
      if (faint) this.blend(faint.canvas, pen.ctx, opacity);
    }
  }

  /** A sheet of the size of a picture, on which a faint layer is drawn before it is laid over the others. */
  private cleanVeil({ width, height }: { width: number; height: number }): CanvasRenderingContext2D {
    [this.veil.width, this.veil.height] = [width, height];
    return this.veil.getContext("2d")!;
  }

  private blend(picture: HTMLCanvasElement, ctx: Ink, opacity: number): void {
    ctx.save();
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.globalAlpha = opacity;
    ctx.drawImage(picture, 0, 0);
    ctx.restore();
  }

  private find(at: Point): Found {
    const pen = { ctx: this.camera.ctx, camera: this.camera, now: this.now };
    const all = [...this.layers].reverse().flatMap(({ name, layer }) => (this.choice.of(name) > 0 ? layer.find?.(at, pen) ?? [] : []));
    return all.reduce((sum, one) => ({ ...one, ...sum, lines: [...sum.lines, ...one.lines] }), { lines: [] as string[] });
  }

  private click(at: Point): void {
    this.chooseAt(at);
  }

  /** Selects what is at a place of the plane, as a click on the plan would; it may never have been drawn. */
  clickPlane(x: number, y: number, now: Now): void {
    this.now = now;
    if (this.run !== this.drawn) this.bringUpToDate();
    this.chooseAt(this.camera.screen(x, y));
  }

  private chooseAt(at: Point): void {
    const { target, shot, told } = this.find(at);
    if (told) this.choices.tell?.(told);
    if (target) this.choices.selectTarget(target);
    else if (shot) this.choices.selectShot(shot);
  }

  private grab(at: Point): boolean {
    if (!this.ruler.on) return false;
    const { x, y } = this.camera.plane(at);
    this.ruler.begin([x, y]);
    this.choices.redraw();
    return true;
  }

  private measure(at: Point): void {
    const { x, y } = this.camera.plane(at);
    this.ruler.drag([x, y]);
    this.element.dataset.measured = this.ruler.text;
    this.choices.redraw();
  }

  private hover(at: Point | null): void {
    this.tip.hidden = true;
    if (!at) return;
    const found = this.find(at);
    this.canvas.style.cursor = found.target || found.shot || found.told ? "pointer" : "crosshair";
    if (found.lines.length > 0) placeTip(this.tip, found.lines.slice(0, 5), at, this.camera);
  }
}

export function drawGrid(ctx: Ink, camera: Camera, [x0, y0, x1, y1]: Box): void {
  const step = roundStep(18 / camera.scale);
  ctx.lineWidth = camera.px(1);
  ctx.strokeStyle = theme.grid;
  ctx.beginPath();
  for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) { ctx.moveTo(x, y0); ctx.lineTo(x, y1); }
  for (let y = Math.ceil(y0 / step) * step; y <= y1; y += step) { ctx.moveTo(x0, y); ctx.lineTo(x1, y); }
  ctx.stroke();
}

/** Shows lines beside a place of a canvas, inside of it. */
export function placeTip(tip: HTMLElement, lines: string[], at: Point, camera: Camera): void {
  tip.textContent = lines.join("\n");
  tip.hidden = false;
  const room = camera.width - tip.offsetWidth - 8;
  tip.style.left = `${clamp(at.x + 14, 4, Math.max(4, room))}px`;
  const above = at.y + 18 + tip.offsetHeight > camera.height;
  tip.style.top = `${above ? at.y - 10 - tip.offsetHeight : at.y + 18}px`;
}
