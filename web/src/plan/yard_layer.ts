// Draws the yard over its ground: movable things, their original places, removed things, targets, and the handle.
import type { Camera } from "../base/camera";
import type { Vec2 } from "../base/outline";
import { theme } from "../base/theme";
import { disk, label } from "../watch/layer";
import { placeNames, shortName } from "../watch/names";
import { drawHandle } from "./handle";
import type { Item, Yard } from "./yard";

type Ctx = CanvasRenderingContext2D;

function trace(ctx: Ctx, polygons: readonly Vec2[][]): void {
  ctx.beginPath();
  for (const polygon of polygons) {
    polygon.forEach(([x, y], i) => (i === 0 ? ctx.moveTo(x, y) : ctx.lineTo(x, y)));
    ctx.closePath();
  }
}

function dashed(ctx: Ctx, camera: Camera, polygons: readonly Vec2[][], colour: string): void {
  trace(ctx, polygons);
  ctx.strokeStyle = colour;
  ctx.lineWidth = camera.px(1.3);
  ctx.setLineDash([camera.px(4), camera.px(3)]);
  ctx.stroke();
  ctx.setLineDash([]);
}

function drawObstacle(ctx: Ctx, camera: Camera, yard: Yard, item: Item, selected: boolean): void {
  const outlines = yard.outlines(item);
  if (yard.isMoved(item)) dashed(ctx, camera, yard.things[item.index]!.polygons, theme.soft);
  if (yard.isRemoved(item)) {
    dashed(ctx, camera, outlines, selected ? theme.ink : theme.failed);
    return;
  }
  trace(ctx, outlines);
  ctx.fillStyle = theme["solid-high"];
  ctx.fill();
  if (!selected) return;
  ctx.strokeStyle = theme.ink;
  ctx.lineWidth = camera.px(2.5);
  ctx.stroke();
}

/** Draws the box of a target, and a sign by which to grab it. */
function drawTarget(ctx: Ctx, camera: Camera, yard: Yard, index: number, selected: boolean): void {
  const { position: [x, y], size: [length, width], heading_rad } = yard.targets[index]!;
  ctx.save();
  ctx.translate(x, y);
  ctx.rotate(heading_rad);
  ctx.fillStyle = theme.water;
  ctx.globalAlpha = 0.35;
  ctx.fillRect(-length / 2, -width / 2, length, width);
  ctx.restore();
  ctx.save();
  camera.toScreen(ctx);
  const at = camera.screen(x, y);
  disk(ctx, at.x, at.y, selected ? 8 : 6);
  ctx.fillStyle = theme.water;
  ctx.fill();
  ctx.strokeStyle = selected ? theme.ink : theme.yard;
  ctx.lineWidth = selected ? 3 : 2;
  ctx.stroke();
  ctx.restore();
  camera.toPlane(ctx);
}

/** Names of targets, each where it covers no other and no sign; the selected one has its place first. */
function drawNames(ctx: Ctx, camera: Camera, yard: Yard, selected: number): void {
  ctx.save();
  camera.toScreen(ctx);
  const named = yard.targets.map(({ name, position }) => ({ text: shortName(name), ...camera.screen(position[0], position[1]) }));
  const order = [...named.keys()].sort((a, b) => Number(b === selected) - Number(a === selected));
  const places = placeNames(ctx, camera, order.map((index) => named[index]!));
  ctx.textAlign = "left";
  ctx.textBaseline = "middle";
  order.forEach((index, i) => {
    const [{ text, x, y }, place] = [named[index]!, places[i]];
    if (place) label(ctx, text, x + place.x, y + place.y, theme.ink, theme.panel);
  });
  ctx.restore();
}

/** Returns the distance from the middle of an item to the arm of its handle. */
export const beyond = (yard: Yard, item: Item): number => (item.what === "thing" || item.what === "box" ? yard.radius(item) : 0);

export function drawYard(ctx: Ctx, camera: Camera, yard: Yard, selected: Item | null): void {
  const is = (item: Item): boolean => item.what === selected?.what && item.index === selected.index;
  for (const item of yard.obstacles) if (!is(item)) drawObstacle(ctx, camera, yard, item, false);
  if (selected?.what === "thing" || selected?.what === "box") drawObstacle(ctx, camera, yard, selected, true);
  yard.targets.forEach((_, index) => drawTarget(ctx, camera, yard, index, is({ what: "target", index })));
  drawNames(ctx, camera, yard, selected?.what === "target" ? selected.index : -1);
  if (!selected || selected.what === "robot" || yard.isRemoved(selected)) return;
  const colour = selected.what === "target" ? theme.water : theme.ink;
  drawHandle(ctx, camera, yard.middle(selected), yard.turn(selected), colour, false, beyond(yard, selected));
}
