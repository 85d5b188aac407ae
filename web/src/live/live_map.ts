// The way of the robot as its samples come in.
import { Camera, type Box } from "../base/camera";
import { h } from "../base/dom";
import { onTheme, theme } from "../base/theme";
import { drawGrid } from "../watch/plan_view";
import { drawScales } from "../watch/scale_layer";
import { disk } from "../watch/layer";

export class LiveMap {
  readonly element: HTMLElement;
  private canvas = h("canvas", { role: "img", "aria-label": "Where the robot is" });
  private camera: Camera;
  private rows: number[][] = [];
  private frame = 0;
  private off: () => void;

  constructor() {
    this.element = h("div", { class: "view" }, this.canvas);
    this.camera = new Camera(this.canvas, [-5, -5, 5, 5], { redraw: () => this.invalidate() });
    this.off = onTheme(() => this.invalidate());
  }

  close(): void {
    this.off();
    this.camera.close();
    cancelAnimationFrame(this.frame);
  }

  /** Rows of time, x, y, heading and more. */
  add(rows: number[][]): void {
    this.rows.push(...rows);
    const box: Box = [-1, -1, 1, 1];
    for (const [, x = 0, y = 0] of this.rows) {
      box[0] = Math.min(box[0], x - 1);
      box[1] = Math.min(box[1], y - 1);
      box[2] = Math.max(box[2], x + 1);
      box[3] = Math.max(box[3], y + 1);
    }
    if (box.some((value, i) => value !== this.camera.box[i])) this.camera.show(box);
    this.invalidate();
  }

  private invalidate(): void {
    if (this.frame === 0) this.frame = requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    this.frame = 0;
    const { camera } = this;
    const { ctx } = camera;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.fillStyle = theme.panel;
    ctx.fillRect(0, 0, this.canvas.width, this.canvas.height);
    camera.toPlane(ctx);
    drawGrid(ctx, camera, camera.box);
    ctx.strokeStyle = theme.robot;
    ctx.lineWidth = camera.px(2.2);
    ctx.lineJoin = ctx.lineCap = "round";
    ctx.beginPath();
    for (const [, x = 0, y = 0] of this.rows) ctx.lineTo(x, y);
    ctx.stroke();
    const last = this.rows.at(-1);
    if (last) {
      disk(ctx, last[1]!, last[2]!, camera.px(7));
      ctx.fillStyle = theme.robot;
      ctx.fill();
    }
    drawScales(ctx, camera, camera.box);
  }
}
