// Targets: their boxes, the sign of their state, their names where there is room.
import { Path } from "../base/ink";
import { fixed } from "../base/numbers";
import { drawSign, statusColour } from "../base/signs";
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { targetsOf, type TargetStory } from "../log/targets";
import { disk, label, type Layer, type Pen } from "./layer";
import { nameFont, placeNames, shortName } from "./names";

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

export function targets(run: Run): Layer | null {
  const all = targetsOf(run);
  if (all.length === 0) return null;
  const boxes = all.map(boxOf);
  const texts = all.map(({ name }) => shortName(name));
  let names: ReturnType<typeof placeNames> = [];

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
      names = placeNames(ctx, camera, all.map(({ centre }, i) => ({ text: texts[i]!, ...camera.screen(centre[0], centre[1]) })));
    },
    moving(pen) {
      const { ctx, camera, now } = pen;
      all.forEach((target, i) => drawTarget(pen, target, boxes[i]!));
      camera.toScreen(ctx);
      ctx.textAlign = "left";
      ctx.textBaseline = "middle";
      for (const [i, target] of all.entries()) {
        const [name, place] = [names[i], target.placeAt(now.t)];
        if (!name || !place || place[0] !== target.centre[0] || place[1] !== target.centre[1]) continue;
        ctx.font = nameFont(target === now.target ? 650 : 450);
        const sign = camera.screen(...place);
        label(ctx, texts[i]!, sign.x + name.x, sign.y + name.y, theme.ink, theme.yard);
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
