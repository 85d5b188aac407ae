// A picture of a film: the view, and above it what the clock says and what is going on.
import { clockText } from "../base/numbers";
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { label } from "./layer";

export class Frame {
  private canvas: HTMLCanvasElement | null = null;

  constructor(private run: Run) {}

  /** All are as large as the first one, of an even width and height, as coders of films want them. */
  of(view: HTMLCanvasElement, t: number): HTMLCanvasElement {
    if (!this.canvas) {
      this.canvas = document.createElement("canvas");
      this.canvas.width = view.width & ~1;
      this.canvas.height = view.height & ~1;
    }
    const ctx = this.canvas.getContext("2d")!;
    const dpr = view.width / Math.max(1, view.clientWidth);
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.drawImage(view, 0, 0);
    ctx.scale(dpr, dpr);
    ctx.textBaseline = "middle";
    ctx.font = `600 14px ${theme.mono}`;
    const clock = clockText(t, 1);
    label(ctx, clock, 14, 22, theme.ink, theme.panel);
    const left = 28 + ctx.measureText(clock).width;
    ctx.font = `14px ${theme.sans}`;
    label(ctx, this.run.eventText(t), left, 22, theme.ink, theme.panel);
    return this.canvas;
  }
}
