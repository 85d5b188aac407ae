// The plan view: the world from above, drawn by layers on one canvas.
import type { SceneAnswer } from "../api";
import { Camera, type Box, type Point } from "../base/camera";
import { h, iconButton } from "../base/dom";
import type { Ink } from "../base/ink";
import { clamp, roundStep } from "../base/numbers";
import { SvgInk } from "../base/svg_ink";
import { theme, onTheme } from "../base/theme";
import type { Flight } from "../log/flights";
import type { Run } from "../log/run";
import type { TargetStory } from "../log/targets";
import { areaOf } from "./area";
import { believed } from "./belief";
import { pursuit } from "./pursuit_layer";
import { cover } from "./cover_layer";
import { expected } from "./expected_layer";
import { flights } from "./flight_layer";
import { ground } from "./ground_layer";
import type { Found, Layer, LayerOf, Now, Pen } from "./layer";
import { map } from "./map_layer";
import { mapping } from "./mapping_layer";
import { robot } from "./robot_layer";
import { scan } from "./scan_layer";
import { scales } from "./scale_layer";
import { stations } from "./station_layer";
import { tags } from "./tag_layer";
import { targets } from "./target_layer";
import { way } from "./way_layer";

/** Each makes a layer where the log has its messages; the first lies lowest. */
const makers: LayerOf[] = [ground, pursuit, cover, map, mapping, way, scan, flights, tags, stations, targets, robot, believed];

function layersOf(run: Run, area: Box, bare: boolean, scene: SceneAnswer | null): Layer[] {
  const told = makers.map((make) => make(run));
  return [...[...told, scene && expected(run, scene)].filter((one) => one !== null), ...(bare ? [] : [scales(area, run)])];
}

const bareMargin = { left: 10, right: 10, top: 10, bottom: 10 };

export interface Choices {
  redraw: () => void;
  selectShot: (shot: Flight) => void;
  selectTarget: (target: TargetStory) => void;
}

export class PlanView {
  readonly element: HTMLElement;
  readonly canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "Plan view" });
  readonly camera: Camera;
  follow = false;
  private tip = h("div", { class: "tip", hidden: true });
  private still = document.createElement("canvas");
  private stillVersion = "";
  private layers: Layer[] = [];
  private drawn: Run | null = null;
  private now: Now = { t: 0, shot: null, target: null, speed: 0 };
  private area: Box;
  private scene: SceneAnswer | null = null;
  private off: () => void;

  /** `bare`: a picture without scales and buttons, whose view does not move. */
  constructor(private run: Run, private choices: Choices, private bare = false) {
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
    }, bare ? bareMargin : undefined);
    if (bare) this.canvas.removeAttribute("tabindex");
    this.off = onTheme(() => { this.stillVersion = ""; choices.redraw(); });
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

  /** Shows another run, or more of the same one, from its next frame on; a view that somebody moved stays. */
  renew(run: Run): void { this.run = run; }

  private bringUpToDate(): void {
    this.drawn = this.run;
    const area = areaOf(this.run);
    this.layers = layersOf(this.run, area, this.bare, this.scene);
    this.stillVersion = "";
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
    if (this.follow) {
      const at = this.run.track.at(now.t);
      camera.centre(at.x, at.y);
    }
    const version = `${camera.version} ${this.canvas.width} ${this.canvas.height}`;
    if (version !== this.stillVersion) {
      this.drawStill();
      this.stillVersion = version;
    }
    const { ctx } = camera;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, this.canvas.width, this.canvas.height);
    ctx.drawImage(this.still, 0, 0);
    this.drawLayers("moving", { ctx, camera, now });
  }

  private drawStill(): void {
    const { still } = this;
    still.width = this.canvas.width;
    still.height = this.canvas.height;
    this.paintStill(still.getContext("2d")!);
  }

  private paintStill(ctx: Ink): void {
    const { camera } = this;
    ctx.fillStyle = theme.panel;
    ctx.fillRect(0, 0, ctx.canvas.width, ctx.canvas.height);
    camera.toPlane(ctx);
    const [x0, y0, x1, y1] = this.area;
    ctx.fillStyle = theme.yard;
    ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
    drawGrid(ctx, camera, this.area);
    this.drawLayers("still", { ctx, camera, now: this.now });
  }

  /** What it shows, as SVG. */
  svg(now: Now): string {
    const ctx = new SvgInk(this.canvas);
    this.paintStill(ctx);
    this.drawLayers("moving", { ctx, camera: this.camera, now });
    return ctx.text(this.camera.width);
  }

  private drawLayers(part: "still" | "moving", pen: Pen): void {
    for (const layer of this.layers) {
      if (!layer[part]) continue;
      pen.ctx.save();
      pen.camera.toPlane(pen.ctx);
      layer[part](pen);
      pen.ctx.restore();
    }
  }

  private find(at: Point): Found {
    const pen = { ctx: this.camera.ctx, camera: this.camera, now: this.now };
    const all = [...this.layers].reverse().flatMap((layer) => layer.find?.(at, pen) ?? []);
    return all.reduce((sum, one) => ({ ...one, ...sum, lines: [...sum.lines, ...one.lines] }), { lines: [] as string[] });
  }

  private click(at: Point): void {
    const { target, shot } = this.find(at);
    if (target) this.choices.selectTarget(target);
    else if (shot) this.choices.selectShot(shot);
  }

  private hover(at: Point | null): void {
    this.tip.hidden = true;
    if (!at) return;
    const found = this.find(at);
    this.canvas.style.cursor = found.target || found.shot ? "pointer" : "crosshair";
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
