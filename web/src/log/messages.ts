// The messages of a run that the page reads, with the fields that it uses (include/outrider/log/messages/*.hpp lists all).
// Units are SI; an unknown number is NaN.

export interface Point2 { x: number; y: number }
export interface Point3 extends Point2 { z: number }
export interface Quaternion extends Point3 { w: number }
export interface Pose3 { position: Point3; orientation: Quaternion }
export interface Header { stamp: { sec: number; nanosec: number }; frame_id: string }

// Standard ROS messages.
export interface PoseStamped { header: Header; pose: Pose3 }
export interface PoseWithCovarianceStamped { pose: { pose: Pose3; covariance: ArrayLike<number> } }
export interface Odometry { pose: { pose: Pose3 } }
export interface Path { poses: PoseStamped[] }
export interface TFMessage { transforms: { child_frame_id: string; transform: { translation: Point3; rotation: Quaternion } }[] }
export interface JointState { name: string[]; position: ArrayLike<number> }
export interface LaserScan { angle_min: number; angle_increment: number; range_min: number; range_max: number; ranges: Float32Array }
export interface CameraInfo { width: number; height: number; k: ArrayLike<number> }
export interface OccupancyGrid { info: { resolution: number; width: number; height: number; origin: Pose3 }; data: Int8Array }
export interface PolygonStamped { polygon: { points: Point3[] } }
export interface OccupancyGridUpdate { x: number; y: number; width: number; height: number; data: Int8Array }
/** A line of /rosout: `name` is the kind of an event. */
export interface LogLine { name: string; msg: string }

// Messages of our own: outrider_msgs/msg/*.
export interface RunInfo {
  job: string;
  /** Numbers are drawn at random, with the seed. */
  seeded: boolean;
  seed: bigint;
  world: string;
  low: Point2;
  high: Point2;
  gravity: number;
  robot_radius: number;
  gun_length: number;
  ball_radius: number;
  margin: number;
  coverage_width: number;
  /** Length of a bar; absent or 0: a disk covers. */
  coverage_length?: number;
  coverage_forward?: number;
}
export interface RoundedPolygon { points: Point2[]; radius: number }
export interface Solid { name: string; kind: string; footprint: RoundedPolygon[]; low_z: number; high_z: number; blocks_driving: boolean }
export interface Solids { solids: Solid[] }
export interface Outline { points: Point2[] }
export interface Outlines { outlines: Outline[] }
export interface Terrain {
  contours: { height: number; points: Point2[] }[];
  steep: RoundedPolygon[];
  origin: Point2;
  spacing: Point2;
  columns: number;
  rows: number;
  heights: ArrayLike<number>;
}
export interface Shot {
  target: string;
  attempt: number;
  flight: number;
  gun_pitch: number;
  muzzle: Point3;
  velocity: Point3;
  platform_velocity?: Point2;
  contact: string;
  contact_point: Point3;
  hit: boolean;
  clearance: number;
  path: Point3[];
  profile: { name: string; polygon: Point2[] }[];
}
export interface Target { name: string; status: string; reason: string; size: Point3; yaw: number; shots: number; entrance: string }
export interface TargetPosition { name: string; centre: Point3; believed: Point2 }
export interface Tour { stops: { position: Point2; targets: string[] }[]; way: Point2[]; cost: number; lower_bound: number }
export interface Station { name: string; position: Point2; gives_water: boolean; gives_charge: boolean }
export interface Supplies { tank: number; battery: number; stations: Station[] }
export interface StoreLevels { water: number; charge: number }
export interface Tag { id: number; position: Point3; facing: number; size: number }
export interface Tags { tags: Tag[] }
export interface Waypoint { position: Point2; heading: number; stop: boolean; reached: number; error: Point2 }
export interface Waypoints { waypoints: Waypoint[] }
export interface Candidate { position: Point2; cost: number; gain: number; value: number; chosen: boolean }
export interface Decision { kind: string; frontiers: number; value_of: string; most_is_best: boolean; candidates: Candidate[] }
export interface Refusal { position: Point2; reason: string }
export interface CoverageArea { area: Outline[]; reach: Outline[]; missed: Outline[]; overlap: Outline[]; planned: Point2[] }
export interface Coverage { covered: number; overlap: number }
export interface CoveragePass { role: "lap" | "lane" | "move" }
export interface CostGrid { origin: Point2; resolution: number; width: number; height: number; costs: ArrayLike<number> }
export interface PaidCost { paid: number }
export interface CostBound { expansions: number; cost: number; lower_bound: number }
export interface Landmark {
  id: bigint;
  first_seen: number;
  position: Point2;
  sigma_x: number;
  sigma_y: number;
  correlation: number;
  sightings: number;
  truth: Point2;
}
export interface Landmarks { landmarks: Landmark[] }
export interface Sightings { points: Point2[] }
export interface Loop { closed: number; from: Point2; to: Point2 }
export interface Loops { loops: Loop[] }
