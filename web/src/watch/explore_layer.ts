// Exploring: the map as it was discovered, the walls as they are, where the robot decided to go.
import { Path } from "../base/ink";
import { traceRounded } from "../base/outline";
import { theme } from "../base/theme";
import type { Run } from "../report/run";
import { spread } from "../report/runs";
import type { Explore } from "../report/types";
import { areaOf } from "./area";
import { disk, type Layer, type Pen } from "./layer";

const occupied = 1;
const unknown = 2;

/** Cells of the map in the order of their discovery, painted onto a picture of one pixel a cell as time goes on. */
export class Discovery {
  readonly canvas = document.createElement("canvas");
  private order: Uint32Array;
  private step: Int16Array;
  private state: Int16Array;
  private painted = 0;
  private colours = "";

  constructor(private map: Explore["map"]) {
    const size = map.columns * map.rows;
    this.state = spread(map.state_runs, map.columns, map.rows, Int16Array);
    this.step = spread(map.known_runs, map.columns, map.rows, Int16Array);
    const known = Array.from({ length: size }, (_, i) => i).filter((i) => this.state[i] !== unknown);
    this.order = Uint32Array.from(known.sort((a, b) => this.step[a]! - this.step[b]! || a - b));
    this.canvas.width = Math.max(1, map.columns);
    this.canvas.height = Math.max(1, map.rows);
  }

  /** How many cells were known at t, of all or of some in the order of their discovery. O(log cells). */
  knownAt(t: number, cells = this.order): number {
    let low = 0;
    let high = cells.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.step[cells[middle]!]! * this.map.step_s <= t) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** Cells with something in them, in the order of their discovery. */
  occupied(): Uint32Array { return this.order.filter((cell) => this.state[cell] === occupied); }

  get cells(): number { return this.order.length; }

  /** Paints or takes away just the cells between the present picture and that of t. */
  paint(t: number): void {
    const colours = `${theme.yard} ${theme["solid-high"]}`;
    const ctx = this.canvas.getContext("2d")!;
    if (colours !== this.colours) {
      ctx.clearRect(0, 0, this.canvas.width, this.canvas.height);
      this.colours = colours;
      this.painted = 0;
    }
    const wanted = this.knownAt(t);
    for (let i = this.painted; i < wanted; ++i) this.cell(ctx, this.order[i]!, true);
    for (let i = wanted; i < this.painted; ++i) this.cell(ctx, this.order[i]!, false);
    this.painted = wanted;
  }

  private cell(ctx: CanvasRenderingContext2D, index: number, shown: boolean): void {
    const { columns, rows } = this.map;
    const [x, y] = [index % columns, rows - 1 - Math.floor(index / columns)];
    if (!shown) {
      ctx.clearRect(x, y, 1, 1);
      return;
    }
    ctx.fillStyle = this.state[index] === occupied ? theme["solid-high"] : theme.yard;
    ctx.fillRect(x, y, 1, 1);
  }
}

/** The map as far as it is known now. */
export function drawDiscovery({ ctx, now }: Pen, discovery: Discovery, map: Explore["map"]): void {
  discovery.paint(now.t);
  ctx.save();
  ctx.imageSmoothingEnabled = false;
  ctx.globalAlpha = 0.85;
  ctx.translate(map.origin[0], map.origin[1] + map.rows * map.cell_m);
  ctx.scale(map.cell_m, -map.cell_m);
  ctx.drawImage(discovery.canvas, 0, 0);
  ctx.restore();
}

/** The decision that holds at t; none once there is nothing to explore any more. */
export function decisionAt(run: Run, t: number): Explore["decisions"][number] | undefined {
  return t <= run.believedUntil ? run.report.explore?.decisions.findLast((one) => one.time_s <= t) : undefined;
}

function drawDecision({ ctx, camera }: Pen, decision: Explore["decisions"][number]): void {
  ctx.strokeStyle = theme.open;
  ctx.lineWidth = camera.px(1.6);
  ctx.beginPath();
  for (const [x, y] of decision.waypoints) ctx.lineTo(x, y);
  ctx.stroke();
  disk(ctx, decision.goal[0], decision.goal[1], camera.px(6));
  ctx.stroke();
}

export function explore(run: Run): Layer | null {
  const found = run.report.explore;
  if (!found) return null;
  const { map } = found;
  const discovery = new Discovery(map);
  const walls = new Path();
  for (const outline of found.walls) traceRounded(walls, outline, 0);
  const [x0, y0, x1, y1] = areaOf(run);
  return {
    still({ ctx, camera }) {
      ctx.fillStyle = theme.grid;
      ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
      ctx.fillStyle = ctx.strokeStyle = theme["solid-low"];
      ctx.lineWidth = camera.px(0.7);
      ctx.fill(walls);
      ctx.stroke(walls);  // no seams between pieces of one wall
    },
    moving(pen) {
      const { ctx, camera, now } = pen;
      drawDiscovery(pen, discovery, map);
      const decision = decisionAt(run, now.t);
      if (decision) drawDecision(pen, decision);
      if (now.t < run.duration - 1e-6) return;
      ctx.strokeStyle = theme.unreachable;
      ctx.lineWidth = camera.px(1.6);
      for (const { position: [x, y] } of found.refused) {
        const r = camera.px(5);
        ctx.strokeRect(x - r, y - r, 2 * r, 2 * r);
      }
    },
    find(at, { camera }) {
      const refused = found.refused.find(({ position }) => {
        const place = camera.screen(...position);
        return Math.hypot(place.x - at.x, place.y - at.y) < 9;
      });
      return refused ? { lines: [refused.reason] } : null;
    },
  };
}
