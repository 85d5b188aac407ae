// The best blocked flight at each target that cannot be hit: dashes to what is in its way, which is named where the target is selected.
import { nearestOnPolygon } from "../base/outline";
import { theme } from "../base/theme";
import { blockedOf, type Flight } from "../log/flights";
import type { Run } from "../log/run";
import { targetsOf } from "../log/targets";
import { topic } from "../log/topics";
import { cross } from "./flight_layer";
import { label, type Layer, type Pen } from "./layer";

function draw({ ctx, camera, now }: Pen, flight: Flight): void {
  const selected = now.target?.name === flight.target;
  ctx.strokeStyle = theme.unreachable;
  ctx.globalAlpha = selected ? 1 : 0.6;
  ctx.lineWidth = camera.px(selected ? 2 : 1.2);
  ctx.setLineDash([camera.px(5), camera.px(4)]);
  ctx.beginPath();
  ctx.moveTo(flight.from[0], flight.from[1]);
  ctx.lineTo(flight.to[0], flight.to[1]);
  ctx.stroke();
  ctx.setLineDash([]);
  cross({ ctx, camera, now }, flight.to[0], flight.to[1], selected ? 5 : 3.5);
  ctx.globalAlpha = 1;
}

export function blocked(run: Run): Layer | null {
  const all = [...blockedOf(run).values()];
  if (all.length === 0) return null;
  const targets = targetsOf(run);
  /** Returns the flights whose target is known to be out of reach by now. */
  const shown = (t: number): Flight[] => all.filter(({ target }) => targets.find(({ name }) => name === target)?.statusAt(t) === "unreachable");
  return {
    moving(pen) {
      const { ctx, camera, now } = pen;
      const flights = shown(now.t);
      for (const flight of flights) draw(pen, flight);
      const chosen = flights.find(({ target }) => target === now.target?.name);
      if (!chosen) return;
      camera.toScreen(ctx);
      ctx.textAlign = "left";
      ctx.textBaseline = "middle";
      ctx.font = `650 11.5px ${theme.sans}`;
      const { x, y } = camera.screen(chosen.to[0], chosen.to[1]);
      const words = [`blocked by ${chosen.contact}`, chosen.contact].find((one) => x + 12 + ctx.measureText(one).width < camera.width) ?? "";
      label(ctx, words, x + 9, y - 9, theme.unreachable, theme.yard);
    },
    find(at, { camera, now }) {
      const { x, y } = camera.plane(at);
      const found = shown(now.t).find(({ from, to }) => nearestOnPolygon(x, y, [[from[0], from[1]], [to[0], to[1]]]).distance < camera.px(7));
      if (!found) return null;
      const target = targets.find(({ name }) => name === found.target)!;
      return { target, told: { topic: topic.blockedFlights, name: `the best flight at ${found.target}`, at: () => run.log.messages<{ target: string }>(topic.blockedFlights).find(({ message }) => message.target === found.target)?.message },
        lines: [`The best flight at ${found.target} is blocked by ${found.contact}`] };
    },
  };
}
