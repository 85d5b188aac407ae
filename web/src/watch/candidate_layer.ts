// The places that the present decision of an exploration compared, in their order; the chosen one is filled.
import { figures, fixed } from "../base/numbers";
import { theme } from "../base/theme";
import { typeset } from "../base/typeset";
import type { Candidate, Decision } from "../log/messages";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { disk, label, type Layer } from "./layer";

/** Returns the facts about a place, as a sentence. */
export const candidateWords = ({ cost, gain, value }: Candidate, valueOf: string): string =>
  typeset(`${fixed(cost, 1)} s to get there, ${figures(gain)} m2 to see${Number.isFinite(value) ? `, ${figures(value)} ${valueOf}` : ", seen from another place"}`);

export function candidates(run: Run): Layer | null {
  const decisions = run.log.messages<Decision>(topic.decisions);
  if (!decisions.some(({ message }) => message.candidates?.length > 0)) return null;
  const at = (t: number): Decision | undefined => run.log.latest<Decision>(topic.decisions, t);
  return {
    moving({ ctx, camera, now }) {
      const decision = at(now.t);
      if (!decision) return;
      camera.toScreen(ctx);
      ctx.textAlign = "center";
      ctx.textBaseline = "middle";
      ctx.font = `600 10.5px ${theme.sans}`;
      [...decision.candidates.entries()].reverse().forEach(([i, { position, chosen }]) => {
        const { x, y } = camera.screen(position.x, position.y);
        disk(ctx, x, y, 8);
        ctx.fillStyle = chosen ? theme.open : theme.yard;
        ctx.fill();
        ctx.strokeStyle = theme.open;
        ctx.lineWidth = 1.5;
        ctx.stroke();
        label(ctx, String(i + 1), x, y + 0.5, theme.ink, theme.yard);
      });
    },
    find(where, { camera, now }) {
      const decision = at(now.t);
      const index = decision?.candidates.findIndex(({ position }) => {
        const { x, y } = camera.screen(position.x, position.y);
        return Math.hypot(x - where.x, y - where.y) < 10;
      }) ?? -1;
      if (index < 0) return null;
      const one = decision!.candidates[index]!;
      return { lines: [`candidate ${index + 1}${one.chosen ? ", chosen" : ""}: ${candidateWords(one, decision!.value_of)}`] };
    },
  };
}
