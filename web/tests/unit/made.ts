// Logs made for tests: of objects, which need no schemas, or as the bytes of an MCAP file.
import { McapWriter, type IWritable } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";
import type { PoseStamped, PoseWithCovarianceStamped, RunInfo } from "../../src/log/messages";
import { Run } from "../../src/log/run";
import { RunLog } from "../../src/log/run_log";
import type { Summary } from "../../src/log/summary";
import { Track } from "../../src/log/track";

/** Time and message of each topic. */
export type Topics = Record<string, [number, unknown][]>;

/** Appends messages to a log; what they decode to is the objects themselves. */
export function append(log: RunLog, topics: Topics): RunLog {
  for (const [topic, messages] of Object.entries(topics)) {
    for (const [t, message] of messages) {
      const key = held.push(message) - 1;
      log.addChannel(topic, "", (bytes) => held[new DataView(bytes.buffer).getUint32(0)]).append(t, new Uint8Array(new Uint32Array([key]).buffer).reverse());
    }
  }
  return log;
}
const held: unknown[] = [];

export const logOf = (topics: Topics = {}): RunLog => append(new RunLog(), topics);
export const runOf = (topics: Topics = {}, goesOn = false): Run => new Run(logOf(topics), goesOn);

export const summary = (more: Partial<Summary> = {}): Summary =>
  ({ status: "done", job: "guard", world: "w", reason: "", metrics: {}, settings: {}, warnings: [], tables: {}, ...more });

export const info = (more: Partial<RunInfo> = {}): RunInfo => ({ job: "guard", seeded: true, seed: 1n, world: "w", low: { x: 0, y: 0 }, high: { x: 4, y: 4 },
  gravity: 9.8, robot_radius: 0.2, gun_length: 0.3, ball_radius: 0.02, margin: 0.03, coverage_width: 1, ...more });

export const pose = (x: number, y: number, heading = 0, t = 0): PoseStamped => ({ header: { stamp: { sec: Math.floor(t), nanosec: Math.round(1e9 * (t % 1)) }, frame_id: "map" },
  pose: { position: { x, y, z: 0 }, orientation: { x: 0, y: 0, z: Math.sin(heading / 2), w: Math.cos(heading / 2) } } });

/** Poses at times: rows of time, x, y and heading. */
export const poses = (rows: number[][]): [number, PoseStamped][] => rows.map(([t, x, y, heading]) => [t!, pose(x!, y!, heading, t)]);

export function belief(x: number, y: number, heading = 0, sigma_x = 1, sigma_y = sigma_x, correlation = 0): PoseWithCovarianceStamped {
  const covariance = new Array<number>(36).fill(0);
  [covariance[0], covariance[7], covariance[1], covariance[6]] = [sigma_x ** 2, sigma_y ** 2, correlation * sigma_x * sigma_y, correlation * sigma_x * sigma_y];
  return { pose: { pose: pose(x, y, heading).pose, covariance } };
}

/** A track of rows of time, x, y, heading, and where there is a gun its yaw and pitch. */
export const trackOf = (rows: number[][]): Track => new Track({ time: rows.map(([t]) => t!), poses: rows.map(([, x, y, heading]) => [x!, y!, heading!]) },
  rows[0]?.length === 6 ? { time: rows.map(([t]) => t!), yaw: rows.map((row) => row[4]!), pitch: rows.map((row) => row[5]!) } : undefined);

/** Schemas of the messages that mcapOf() writes. */
export const schemas: Record<string, string> = {
  "geometry_msgs/msg/PointStamped": "std_msgs/Header header\ngeometry_msgs/Point point\n===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    + "===\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n===\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n",
  "outrider_msgs/msg/PaidCost": "float64 paid\n",
  "outrider_msgs/msg/Landmarks": "outrider_msgs/Landmark[] landmarks\n===\nMSG: outrider_msgs/Landmark\nint64 id\nstring name\nbool known\nfloat32[] ranges\n",
  "sensor_msgs/msg/LaserScan": "float32 angle_min\nfloat32 angle_increment\nfloat32 range_min\nfloat32 range_max\nfloat32[] ranges\n",
};

export interface Made { topic: string; type: string; t: number; message: unknown }

class Bytes implements IWritable {
  private parts: Uint8Array[] = [];
  private size = 0;
  write(bytes: Uint8Array): Promise<void> {
    this.parts.push(bytes.slice());
    this.size += bytes.length;
    return Promise.resolve();
  }
  position(): bigint { return BigInt(this.size); }
  get all(): Uint8Array<ArrayBuffer> {
    const all = new Uint8Array(this.size);
    let at = 0;
    for (const part of this.parts) { all.set(part, at); at += part.length; }
    return all;
  }
}

/** The bytes of an MCAP file with run.json. `chunked`: as a file; else as a live stream. */
export async function mcapOf(messages: Made[], { chunked = true, start = 0n, chunkSize = 512 } = {}): Promise<Uint8Array<ArrayBuffer>> {
  const out = new Bytes();
  const writer = new McapWriter({ writable: out, useChunks: chunked, chunkSize });
  await writer.start({ profile: "ros2", library: "test" });
  const channels = new Map<string, number>();
  for (const { topic, type, t, message } of messages) {
    const schema = schemas[type]!;
    if (!channels.has(topic)) {
      const schemaId = await writer.registerSchema({ name: type, encoding: "ros2msg", data: new TextEncoder().encode(schema) });
      channels.set(topic, await writer.registerChannel({ topic, schemaId, messageEncoding: "cdr", metadata: new Map() }));
    }
    const logTime = start + BigInt(Math.round(1e9 * t));
    const data = new MessageWriter(parse(schema, { ros2: true })).writeMessage(message);
    await writer.addMessage({ channelId: channels.get(topic)!, sequence: 0, logTime, publishTime: logTime, data });
  }
  const data = new TextEncoder().encode(JSON.stringify({ status: "done", job: "drive", world: "w", reason: "", metrics: { time_s: 3 }, rows: [{ a: 1 }], warnings: ["slow"] }));
  await writer.addAttachment({ logTime: 0n, createTime: 0n, name: "run.json", mediaType: "application/json", data });
  await writer.end();
  return out.all;
}
