// Run-length lists: [value, count, value, count, ...], row by row, as maps are drawn in a report.

const mostCells = 4_000_000;  // of a map that is drawn; the same as in include/outrider/report/report.hpp
const remedy = "the file was damaged or written by something else; run the job again";

const whole = (value: unknown): value is number => typeof value === "number" && Number.isInteger(value) && value >= 0;

/** Why the runs do not fill a map of columns x rows cells exactly; null when they do. Decodes nothing. */
export function faultOfRuns(runs: unknown, columns: unknown, rows: unknown): string | null {
  const size = `${String(columns)} x ${String(rows)}`;
  if (!whole(columns) || !whole(rows) || columns * rows > mostCells) return `the map has ${size} cells, and a report draws ${mostCells} at most; ${remedy}`;
  if (!Array.isArray(runs) || runs.length % 2 !== 0) return `values and counts come in pairs; ${remedy}`;
  let filled = 0;
  for (let i = 0; i < runs.length; i += 2) {
    if (!Number.isFinite(runs[i])) return `entry ${i} is no number; ${remedy}`;
    const count: unknown = runs[i + 1];
    if (!whole(count) || count > columns * rows - filled) {
      return `entry ${i + 1} is ${String(count)}, but counts are whole numbers that add up to ${size} cells; ${remedy}`;
    }
    filled += count;
  }
  return filled === columns * rows ? null : `the counts add up to ${filled} cells, but the map has ${size}; ${remedy}`;
}

/** The same of both lists of a map that was discovered, with the key. */
export function faultOfMap(map: { columns: unknown; rows: unknown; state_runs: unknown; known_runs: unknown }, where: string): string | null {
  for (const key of ["state_runs", "known_runs"] as const) {
    const fault = faultOfRuns(map[key], map.columns, map.rows);
    if (fault) return `${where}.${key}: ${fault}`;
  }
  return null;
}

/** The cells of runs, one value each. Throws, before it takes any memory, where they do not fill the map. */
export function spread<T extends Int16Array | Float64Array>(runs: number[], columns: number, rows: number, Cells: new (size: number) => T): T {
  const fault = faultOfRuns(runs, columns, rows);
  if (fault) throw new Error(fault);
  const cells = new Cells(columns * rows);
  let at = 0;
  for (let i = 0; i < runs.length; i += 2) {
    cells.fill(runs[i]!, at, at + runs[i + 1]!);
    at += runs[i + 1]!;
  }
  return cells;
}
