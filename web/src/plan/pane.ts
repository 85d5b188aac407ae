// One planner's answer on the ground: its search, its path, start and goal.
import { Camera, type Box, type Point } from "../base/camera";
import { h, iconButton } from "../base/dom";
import { fixed } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import { onTheme, theme } from "../base/theme";
import type { Piece } from "../api";
import { onUnits } from "../base/units";
import { disk } from "../watch/layer";
import { placeTip } from "../watch/plan_view";
import { drawScales } from "../watch/scale_layer";
import { cellsOf, type Ground } from "./ground";
import { drawHandle } from "./handle";
import { paintBlocked, paintCells, paintTrace, Picture } from "./painter";
import { drawPlaces } from "./places";
import type { Shown } from "./shown";
import { titleOf } from "./titles";
import { Trace } from "./trace";

/** Holds what all panes show; Hand holds the actions of the pointer on any of them. */
export interface Scene {
  ground: Ground;
  start: Vec2;
  goal: Vec2 | null;
  radius_m: number;
  selected: "start" | "goal" | null;
  /** The heading of the robot at the start; null if it does not matter. */
  heading_rad: number | null;
  /** True if the planner ignores the heading, though it could use it. */
  idleHeading?: boolean;
  /** Draws over the ground, in metres. */
  layer?: (ctx: CanvasRenderingContext2D, camera: Camera) => void;
}
export interface Hand {
  redraw: () => void;
  grab: (at: Vec2, reach: number) => boolean;
  drag: (at: Vec2) => void;
  drop: () => void;
}

export class Pane {
  readonly element: HTMLElement;
  readonly canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "Map with the plan" });
  readonly camera: Camera;
  answer: Shown | null = null;
  trace: Trace | null = null;
  private tip = h("div", { class: "tip", hidden: true });
  private name = h("p", { class: "pane-name" });
  private cells = new Picture();
  private seen = new Picture();
  private rim = new Picture();
  private blocked: Uint8Array | null = null;
  private hovered: number | null = null;
  private answers = 0;
  private off: () => void;

  constructor(private scene: Scene, private hand: Hand, readonly step: () => number) {
    const box = scene.ground.box;
    this.element = h("div", { class: "pane" }, h("div", { class: "view" }, this.canvas, this.tip, this.name,
      h("div", { class: "camera", role: "group", "aria-label": "View" },
        iconButton("in", "Zoom in", () => this.camera.zoom(1.5), "+"), iconButton("out", "Zoom out", () => this.camera.zoom(1 / 1.5), "-"),
        iconButton("fit", "Show everything", () => this.camera.reset(), "0"))));
    const place = (at: Point): Vec2 => { const { x, y } = this.camera.plane(at); return [x, y]; };
    this.camera = new Camera(this.canvas, box, {
      redraw: () => hand.redraw(),
      hover: (at) => this.hover(at),
      grab: (at, event) => event.button === 0 && hand.grab(place(at), this.camera.px(14)),
      drag: (at) => hand.drag(place(at)),
      drop: () => hand.drop(),
    });
    const off = [onTheme(() => hand.redraw()), onUnits(() => hand.redraw())];
    this.off = () => off.forEach((one) => one());
  }

  close(): void {
    this.off();
    this.camera.close();
  }

  take(answer: Shown): void {
    this.answer = answer;
    this.answers += 1;
    this.trace = answer.trace && answer.trace.rows.length > 0 ? new Trace(answer.trace) : null;
    this.blocked = answer.blocked ? cellsOf(answer.blocked) : null;
    this.hovered = null;
    this.hand.redraw();
  }

  draw(): void {
    const { camera, scene } = this;
    const { ctx } = camera;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.fillStyle = theme.panel;
    ctx.fillRect(0, 0, this.canvas.width, this.canvas.height);
    camera.toPlane(ctx);
    this.drawGround(ctx);
    scene.layer?.(ctx, camera);
    this.drawLegs(ctx);
    this.drawTrace(ctx);
    this.drawPath(ctx);
    this.drawChain(ctx);
    if (scene.heading_rad !== null) drawHandle(ctx, camera, scene.start, scene.heading_rad, theme.robot, scene.idleHeading);
    this.drawEnd(ctx, scene.start, "S", theme.robot, scene.selected === "start");
    if (scene.goal) this.drawEnd(ctx, scene.goal, "G", theme.reached, scene.selected === "goal");
    drawScales(ctx, camera, scene.ground.box);
    this.name.textContent = this.answer ? titleOf(this.answer.planner) : "";
  }

  private lay(ctx: CanvasRenderingContext2D, canvas: HTMLCanvasElement, [x0, y0, x1, y1]: Box): void {
    ctx.save();
    ctx.imageSmoothingEnabled = false;
    ctx.translate(x0, y1);
    ctx.scale(1, -1);
    ctx.drawImage(canvas, 0, 0, x1 - x0, y1 - y0);
    ctx.restore();
  }

  private drawGround(ctx: CanvasRenderingContext2D): void {
    const { ground } = this.scene;
    const { camera } = this;
    const trace = (polygon: Vec2[]): void => {
      ctx.beginPath();
      for (const [x, y] of polygon) ctx.lineTo(x, y);
      ctx.closePath();
    };
    if (ground.kind === "grid") {
      paintCells(this.cells, ground);
      this.lay(ctx, this.cells.canvas, ground.box);
      if (this.blocked) {
        paintBlocked(this.rim, this.blocked, ground, String(this.answers));
        this.lay(ctx, this.rim.canvas, ground.box);
      }
      const [x0, y0, x1, y1] = ground.box;
      ctx.strokeStyle = theme.soft;
      ctx.lineWidth = camera.px(1);
      ctx.strokeRect(x0, y0, x1 - x0, y1 - y0);
    } else {
      ctx.fillStyle = theme.yard;
      const [x0, y0, x1, y1] = ground.box;
      if (ground.polygons.boundary.length > 2) trace(ground.polygons.boundary);
      else { ctx.beginPath(); ctx.rect(x0, y0, x1 - x0, y1 - y0); }
      ctx.fill();
      ctx.strokeStyle = theme.soft;
      ctx.lineWidth = camera.px(1.5);
      ctx.stroke();
      for (const polygon of ground.obstacles) {
        if (!polygon) continue;
        trace(polygon);
        ctx.fillStyle = theme["solid-high"];
        ctx.fill();
      }
    }
  }

  private drawTrace(ctx: CanvasRenderingContext2D): void {
    const { trace } = this;
    if (!trace) return;
    if (trace.answer.model === "places") {
      drawPlaces(ctx, this.camera, trace, this.step());
      return;
    }
    paintTrace(this.seen, trace, this.step(), String(this.answers));
    const { origin: [x, y], resolution_m: r } = trace.answer.frame;
    const { width, height } = trace.grid!;
    const half = trace.answer.model === "corners" ? r / 2 : 0;
    this.lay(ctx, this.seen.canvas, [x - half, y - half, x - half + width * r, y - half + height * r]);
  }

  /** Draws the edges of a visibility graph. */
  private drawLegs(ctx: CanvasRenderingContext2D): void {
    if (!this.answer?.legs) return;
    ctx.strokeStyle = theme.open;
    ctx.globalAlpha = this.trace ? 0.13 : 0.25;  // fainter below a search
    ctx.lineWidth = this.camera.px(0.8);
    ctx.beginPath();
    for (const [x0, y0, x1, y1] of this.answer.legs) { ctx.moveTo(x0, y0); ctx.lineTo(x1, y1); }
    ctx.stroke();
    ctx.globalAlpha = 1;
  }

  private drawPath(ctx: CanvasRenderingContext2D): void {
    const { camera, answer } = this;
    const points = answer?.waypoints ?? [];
    if (points.length < 2 || (this.trace && this.step() < this.trace.length)) return;
    const path = pathOf(points, answer?.pieces ?? []);
    ctx.lineJoin = ctx.lineCap = "round";
    if (this.scene.radius_m > 0) {
      ctx.strokeStyle = theme.robot;
      ctx.globalAlpha = 0.22;
      ctx.lineWidth = 2 * this.scene.radius_m;
      ctx.stroke(path);
      ctx.globalAlpha = 1;
    }
    ctx.strokeStyle = theme.yard;
    ctx.lineWidth = camera.px(5.5);
    ctx.stroke(path);
    ctx.strokeStyle = theme.robot;
    ctx.lineWidth = camera.px(3);
    ctx.stroke(path);
  }

  /** Draws the chain of parents from the vertex under the pointer, or the one just expanded, back to the start. */
  private drawChain(ctx: CanvasRenderingContext2D): void {
    const { trace, camera } = this;
    if (!trace) return;
    const step = this.step();
    const index = this.hovered ?? (step < trace.length ? step - 1 : -1);
    if (index < 0) return;
    ctx.strokeStyle = theme.belief;
    ctx.lineWidth = camera.px(2);
    ctx.lineJoin = "round";
    ctx.beginPath();
    for (const place of trace.chain(index)) ctx.lineTo(...place);
    ctx.stroke();
    disk(ctx, ...trace.place(trace.at(index).key), camera.px(4));
    ctx.fillStyle = theme.belief;
    ctx.fill();
  }

  private drawEnd(ctx: CanvasRenderingContext2D, [x, y]: Vec2, letter: string, colour: string, selected: boolean): void {
    const { camera } = this;
    const wrong = this.answer !== null && faultAt(this.answer) === letter;
    ctx.save();
    camera.toScreen(ctx);
    const at = camera.screen(x, y);
    disk(ctx, at.x, at.y, 10);
    ctx.fillStyle = wrong ? theme.failed : colour;
    ctx.fill();
    ctx.strokeStyle = selected ? theme.ink : theme.yard;
    ctx.lineWidth = selected ? 3 : 2;
    ctx.stroke();
    ctx.fillStyle = theme["on-mark"];
    ctx.font = `700 11px ${theme.sans}`;
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.fillText(wrong ? "\u00d7" : letter, at.x, at.y + 0.5);
    ctx.restore();
    camera.toPlane(ctx);
  }

  private hover(at: Point | null): void {
    const before = this.hovered;
    this.hovered = null;
    this.tip.hidden = true;
    if (at && this.trace) {
      const { x, y } = this.camera.plane(at);
      const key = this.trace.nearest(x, y, this.camera.px(12));
      const found = this.trace.find(key, this.step());
      if (found) {
        this.hovered = found.index;
        placeTip(this.tip, vertexLines(this.trace, found.index, found.state), at, this.camera);
      } else if (this.trace.findWaiting(key, this.step())) {
        placeTip(this.tip, waitingLines(this.trace, key), at, this.camera);
      }
    }
    if (before !== this.hovered) this.hand.redraw();
  }
}

/** Returns the end that the answer rejects: it is blocked or outside the map. */
export function faultAt({ status, reason }: Shown): "S" | "G" | null {
  if (status === "done") return null;
  const end = status.match(/^(start|goal)/)?.[1] ?? reason.match(/^the (start|goal)/)?.[1];
  return end === "start" ? "S" : end === "goal" ? "G" : null;
}

/** Returns lines and arcs if the answer has pieces, else lines between the waypoints. */
function pathOf(points: Vec2[], pieces: Piece[]): Path2D {
  const path = new Path2D();
  if (pieces.length === 0) for (const [x, y] of points) path.lineTo(x, y);
  for (const { from, to, centre, turn_rad } of pieces) {
    path.lineTo(...from);
    if (centre && turn_rad) {
      const angle = Math.atan2(from[1] - centre[1], from[0] - centre[0]);
      path.arc(...centre, Math.hypot(from[0] - centre[0], from[1] - centre[1]), angle, angle + turn_rad, turn_rad < 0);
    }
    path.lineTo(...to);
  }
  return path;
}

/** Describes a vertex that the search queued but never expanded. */
export function waitingLines(trace: Trace, key: number): string[] {
  const opened = trace.findWaiting(key, trace.length)?.opened ?? 0;
  return [`${trace.name(key)} in the queue to the end`, `since expansion ${opened}`];
}

/** Describes what the search knew about a vertex. */
export function vertexLines(trace: Trace, index: number, state: "closed" | "open"): string[] {
  const { key, parent, g, h: rest, f } = trace.at(index);
  const when = state === "closed" ? `expanded as number ${index + 1}` : `in the queue, expanded as number ${index + 1}`;
  return [`${trace.name(key)} ${when}`, `g ${fixed(g, 3)}  h ${fixed(rest, 3)}  f ${fixed(f, 3)}`,
    parent !== null ? `parent ${trace.name(parent)}` : "the start"];
}
