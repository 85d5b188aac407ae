// The strip that a bar has come over, painted row by row of the track as time goes on.
import { Path, type Ink } from "../base/ink";
import { theme } from "../base/theme";
import { sweptBetween, type Bar } from "../log/bar";
import type { Track } from "../log/track";
import type { Painter, View } from "./strip";

export class BarStrip implements Painter {
  private canvas = document.createElement("canvas");
  private rows = document.createElement("canvas");
  private painted = 0;
  private view = "";
  /** Paths of whole rows, once they were painted. */
  private paths: Path[] = [];

  constructor(private track: Track, private bar: Bar) {}

  paint(t: number, { size: [width, height], name, toPlane }: View, colours: string): HTMLCanvasElement {
    const { time } = this.track;
    const view = `${name} ${colours} ${width} ${height}`;
    if (view !== this.view || (time[this.painted] ?? 0) > t) {
      this.view = view;
      this.painted = 0;
      for (const canvas of [this.canvas, this.rows]) [canvas.width, canvas.height] = [width, height];
    }
    const rows = this.rows.getContext("2d")!;
    toPlane(rows);
    for (; this.painted + 1 < time.length && time[this.painted + 1]! <= t; ++this.painted) {
      const i = this.painted;
      this.fill(rows, (this.paths[i] ??= this.swept(time[i]!, time[i + 1]!)));
    }
    const ctx = this.canvas.getContext("2d")!;
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, width, height);
    ctx.drawImage(this.rows, 0, 0);
    toPlane(ctx);
    this.fill(ctx, this.swept(time[this.painted] ?? t, t));
    return this.canvas;
  }

  /** As one path, so that nothing shows twice through itself. */
  draw(ctx: Ink, _px: number, t: number): void {
    const { time } = this.track;
    const all = new Path();
    for (let i = 0; i < time.length && time[i]! <= t; ++i) this.addSwept(all, time[i]!, Math.min(t, time[i + 1] ?? t));
    this.fill(ctx, all);
  }

  private fill(ctx: Ink, path: Path): void {
    ctx.fillStyle = theme.reached;
    ctx.fill(path);
  }

  private swept(from: number, to: number): Path {
    const path = new Path();
    this.addSwept(path, from, to);
    return path;
  }

  private addSwept(path: Path, from: number, to: number): void {
    for (const ring of sweptBetween(this.bar, this.track, from, to)) {
      ring.forEach(([x, y], i) => (i ? path.lineTo(x, y) : path.moveTo(x, y)));
      path.closePath();
    }
  }
}
