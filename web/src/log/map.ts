// The map as it was at any time: the last whole map, and what was sent as updates since then.
import type { Vec2 } from "../base/outline";
import type { OccupancyGrid, OccupancyGridUpdate } from "./messages";
import { once } from "./once";
import type { RunLog, Stamped } from "./run_log";
import { topic } from "./topics";

/** Percent from which a cell counts as occupied; less than 0 is unknown. */
export const occupied = 50;

const updatesBetweenKept = 32;
/** How many maps of so many cells are kept: up to 64 MB of them, but 12 of any size. */
const mostKept = (cells: number): number => Math.min(96, Math.max(12, Math.floor(64e6 / Math.max(1, cells))));

export interface MapNow {
  origin: Vec2;
  cell_m: number;
  columns: number;
  rows: number;
  /** Percent, row by row from the lowest; the same array is changed as time goes on. */
  cells: Int8Array;
  known: number;
  /** Columns and rows of what is known: lowest and highest, all included; low is above high where nothing is. */
  extent: { low: Vec2; high: Vec2 };
  /** Another one whenever a cell has changed. */
  version: number;
}

let versions = 0;

function copyOf(map: MapNow): MapNow {
  return { ...map, cells: map.cells.slice(), extent: { low: [...map.extent.low], high: [...map.extent.high] } };
}

/** Puts values into a rectangle of the map, row by row: scrubbing does it for millions of cells. */
function put(map: MapNow, x: number, y: number, width: number, data: ArrayLike<number>): void {
  const { columns, rows, cells } = map;
  const first = Math.max(0, -x);
  const last = Math.min(width, columns - x);
  let known = 0;
  for (let from = 0, row = y; from < data.length; from += width, ++row) {
    if (row < 0 || row >= rows) continue;
    const end = Math.min(last, data.length - from);
    for (let i = from + first, at = row * columns + x + first; i < from + end; ++i, ++at) {
      const value = data[i]!;
      known += (value >> 31) - (cells[at]! >> 31);  // -1 for what is unknown
      cells[at] = value;
    }
    widen(map, row, x - from, data, from + first, from + end - 1);
  }
  map.known += known;
  map.version = ++versions;
}

/** Makes the extent hold what is known among data[left] to data[right], which lies at those columns after `x`. */
function widen({ extent: { low, high } }: MapNow, row: number, x: number, data: ArrayLike<number>, left: number, right: number): void {
  while (left <= right && data[left]! < 0) ++left;
  while (left < right && data[right]! < 0) --right;
  if (left > right) return;
  low[0] = Math.min(low[0], x + left);
  low[1] = Math.min(low[1], row);
  high[0] = Math.max(high[0], x + right);
  high[1] = Math.max(high[1], row);
}

function mapOfWhole({ info, data }: OccupancyGrid): MapNow {
  const map: MapNow = { origin: [info.origin.position.x, info.origin.position.y], cell_m: Math.round(1e6 * info.resolution) / 1e6,
    columns: info.width, rows: info.height, cells: new Int8Array(info.width * info.height).fill(-1), known: 0,
    extent: { low: [Infinity, Infinity], high: [-Infinity, -Infinity] }, version: 0 };
  put(map, 0, 0, Math.max(1, info.width), data);
  return map;
}

interface Kept { whole: number; t: number; map: MapNow }

export class MapHistory {
  private now: Kept | null = null;
  private kept: Kept[] = [];  // from which going back begins
  private since = 0;

  constructor(private log: RunLog) {}

  /** The map at t; null before the first. While a part of a large file is read, as far as it has been read. */
  at(t: number): MapNow | null {
    const whole = this.log.at<OccupancyGrid>(topic.map, t);
    if (whole === undefined) return null;
    if (whole === null) return this.now?.map ?? null;
    const start = this.startOf(whole, t);
    const { messages, until } = this.log.window<OccupancyGridUpdate>(topic.mapUpdates, start.t, t);
    this.now = start;
    for (const update of messages) this.apply(update);
    start.t = Math.max(start.t, until);
    return start.map;
  }

  /** From where the map at t is made: the present one, one that was kept, or the whole one. */
  private startOf(whole: Stamped<OccupancyGrid>, t: number): Kept {
    if (this.now && this.now.whole === whole.t && this.now.t <= t) return this.now;
    this.since = 0;
    const near = this.kept.filter((one) => one.whole === whole.t && one.t <= t).at(-1);
    if (near) return { ...near, map: { ...copyOf(near.map), version: ++versions } };
    return { whole: whole.t, t: whole.t, map: mapOfWhole(whole.message) };
  }

  private apply({ t, message: { x, y, width, data } }: Stamped<OccupancyGridUpdate>): void {
    const now = this.now!;
    put(now.map, x, y, Math.max(1, width), data);
    now.t = t;
    if (++this.since % updatesBetweenKept > 0 || this.kept.some((one) => one.t >= t)) return;
    this.kept.push({ ...now, map: copyOf(now.map) });
    if (this.kept.length > mostKept(now.map.cells.length)) this.kept = this.kept.filter((_, i) => i % 2 === 1);
  }
}

export const mapOf = once((log: RunLog) => new MapHistory(log));

/** Cells known after each message of the map. It goes on where it ended when the log has grown. */
class KnownCells {
  readonly time: number[] = [];
  readonly area: number[] = [];
  private history: MapHistory;

  constructor(private log: RunLog) { this.history = new MapHistory(log); }

  bringUpToDate(): this {
    const last = this.time.at(-1) ?? -Infinity;
    const times = [topic.map, topic.mapUpdates].flatMap((name) => this.log.messages(name).map(({ t }) => t));
    for (const t of [...new Set(times)].filter((one) => one > last).sort((a, b) => a - b)) {
      const map = this.history.at(t);
      if (!map) continue;
      this.time.push(t);
      this.area.push(map.known * map.cell_m ** 2);
    }
    return this;
  }
}

const counted = once((log: RunLog) => new KnownCells(log));

/** The area known over time, m2. Empty of a large file, whose maps are not all in memory. */
export const knownArea = (log: RunLog): { time: number[]; area: number[] } =>
  (log.isLazy(topic.map) ? { time: [], area: [] } : counted(log).bringUpToDate());
