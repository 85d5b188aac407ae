// The server's interface (docs/server.md): requests return a value or throw the server's sentence.
import { base64Of } from "./base/base64";
import { sourceOf, type Source } from "./log/source";

export interface FileRow { path: string; kind: "scenario" | "log" | "result" | "map" | "other"; job?: string; description?: string; bytes: number }
export interface OptionRow {
  name: string;
  type: "number" | "integer" | "boolean" | "string";
  unit: string;
  low?: number;
  high?: number;
  default: number | boolean | string;
  sentence: string;
  /** Names of which a text is one. */
  choices?: string[];
}
export interface PlannerRow {
  name: string;
  sentence: string;
  paper: string;
  guarantee: { sentence: string; among: string; measure: string; cost_unit: string };
  grounds: ("cells" | "corners" | "polygons")[];
  traces: boolean;
  /**
   * The kind of trace: every expansion and the queue, the tree that was drawn, or none because the planner looks up its
   * answer.
   */
  tells: "search" | "tree" | "lookup";
  index: boolean;
  options: OptionRow[];
}
export interface Grid { origin: [number, number]; resolution_m: number; width: number; height: number; runs: number[]; yaw_rad?: number }
export interface Polygons {
  boundary: [number, number][];
  obstacles: [number, number][][];
  queries: { start: [number, number]; goal: [number, number] }[];
}
export interface MapAnswer { id: string; name: string; radius_m: number; warnings: string[]; grid?: Grid; polygons?: Polygons }
export type Edit = { block: number[] } | { free: number[] } | { set: number; polygon: [number, number][] } | { remove: number } | { add: [number, number][] };
export interface PlanRequest {
  map: string;
  edits: Edit[];
  start: [number, number];
  goal: [number, number];
  planner: string;
  options: Record<string, number | boolean | string>;
  model?: string;
  radius_m?: number;
  resolution_m?: number;
  trace?: number;
  /** Requests the cells that the robot's centre must not enter. */
  blocked?: boolean;
  /** Requests the edges of the visibility graph, or the medial axis. */
  legs?: boolean;
}
/** Describes a straight line, or an arc about a centre. */
export interface Piece { from: [number, number]; to: [number, number]; centre?: [number, number]; turn_rad?: number }
export interface GridTrace {
  columns: string[];
  rows: number[][];
  /** x, y, expansions, x, y, expansions, ...: where and after how many expansions a vertex was first queued. */
  openings?: number[];
  model: "cells" | "corners";
  frame: { origin: [number, number]; resolution_m: number; width: number; height: number };
  truncated: boolean;
}
/** Holds the trace of a search without a grid: its states are numbers. */
export interface PlacedTrace {
  columns: string[];
  rows: number[][];
  /** State, expansions, state, expansions, ... */
  openings?: number[];
  model: "places";
  /** The position of each state. */
  places: [number, number][];
  truncated: boolean;
}
export type TraceAnswer = GridTrace | PlacedTrace;
/** Holds the answer of a planner; null where a number is unknown, such as all numbers of a path that was not found. */
export interface PlanRow {
  planner: string;
  from: [number, number];
  to: [number, number];
  /** "done", or the code of the fault. */
  status: string;
  reason: string;
  cost: number | null;
  cost_unit: string;
  lower_bound: number | null;
  length_m: number | null;
  clearance_m: number | null;
  expansions: number | null;
  line_of_sight_checks: number | null;
  time_s: number;
  waypoints: [number, number][];
  pieces: Piece[];
}
/** Holds the details of a search that a request asked for. */
export interface PlanView {
  blocked?: Grid;
  trace?: TraceAnswer;
  legs?: [number, number, number, number][];
}
/** Holds what `outrider plan --json` prints, and the view. */
export interface PlanAnswer {
  status: "done" | "not_done";
  reason: string;
  metrics: Record<string, number | null>;
  rows: PlanRow[];
  warnings: string[];
  view: PlanView;
}
export interface YardTarget { name: string; position: [number, number, number]; size: [number, number, number]; heading_rad: number }
/**
 * Describes a movable thing of a yard's world: its polygons as in the world file, and the current place of its middle.
 */
export interface YardThing { name: string; middle: [number, number]; polygons: [number, number][][]; place: [number, number]; turn_rad: number; removed: boolean }
export interface YardRequest {
  scenario: string;
  start: [number, number];
  heading_rad: number;
  targets: { name: string; position: [number, number]; heading_rad: number }[];
  /** Low x, low y, high x, high y, and the turn about the middle. */
  boxes: number[][];
  moved: { name: string; place: [number, number]; turn_rad: number }[];
  removed: string[];
}
/** Holds a scenario that the page shows and changes: a path planning question, or a yard to guard. */
export type ScenarioAnswer = { path: string; map: MapAnswer; start: [number, number] } & (
  | { goal: [number, number]; planner: string; options: PlanRequest["options"]; model: string; radius_m: number; resolution_m: number }
  | { heading_rad: number; targets: YardTarget[]; fixed: [number, number][][]; things: YardThing[] });
/** A scenario seen from above: its ground, coarse where it is large and null where it names none, the start and the targets. */
export interface SceneAnswer {
  /** `others`: the boundaries of further areas. */
  map: Pick<MapAnswer, "name" | "grid" | "polygons"> & { others?: [number, number][][] } | null;
  start: [number, number] | null;
  targets: [number, number][];
}
export type ScenarioRequest =
  | { plan: PlanRequest }
  | { guard: YardRequest };
export interface RunRow {
  id: string;
  state: "queued" | "running" | "done" | "not_done" | "refused" | "cancelled" | "failed" | "cut_short";
  scenario: string;
  job: string;
  seed: number | null;
  /** Unix time at which it was asked for, s. */
  began_s: number;
  /** From then until its end, s. */
  took_s: number | null;
  progress: { step: number; steps: number; name: string; part: number } | null;
  error: string;
  where: string;
  /** It has ended and left a log. */
  has_log: boolean;
  summary: { reason?: string; metrics?: Record<string, number | null> } | null;
}
/** The newest run first; the notice says why runs are not kept. */
export interface RunsAnswer { runs: RunRow[]; notice: string }

const base = "api/v1/";

/** Returns the token, which is given once in the address of the page and kept for this tab only. */
export function token(): string {
  const given = new URLSearchParams(location.search).get("token");
  if (given) {
    sessionStorage.setItem("token", given);
    history.replaceState(history.state, "", location.pathname + location.hash);
  }
  return sessionStorage.getItem("token") ?? "";
}

const encoded = (path: string): string => path.split("/").map(encodeURIComponent).join("/");
export const filePath = (path: string): string => `files/${encoded(path)}`;
export const scenarioPath = (path: string): string => `scenarios/${encoded(path)}`;
export const scenePath = (path: string): string => `scenes/${encoded(path)}`;

/** A fault in one sentence, with where it is. */
export const faultText = ({ where, error }: { where: string; error: string }): string =>
  (where && error && !error.includes(where) ? `${where}: ${error}` : error);

async function answer(path: string, init: RequestInit = {}): Promise<Response> {
  const headers = new Headers(init.headers);
  if (token()) headers.set("Authorization", `Bearer ${token()}`);
  const response = await fetch(base + path, { ...init, headers }).catch(() => {
    throw new Error("the server does not answer; is `outrider serve` still running?");
  });
  if (response.ok) return response;
  const fault = await response.json().catch(() => null) as { error?: string; where?: string } | null;
  throw new Error(faultText({ where: fault?.where ?? "", error: fault?.error ?? `the server answered with status ${response.status}` }));
}

export async function getJson<T>(path: string): Promise<T> {
  return await (await answer(path)).json() as T;
}

/** Size up to which a file is moved at once: many small requests take longer. */
const movedWhole = 64 << 20;

/** A file at the server; of a large one only the parts that are read are moved. */
export async function fileAt(path: string): Promise<Source> {
  const part = async (from: number, to: number): Promise<Response> => answer(path, { headers: { Range: `bytes=${from}-${to - 1}` } });
  const whole = async (): Promise<Blob> => (await answer(path)).blob();
  const size = Number((await part(0, 1).catch(() => null))?.headers.get("Content-Range")?.split("/")[1] ?? 0);
  if (size <= movedWhole) return sourceOf(await whole());
  return { size, whole, read: async (from, to) => new Uint8Array(await (await part(from, to)).arrayBuffer()) };
}

/** Saves a scenario with the files that it needs; existing files are replaced only if `replace` is set. */
export async function saveScenario(path: string, scenario: ScenarioRequest, replace: boolean): Promise<{ path: string; files: string[] }> {
  const headers = { "Content-Type": "application/json", ...(replace ? {} : { "If-None-Match": "*" }) };
  const response = await answer(scenarioPath(path), { method: "PUT", body: JSON.stringify(scenario), headers });
  return await response.json() as { path: string; files: string[] };
}

export async function send<T>(method: "POST" | "DELETE", path: string, body?: unknown): Promise<T> {
  const init: RequestInit = body === undefined ? { method }
    : { method, body: JSON.stringify(body), headers: { "Content-Type": "application/json" } };
  return await (await answer(path, init)).json() as T;
}

/** Starts a mission and goes to where it is watched. */
export async function startRun(scenario: string, seed: number | null = null): Promise<void> {
  const { id } = await send<RunRow>("POST", "runs", seed === null ? { scenario } : { scenario, seed });
  location.hash = `live/${id}`;
}

/** Sends a map that was dropped on the page; maps of map_server are two files. */
export async function postMap(files: File[]): Promise<MapAnswer> {
  return send("POST", "maps", { files: await Promise.all(files.map(async (file) => ({ name: file.name, base64: base64Of(new Uint8Array(await file.arrayBuffer())) }))) });
}
