// Assembles the report of a running mission from the server's messages (docs/server.md).
import type { Explore, Report } from "../report/types";
import { faultOfMap } from "../report/runs";
import type { Message } from "./socket";

type Part = Record<string, unknown>;

/** Lists to which new items are appended; other lists are replaced. */
const going = new Set(["paths", "shots", "events", "track", "levels", "beliefs", "decisions", "target", "paid", "bounds", "odometry", "reference", "scans"]);
/** Objects that are replaced as a whole. */
const whole = new Set(["world", "robot", "map", "metrics", "settings"]);

const nothing: Explore["map"] = { origin: [0, 0], cell_m: 0.05, columns: 0, rows: 0, state_runs: [], step_s: 1, known_runs: [] };

function goOn(list: unknown[], items: unknown[]): void {
  for (const item of items) list.push(item);
}

/** Merges a part of a report into the report so far. */
function join(into: Part, part: Part): void {
  for (const [key, value] of Object.entries(part)) {
    if (Array.isArray(value)) {
      const list = (into[key] ??= []) as unknown[];
      if (going.has(key)) goOn(list, value);
      else if (key === "robots") value.forEach((way: unknown[], i) => goOn((list[i] ??= []) as unknown[], way));
      else if (value.length > 0) into[key] = value;
    } else if (value !== null && typeof value === "object" && !whole.has(key)) {
      join((into[key] ??= {}) as Part, value as Part);
    } else {
      into[key] = value;
    }
  }
}

export class Growth {
  /** The report so far; null before the mission has begun. */
  report: Report | null = null;

  /** Takes a message of the run; returns true if the report has grown. */
  receive(message: Message): boolean {
    if (message.type === "scene") {
      this.add(message.report as Part);
      return true;
    }
    if (!this.report) return false;
    if (message.type === "growth") this.add(message.report as Part);
    else if (message.type === "map" && faultOfMap(message.map as Explore["map"], "map")) return false;
    else if (message.type === "map") this.add({ [this.report.slam ? "slam" : "explore"]: { map: message.map } });
    else if (message.type === "samples") this.add({ track: message.rows });
    else if (message.type === "events") this.add({ events: message.events });
    else return false;
    return true;
  }

  private add(part: Part): void {
    this.report ??= {} as Report;
    join(this.report as unknown as Part, part);
    if (this.report.explore) this.report.explore.map ??= nothing;
  }
}
