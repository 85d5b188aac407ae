// The zones of a drive: those that the robot keeps out of, and those in which it is slow.
import type { Path } from "../base/ink";
import { theme, type Colour } from "../base/theme";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { outlinesOf } from "../log/world";
import { pathOf } from "./cover_layer";
import type { Layer } from "./layer";

export function zones(run: Run): Layer | null {
  const kinds: [string, Colour][] = [[topic.keepOutZones, "failed"], [topic.slowZones, "waiting"]];
  const shown = kinds.flatMap(([name, colour]): [Path, Colour][] => {
    const outlines = outlinesOf(run, name);
    return outlines ? [[pathOf(outlines), colour]] : [];
  });
  if (shown.length === 0) return null;
  return {
    still({ ctx, camera }) {
      for (const [path, colour] of shown) {
        ctx.fillStyle = ctx.strokeStyle = theme[colour];
        ctx.globalAlpha = 0.16;
        ctx.fill(path);
        ctx.globalAlpha = 1;
        ctx.lineWidth = camera.px(1.2);
        ctx.stroke(path);
      }
    },
  };
}
