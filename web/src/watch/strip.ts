// A way painted onto a canvas leg by leg as time goes on: the strip that it covers, or a thin line in the colours of what its
// legs are for. What the canvas shows depends on the time and the view alone, not on what was shown before.
import type { Ink } from "../base/ink";
import { clamp } from "../base/numbers";
import type { Vec2 } from "../base/outline";
import type { Way } from "../log/way";

/** Sets the colour, the width and the dashes; a pixel is so many metres. */
export type LinePen = (ctx: Ink, px: number) => void;

/** The part of the plane that a canvas shows. */
export interface View {
  size: Vec2;
  /** Another one for another part or another scale. */
  name: string;
  px: number;
  toPlane: (ctx: CanvasRenderingContext2D) => void;
}

export interface Painter {
  /** Paints what is covered until t onto a canvas of its own. */
  paint: (t: number, view: View, colours: string) => HTMLCanvasElement;
  /** Draws the same where there is no canvas to paint onto. */
  draw: (ctx: Ink, px: number, t: number) => void;
}

const mostKept = 5;

export class Strip implements Painter {
  /** Clear where no leg is. */
  readonly canvas = document.createElement("canvas");
  private legs = document.createElement("canvas");
  private painted = 0;
  private view = "";
  /** Pictures after so many legs each, from which going back begins. */
  private kept: HTMLCanvasElement[] = [];
  private apart: number;

  /** Legs go from a corner of the way to the next; each is drawn with one of the pens. */
  constructor(private way: Way, private pens: LinePen[], private penOf: (leg: number) => number = () => 0) {
    this.apart = Math.max(1, Math.ceil(way.corners.length / (mostKept + 1)));
  }

  /** Paints the way until t: the legs that are missing, and the part of one that is under way. */
  paint(t: number, { size: [width, height], name, px, toPlane }: View, colours: string): HTMLCanvasElement {
    const wanted = Math.max(0, this.way.reached(t) - 1);
    const view = `${name} ${colours} ${width} ${height}`;
    if (view !== this.view) {
      for (const canvas of [this.canvas, this.legs]) [canvas.width, canvas.height] = [width, height];
      this.view = view;
      this.painted = 0;
      this.kept = [];
    }
    const { corners } = this.way;
    const legs = penOn(this.legs);
    if (wanted < this.painted) this.goBack(legs, wanted);
    toPlane(legs);
    for (; this.painted < wanted; ++this.painted) {
      if (this.painted === (this.kept.length + 1) * this.apart) this.kept.push(copyOf(this.legs));
      this.leg(legs, px, this.painted, corners[this.painted + 1]!);
    }
    const ctx = penOn(this.canvas);
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, width, height);
    ctx.drawImage(this.legs, 0, 0);
    toPlane(ctx);
    if (corners[wanted]) this.leg(ctx, px, wanted, this.way.at(t));
    return this.canvas;
  }

  /** To the last picture kept that shows no more than is wanted. */
  private goBack(legs: CanvasRenderingContext2D, wanted: number): void {
    const kept = Math.min(this.kept.length, Math.floor(wanted / this.apart));
    legs.setTransform(1, 0, 0, 1, 0, 0);
    legs.clearRect(0, 0, this.legs.width, this.legs.height);
    if (kept > 0) legs.drawImage(this.kept[kept - 1]!, 0, 0);
    this.painted = kept * this.apart;
  }

  /** The same as lines, where there is no canvas to paint onto. */
  draw(ctx: Ink, px: number, t: number): void {
    const { corners } = this.way;
    const wanted = Math.max(0, this.way.reached(t) - 1);
    this.pens.forEach((pen, k) => {
      ctx.lineCap = ctx.lineJoin = "round";
      pen(ctx, px);
      ctx.beginPath();
      for (let i = 0; i <= wanted && i < corners.length; ++i) {
        if (this.penOf(i) !== k) continue;
        if (i === 0 || this.penOf(i - 1) !== k) ctx.moveTo(...corners[i]!);
        ctx.lineTo(...(i < wanted ? corners[i + 1]! : this.way.at(t)));
      }
      ctx.stroke();
    });
    ctx.setLineDash([]);
  }

  private leg(ctx: CanvasRenderingContext2D, px: number, i: number, to: Vec2): void {
    const from = this.way.corners[i]!;
    ctx.lineCap = "round";
    this.pens[this.penOf(i)]!(ctx, px);
    ctx.beginPath();
    if (from[0] === to[0] && from[1] === to[1]) {
      ctx.arc(...from, ctx.lineWidth / 2, 0, 2 * Math.PI);
      ctx.fillStyle = ctx.strokeStyle;
      ctx.fill();
      return;
    }
    ctx.moveTo(...from);
    ctx.lineTo(...to);
    ctx.stroke();
  }
}

/** Drawn by the processor, where a leg looks the same whatever was drawn with it. */
const penOn = (canvas: HTMLCanvasElement): CanvasRenderingContext2D => canvas.getContext("2d", { willReadFrequently: true })!;

function copyOf(picture: HTMLCanvasElement): HTMLCanvasElement {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [picture.width, picture.height];
  penOn(copy).drawImage(picture, 0, 0);
  return copy;
}

/** The size of a picture of the box, `most` pixels along its longer side. */
export function pictureSize([x0, y0, x1, y1]: readonly [number, number, number, number], most: number): { size: Vec2; scale: number } {
  const [width, height] = [Math.max(1e-6, x1 - x0), Math.max(1e-6, y1 - y0)];
  const scale = most / Math.max(width, height);
  return { size: [clamp(Math.round(scale * width), 1, most), clamp(Math.round(scale * height), 1, most)], scale };
}
