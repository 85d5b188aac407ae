// A measuring tool: how far it is between two places of the plane, along each axis too, and in which direction.
import type { Camera } from "../base/camera";
import { degrees } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import { theme } from "../base/theme";
import { lengthText } from "../base/units";
import { disk } from "./layer";

export class Ruler {
  on = false;
  private ends: [Vec2, Vec2] | null = null;

  toggle(on = !this.on): void {
    this.on = on;
    if (!on) this.ends = null;
  }

  begin(at: Vec2): void { this.ends = [at, at]; }
  drag(at: Vec2): void { if (this.ends) this.ends = [this.ends[0], at]; }

  /** The measurement in words; empty if nothing is measured. */
  get text(): string {
    if (!this.ends) return "";
    const [[ax, ay], [bx, by]] = this.ends;
    const [dx, dy] = [bx - ax, by - ay];
    return `${lengthText(Math.hypot(dx, dy))}, \u0394x ${lengthText(dx)}, \u0394y ${lengthText(dy)}, ${degrees(Math.atan2(dy, dx))}`;
  }

  draw(ctx: CanvasRenderingContext2D, camera: Camera): void {
    if (!this.ends) return;
    const [a, b] = this.ends.map(([x, y]) => camera.screen(x, y)) as [{ x: number; y: number }, { x: number; y: number }];
    ctx.save();
    camera.toScreen(ctx);
    for (const [width, colour] of [[4.5, theme.yard], [2, theme.ink]] as const) {
      ctx.lineWidth = width;
      ctx.strokeStyle = ctx.fillStyle = colour;
      ctx.beginPath();
      ctx.moveTo(a.x, a.y);
      ctx.lineTo(b.x, b.y);
      ctx.stroke();
      for (const end of [a, b]) {
        disk(ctx, end.x, end.y, width + 1);
        ctx.fill();
      }
    }
    ctx.font = `600 12px ${theme.sans}`;
    ctx.textBaseline = "middle";
    const width = ctx.measureText(this.text).width;
    const x = Math.min(Math.max(10, (a.x + b.x - width) / 2), camera.width - width - 10);
    const y = Math.max(16, Math.min(a.y, b.y) - 18);
    ctx.fillStyle = theme.ink;
    ctx.beginPath();
    ctx.roundRect(x - 6, y - 10, width + 12, 20, 5);
    ctx.fill();
    ctx.fillStyle = theme.yard;
    ctx.fillText(this.text, x, y + 0.5);
    ctx.restore();
  }
}
