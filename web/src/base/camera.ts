// A view of the plane, y up, on a canvas. It fits a box, zooms about the pointer, and pans by drag or pinch.
import type { Ink } from "./ink";
import { clamp } from "./numbers";

export interface Point { x: number; y: number }
export type Box = [number, number, number, number];

export interface CameraEvents {
  redraw: () => void;
  click?: (at: Point) => void;
  hover?: (at: Point | null) => void;
  /** Called when a drag begins at `at`; returning true takes the drag, so it does not move the view. */
  grab?: (at: Point, event: PointerEvent) => boolean;
  /** Returns true if drags are taken now; they are if this is left out and grab() is not. */
  takes?: () => boolean;
  drag?: (at: Point) => void;
  drop?: () => void;
}

export class Camera {
  readonly ctx: CanvasRenderingContext2D;
  width = 1;
  height = 1;
  dpr = 1;
  scale = 1;
  x = 0;
  y = 0;
  version = 0;
  home = true;
  private least = 1e-3;
  private pointers = new Map<number, Point>();
  private grabbed = false;
  private travel = 0;
  private watcher: ResizeObserver;

  constructor(readonly canvas: HTMLCanvasElement, public box: Box, private events: CameraEvents,
    private margin = { left: 34, right: 54, top: 50, bottom: 40 }) {
    this.ctx = canvas.getContext("2d")!;
    this.resize();
    this.watcher = new ResizeObserver(() => this.resize());
    this.watcher.observe(canvas);
    this.listen();
  }

  close(): void {
    this.watcher.disconnect();
  }

  private resize(): void {
    if (this.canvas.clientWidth === 0 && this.canvas.width > 1) return;  // hidden: it keeps its view until it is shown again
    this.width = Math.max(1, this.canvas.clientWidth);
    this.height = Math.max(1, this.canvas.clientHeight);
    this.dpr = Math.min(3, window.devicePixelRatio || 1);
    const [width, height] = [Math.round(this.width * this.dpr), Math.round(this.height * this.dpr)];
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    if (this.home) this.fit();
    this.moved();
  }

  /** Centres the box and shows it as large as possible. */
  fit(box: Box = this.box): void {
    const { left, right, top, bottom } = this.margin;
    const [x0, y0, x1, y1] = box;
    const across = Math.max(40, this.width - left - right);
    const tall = Math.max(40, this.height - top - bottom);
    this.scale = Math.max(1e-3, Math.min(across / Math.max(1e-6, x1 - x0), tall / Math.max(1e-6, y1 - y0)));
    this.x = left + across / 2 - this.scale * (x0 + x1) / 2;
    this.y = top + tall / 2 + this.scale * (y0 + y1) / 2;
    this.home = box === this.box;
    if (this.home) this.least = this.scale / 2;
  }

  /** Keeps this many pixels free above the box. */
  headroom(pixels: number): void {
    if (this.margin.top === pixels) return;
    this.margin.top = pixels;
    if (!this.home) return;
    this.fit();
    this.moved();
  }

  show(box: Box): void {
    this.box = box;
    this.fit();
    this.moved();
  }

  /** Centres a point of the plane. */
  centre(x: number, y: number): void {
    this.x = Math.round((this.width / 2 - this.scale * x) * this.dpr) / this.dpr;  // whole pixels: what stands still does not tremble
    this.y = Math.round((this.height / 2 + this.scale * y) * this.dpr) / this.dpr;
    this.home = false;
    this.version += 1;
  }

  zoom(factor: number, at: Point = { x: this.width / 2, y: this.height / 2 }): void {
    const scale = clamp(this.scale * factor, this.least, 4000);
    this.x = at.x - (at.x - this.x) * (scale / this.scale);
    this.y = at.y - (at.y - this.y) * (scale / this.scale);
    this.scale = scale;
    this.home = false;
    this.moved();
  }

  reset(): void {
    this.fit();
    this.moved();
  }

  private get takes(): boolean { return this.events.grab !== undefined && (this.events.takes?.() ?? true); }

  /** Call it when what drags do has changed. */
  moved(): void {
    this.version += 1;
    this.canvas.style.touchAction = this.home && !this.takes ? "pan-y" : "none";
    this.events.redraw();
  }

  screen(x: number, y: number): Point { return { x: this.x + this.scale * x, y: this.y - this.scale * y }; }
  plane(p: Point): Point { return { x: (p.x - this.x) / this.scale, y: (this.y - p.y) / this.scale }; }
  /** Converts pixels to metres. */
  px(pixels: number): number { return pixels / this.scale; }

  toPlane(ctx: Ink): void {
    const k = this.dpr * this.scale;
    ctx.setTransform(k, 0, 0, -k, this.dpr * this.x, this.dpr * this.y);
  }
  toScreen(ctx: Ink): void { ctx.setTransform(this.dpr, 0, 0, this.dpr, 0, 0); }

  private position(event: MouseEvent): Point {
    const frame = this.canvas.getBoundingClientRect();
    return { x: event.clientX - frame.left, y: event.clientY - frame.top };
  }

  private middle(): Point & { spread: number } {
    const all = [...this.pointers.values()];
    const [a, b] = all;
    const x = all.reduce((sum, p) => sum + p.x, 0) / all.length;
    const y = all.reduce((sum, p) => sum + p.y, 0) / all.length;
    return { x, y, spread: a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 0 };
  }

  private listen(): void {
    const { canvas, events } = this;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, this.position(event));
      if (this.pointers.size > 1) return;
      this.travel = 0;
      this.grabbed = events.grab?.(this.position(event), event) ?? false;
    });
    canvas.addEventListener("pointermove", (event) => this.pointerMoved(event));
    const release = (event: PointerEvent): void => {
      if (!this.pointers.delete(event.pointerId) || this.pointers.size > 0) return;
      if (this.grabbed) events.drop?.();
      else if (event.type === "pointerup" && this.travel < 4) events.click?.(this.position(event));
      this.grabbed = false;
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("pointerleave", () => events.hover?.(null));
    canvas.addEventListener("dblclick", () => this.reset());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-clamp(event.deltaY, -120, 120) * 0.0022), this.position(event));
    }, { passive: false });
  }

  private pointerMoved(event: PointerEvent): void {
    const at = this.position(event);
    if (!this.pointers.has(event.pointerId)) { this.events.hover?.(at); return; }
    const before = this.middle();
    this.pointers.set(event.pointerId, at);
    if (this.grabbed) { this.events.drag?.(at); return; }
    const after = this.middle();
    this.travel += Math.hypot(after.x - before.x, after.y - before.y);
    if (this.travel < 4 && this.pointers.size < 2) return;
    // One finger scrolls the page as long as the view is not zoomed.
    if (event.pointerType === "touch" && this.home && this.pointers.size < 2 && !this.takes) return;
    this.x += after.x - before.x;
    this.y += after.y - before.y;
    this.home = false;
    if (before.spread > 0 && after.spread > 0) this.zoom(after.spread / before.spread, after);
    this.events.hover?.(null);
    this.moved();
  }
}
