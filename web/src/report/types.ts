// A report as docs/report.md describes it: what the page reads of it.
import type { Num } from "../base/numbers";
import type { Rounded, Vec2 } from "../base/outline";
import { faultOfMap, faultOfRuns } from "./runs";

export type Vec3 = [number, number, number];
export type Pose = [number, number, number];
export type { Num, Vec2 };

export interface Solid {
  name: string;
  kind: string;
  low_z_m: Num;
  high_z_m: Num;
  blocks_driving: boolean;
  footprint: Rounded[];
}
export interface Target {
  name: string;
  status: string;
  reason: string;
  pose: Num[];
  pitch_rad: Num;
  yaw_rad: Num;
  speed_mps: Num;
  clearance_m: Num;
  done_s: Num;
  shots: number;
  centre: Num[];
  size: Num[];
  box_yaw_rad: Num;
  visit?: { entrance: string; from: Vec2; enters_s: Num; settles_s: Num };
  moves?: { time_s: Num; position: Vec2; believed: Vec2 }[];
}
export interface Shot {
  target: string;
  attempt: number;
  time_s: Num;
  flight_s: Num;
  muzzle: Num[];
  velocity_mps: Num[];
  contact: string;
  contact_point: Num[];
  hit: boolean;
  clearance_m: Num;
  profile: { name: string; polygon: Vec2[] }[];
  path?: Vec3[];
}
export interface Event { time_s: Num; kind: string; text: string }
export interface Belief {
  time_s: number;
  pose: Pose;
  sigma_x_m: number;
  sigma_y_m: number;
  correlation: number;
  sigma_rad: number;
  corrected: boolean;
}
export interface Tag { id: number; position: Vec2; facing_rad: number; size_m: number; height_m?: Num }
export interface Eye { width_px: number; height_px: number; fx: number; fy: number; cx: number; cy: number; ahead_m: number; height_m: number }
export interface Drive {
  loop: string;
  tags: Tag[];
  stops: { pose: Pose; stop: boolean; time_s: Num; error: Num[]; heading_error_rad: Num }[];
  beliefs: Belief[];
  camera?: Eye;
}
export interface Pursuit {
  columns: number;
  rows: number;
  cell_m: number;
  cost_runs: number[];
  target: Vec2[];
  robots: Vec2[][];
  paid: Num[];
  bounds: Num[][];
}
export interface Explore {
  map: { origin: Vec2; cell_m: number; columns: number; rows: number; state_runs: number[]; step_s: number; known_runs: number[] };
  walls: Vec2[][];
  beliefs: Belief[];
  decisions: { time_s: number; kind: string; goal: Vec2 | Pose; waypoints: Vec2[]; frontiers: number }[];
  refused: { position: Vec2; reason: string }[];
  laser?: { beams: number; range_m: number; height_m: number; mount: Pose };
}
/** Closed outlines: counter-clockwise, and clockwise for holes. */
export type Outlines = Vec2[][];
export interface Cover {
  width_m: number;
  area: Outlines;
  reach: Outlines;
  missed: Outlines;
  overlap: Outlines;
  planned: Vec2[];
  passes: { start_s: number; end_s: number; role: "lap" | "lane" | "move" }[];
  /** Rows [time_s, covered_m2, overlap_m2]. */
  covered: number[][];
}
export interface Landmark {
  id: number;
  first_s: number;
  position: Vec2;
  sigma_x_m: number;
  sigma_y_m: number;
  correlation: number;
  sightings: number;
  truth?: Vec2;
}
export interface Slam {
  engine: string;
  beliefs: Belief[];
  odometry: Vec2[];
  reference: Vec2[];
  loops: { time_s: number; from: Vec2; to: Vec2 }[];
  landmarks: Landmark[];
  /** In the frame of the robot. */
  scans: { time_s: number; points: Vec2[] }[];
  map?: Explore["map"];
}
export interface ReliefGrid { origin: Vec2; spacing_m: Vec2; columns: number; rows: number; heights_m: number[] }
export interface Report {
  outrider_report: number;
  status: string;
  job: string;
  reason: string;
  seed: number;
  metrics: Record<string, Num>;
  targets: Target[];
  settings: Record<string, string>;
  warnings: string[];
  world: {
    name: string;
    bounds: [Vec2, Vec2] | null;
    gravity_mps2: number;
    solids: Solid[];
    terrain?: { contours: { height_m: number; points: Vec2[] }[]; steep: Rounded[]; relief?: ReliefGrid };
  };
  robot: { radius_m: Num; gun_length_m: Num; ball_radius_m: Num; margin_m: Num; start: Num[] };
  paths: { start_s: Num; end_s: Num; waypoints: Vec2[] }[];
  shots: Shot[];
  events: Event[];
  track: Num[][];
  supplies?: {
    tank: Num;
    battery_j: Num;
    stations: { name: string; position: Vec2; gives_water: boolean; gives_charge: boolean }[];
    levels: Num[][];
  };
  pursuit?: Pursuit;
  drive?: Drive;
  explore?: Explore;
  cover?: Cover;
  slam?: Slam;
}

/** Why a map of the report cannot be drawn, with its key; null when all can. */
function faultOfMaps({ pursuit, explore, slam }: Partial<Report>): string | null {
  const fault = pursuit ? faultOfRuns(pursuit.cost_runs, pursuit.columns, pursuit.rows) : null;
  if (fault) return `pursuit.cost_runs: ${fault}`;
  return (explore?.map ? faultOfMap(explore.map, "explore.map") : null) ?? (slam?.map ? faultOfMap(slam.map, "slam.map") : null);
}

/** The report in a text, or a sentence why it is none. */
export function parseReport(text: string): Report | string {
  let json: Partial<Report>;
  try {
    json = JSON.parse(text) as Partial<Report>;
  } catch {
    return "this is no JSON, so it is no report; a report is the .json file that a run leaves in its --out folder";
  }
  if (json?.outrider_report === undefined) return "this JSON is no report: the key outrider_report is missing";
  if (json.outrider_report !== 1) return `this is a report of version ${String(json.outrider_report)}, and this page reads version 1`;
  for (const key of ["world", "robot", "targets", "shots", "events", "track", "metrics", "paths"] as const) {
    if (json[key] === undefined) return `${key}: this key is missing; the file was cut or written by something else`;
  }
  return faultOfMaps(json) ?? (json as Report);
}
