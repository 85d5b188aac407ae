// Targets: their boxes, the sign of their state, their names where there is room.
import type { Camera } from "../base/camera";
import { Path, type Ink } from "../base/ink";
import { fixed } from "../base/numbers";
import { drawSign, statusColour } from "../base/signs";
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { targetsOf, type TargetStory } from "../log/targets";
import { disk, label, type Layer, type Pen } from "./layer";

/** Where the name stands from the sign of its target, in pixels. */
interface Name { text: string; x: number; y: number; target: TargetStory }

function boxOf({ last: { size, yaw } }: TargetStory): Path {
  const [length, width] = [size.x / 2, size.y / 2];
  const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
  const path = new Path();
  for (const [u, v] of [[-length, -width], [length, -width], [length, width], [-length, width]] as const) {
    path.lineTo(u * cos - v * sin, u * sin + v * cos);
  }
  path.closePath();
  return path;
}

/** Names beside their signs, each where it covers nothing that stands there already. */
function placeNames(ctx: Ink, camera: Camera, targets: TargetStory[]): Name[] {
  ctx.font = `11.5px ${theme.sans}`;
  type Area = [number, number, number, number];
  const signs = targets.map((one) => camera.screen(one.centre[0], one.centre[1]));
  const taken: Area[] = signs.map(({ x, y }) => [x - 8, y - 8, x + 8, y + 8]);
  const free = ([x0, y0, x1, y1]: Area): boolean => x0 > 2 && x1 < camera.width - 2 && y0 > 2 && y1 < camera.height - 2 &&
    taken.every((other) => x0 > other[2] || x1 < other[0] || y0 > other[3] || y1 < other[1]);
  return targets.flatMap((target, i) => {
    const { x, y } = signs[i]!;
    const text = target.name.length > 28 ? target.name.slice(0, 27) + "\u2026" : target.name;
    const width = ctx.measureText(text).width;
    for (const [left, middle] of [[x + 11, y], [x - 11 - width, y], [x - width / 2, y - 16], [x - width / 2, y + 16]] as const) {
      const area: Area = [left - 2, middle - 7, left + width + 2, middle + 7];
      if (!free(area)) continue;
      taken.push(area);
      return [{ text, x: left - x, y: middle - y, target }];
    }
    return [];
  });
}

export function targets(run: Run): Layer | null {
  const all = targetsOf(run);
  if (all.length === 0) return null;
  const boxes = all.map(boxOf);
  let names: Name[] = [];

  function drawTarget({ ctx, camera, now }: Pen, target: TargetStory, box: Path): void {
    const place = target.placeAt(now.t);
    if (!place) return;
    const status = target.statusAt(now.t);
    camera.toPlane(ctx);
    ctx.translate(...place);
    ctx.fillStyle = ctx.strokeStyle = statusColour(status);
    ctx.globalAlpha = 0.35;
    ctx.fill(box);
    ctx.globalAlpha = 1;
    ctx.lineWidth = camera.px(1.2);
    ctx.stroke(box);
    camera.toScreen(ctx);
    const at = camera.screen(...place);
    const belief = target.believedAt(now.t);
    if (belief) {
      const seen = camera.screen(...belief);
      ctx.setLineDash([3, 3]);
      disk(ctx, seen.x, seen.y, 10);
      ctx.stroke();
      ctx.setLineDash([]);
    }
    drawSign(ctx, status, at.x, at.y, 6);
    if (target !== now.target) return;
    ctx.strokeStyle = theme.ink;
    ctx.lineWidth = 1.5;
    disk(ctx, at.x, at.y, 11);
    ctx.stroke();
  }

  return {
    still({ ctx, camera }) {
      camera.toScreen(ctx);
      names = placeNames(ctx, camera, all);
    },
    moving(pen) {
      const { ctx, camera, now } = pen;
      all.forEach((target, i) => drawTarget(pen, target, boxes[i]!));
      camera.toScreen(ctx);
      ctx.textAlign = "left";
      ctx.textBaseline = "middle";
      for (const { text, x, y, target } of names) {
        const place = target.placeAt(now.t);
        if (!place || place[0] !== target.centre[0] || place[1] !== target.centre[1]) continue;
        ctx.font = `${target === now.target ? 650 : 450} 11.5px ${theme.sans}`;
        const sign = camera.screen(...place);
        label(ctx, text, sign.x + x, sign.y + y, theme.ink, theme.yard);
      }
    },
    find(at, { camera, now }) {
      let found: TargetStory | null = null;
      let least = 13;
      for (const target of all) {
        const place = target.placeAt(now.t);
        if (!place) continue;
        const sign = camera.screen(...place);
        const distance = Math.hypot(sign.x - at.x, sign.y - at.y);
        if (distance < least) [least, found] = [distance, target];
      }
      if (!found) return null;
      const { z } = found.last.size;
      const base = found.centre[2] - z / 2;
      const { name } = found;
      return { target: found, told: { topic: topic.targets, name, at: (t) => all.find((one) => one.name === name)?.at(t) }, lines: [`${found.name}: ${found.statusAt(now.t)}`, `base at ${fixed(base, 2)} m, ${fixed(z, 2)} m high`] };
    },
  };
}
