// run.json, which a finished run has as an attachment of its log: verdict, metrics, settings, warnings and tables.
import type { Num } from "../base/numbers";

/** A row of a table: numbers, texts, points. */
export type TableRow = Record<string, unknown>;

export interface Summary {
  status: string;
  job: string;
  world: string;
  reason: string;
  metrics: Record<string, Num>;
  settings: Record<string, string>;
  warnings: string[];
  tables: Record<string, TableRow[]>;
}

const isTable = (value: unknown): value is TableRow[] =>
  Array.isArray(value) && value.every((row) => typeof row === "object" && row !== null && !Array.isArray(row));

/** Reads run.json. What is missing is empty: the log tells of the run all the same. */
export function parseSummary(text: string): Summary | null {
  let json: Partial<Summary>;
  try {
    json = JSON.parse(text) as Partial<Summary>;
  } catch {
    return null;
  }
  if (typeof json !== "object" || json === null) return null;
  const { status = "", job = "", world = "", reason = "", metrics = {}, settings = {}, warnings = [], ...rest } = json;
  const tables = Object.fromEntries(Object.entries(rest as Record<string, unknown>).flatMap(([name, rows]) => (isTable(rows) && rows.length > 0 ? [[name, rows]] : [])));
  return { status, job, world, reason, metrics, settings, warnings, tables };
}
