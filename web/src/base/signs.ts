// Signs for the states of a target: the shape conveys the same as the colour.
import { svg } from "./dom";
import { Path, type Ink } from "./ink";
import { theme } from "./theme";

interface Sign { outline: string; stroke: string; hollow?: boolean }

/** Each sign has radius 1, y down: an outline to fill and a stroke inside it. */
const signs: Record<string, Sign> = {
  waiting: { outline: "M-.8 0a.8 .8 0 1 0 1.6 0a.8 .8 0 1 0-1.6 0z", stroke: "", hollow: true },
  reached: { outline: "M-1 0a1 1 0 1 0 2 0a1 1 0 1 0-2 0z", stroke: "M-.45 .02L-.1 .38L.48-.36" },
  failed: { outline: "M0-1.28L1.28 0L0 1.28L-1.28 0z", stroke: "M-.38-.38L.38 .38M-.38 .38L.38-.38" },
  unreachable: { outline: "M-.95-.95H.95V.95H-.95z", stroke: "M-.5 0H.5" },
};
export type Status = "waiting" | "reached" | "failed" | "unreachable";
export const statuses: Status[] = ["waiting", "reached", "failed", "unreachable"];

export const known = (status: string): Status => (Object.hasOwn(signs, status) ? status as Status : "waiting");
export const statusColour = (status: string): string => theme[known(status)];

export function drawSign(ctx: Ink, status: string, x: number, y: number, radius: number): void {
  const sign = signs[known(status)]!;
  ctx.save();
  ctx.translate(x, y);
  ctx.scale(radius, radius);
  ctx.lineCap = ctx.lineJoin = "round";
  const outline = new Path(sign.outline);
  ctx.strokeStyle = theme.yard;
  ctx.lineWidth = sign.hollow ? 0.9 : 0.5;
  ctx.stroke(outline);
  ctx.fillStyle = sign.hollow ? theme.yard : statusColour(status);
  ctx.fill(outline);
  ctx.strokeStyle = sign.hollow ? statusColour(status) : theme["on-mark"];
  ctx.lineWidth = 0.32;
  ctx.stroke(sign.hollow ? outline : new Path(sign.stroke));
  ctx.restore();
}

export function signElement(status: string): SVGElement {
  const sign = signs[known(status)]!;
  const outline = svg("path", { d: sign.outline, style: sign.hollow ? "fill:none;stroke:var(--waiting)" : `fill:var(--${known(status)});stroke:none` });
  const stroke = svg("path", { d: sign.stroke, style: "fill:none;stroke:var(--on-mark)" });
  return svg("svg", { class: "mark", viewBox: "-1.3 -1.3 2.6 2.6", "aria-hidden": "true" }, outline, stroke);
}
