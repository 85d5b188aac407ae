// The topics of a run, as include/outrider/log/topics.hpp has them, and message types that are looked for by their name.

export const topic = {
  staticTransforms: "/tf_static",
  pose: "/pose",
  belief: "/belief",
  corrections: "/corrections",
  odometry: "/odom",
  joints: "/joint_states",
  scan: "/scan",
  camera: "/camera/camera_info",
  plan: "/plan",
  /** Prefix: the paths of the planner of that name. */
  planOf: "/plan/",
  goal: "/goal_pose",
  trajectory: "/trajectory",
  reference: "/reference",
  map: "/map",
  mapUpdates: "/map_updates",
  targetPose: "/target_pose",
  events: "/rosout",
  footprint: "/footprint",
  run: "/run",
  solids: "/solids",
  terrain: "/terrain",
  walls: "/walls",
  keepOutZones: "/keep_out_zones",
  slowZones: "/slow_zones",
  shots: "/shots",
  firingMap: "/firing_map",
  blockedFlights: "/blocked_flights",
  tours: "/tours",
  targets: "/targets",
  targetPositions: "/target_positions",
  supplies: "/supplies",
  stores: "/stores",
  tags: "/tags",
  waypoints: "/waypoints",
  decisions: "/decisions",
  refusals: "/refusals",
  coverageArea: "/coverage_area",
  coverage: "/coverage",
  coveragePasses: "/coverage_passes",
  costGrid: "/cost_grid",
  paid: "/paid",
  bounds: "/cost_bounds",
  landmarks: "/landmarks",
  sightings: "/sightings",
  loops: "/loops",
} as const;

/** Topics of the robots after the first: /robot_2/pose, /robot_3/pose, ... */
export const ofRobot = (robot: number, name: string): string => `/robot_${robot}${name}`;

/** Topics that nothing is drawn of; their messages are not kept. */
export const unread = new Set(["/tf", "/scene"]);

/** Types of scans and pictures, of which only the present one is drawn: in all but small files they are read when they are shown. */
export const scanTypes: ReadonlySet<string> = new Set(["sensor_msgs/msg/LaserScan", "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"]);

/** Types whose messages are large: in a large file they are read when they are shown. */
export const heavyTypes: ReadonlySet<string> = new Set([...scanTypes, "nav_msgs/msg/OccupancyGrid", "map_msgs/msg/OccupancyGridUpdate"]);
