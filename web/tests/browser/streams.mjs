// Logs for tests: a log of the tool as the byte stream of a live run, and logs of 10 minutes at 20 Hz.
import { McapIndexedReader, McapRecordBuilder, McapWriter } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";
import { decompress } from "fzstd";

/** Returns the content of a log: its channels, its messages in the order of time, run.json. */
export async function contentsOf(bytes) {
  const reader = await McapIndexedReader.Initialize({ decompressHandlers: { zstd: (data, size) => decompress(data, new Uint8Array(Number(size))) }, readable: {
    size: async () => BigInt(bytes.length), read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))) } });
  const channels = new Map([...reader.channelsById.values()].map((one) => [one.topic, { ...one, schema: reader.schemasById.get(one.schemaId) }]));
  const messages = [];
  for await (const { channelId, logTime, data } of reader.readMessages()) messages.push({ topic: reader.channelsById.get(channelId).topic, t: Number(logTime) / 1e9, data: data.slice() });
  const files = [];
  for await (const { data } of reader.readAttachments({ name: "run.json" })) files.push(JSON.parse(new TextDecoder().decode(data)));
  return { channels, messages, result: files[0] };
}

const definition = (schema) => parse(new TextDecoder().decode(schema.data), { ros2: true });
const resultOf = ({ result }) => ({ logTime: 0n, createTime: 0n, name: "run.json", mediaType: "application/json", data: new TextEncoder().encode(JSON.stringify(result)) });
const stampedAs = (channelId, { t, data }) => ({ channelId, sequence: 0, logTime: BigInt(Math.round(1e9 * t)), publishTime: BigInt(Math.round(1e9 * t)), data });

/** A log as a live run sends it: records without chunks, one after another. */
export class Stream {
  constructor(contents) {
    this.contents = contents;
    this.ids = new Map();
    this.records = new McapRecordBuilder();
    this.records.writeMagic();
    this.records.writeHeader({ profile: "ros2", library: "test" });
  }

  add(message) {
    const { records, ids } = this;
    if (!ids.has(message.topic)) {
      const id = ids.size + 1;
      const { schema, topic, messageEncoding, metadata } = this.contents.channels.get(message.topic);
      records.writeSchema({ ...schema, id });
      records.writeChannel({ id, schemaId: id, topic, messageEncoding, metadata });
      ids.set(topic, id);
    }
    records.writeMessage(stampedAs(ids.get(message.topic), message));
  }

  end() {
    this.records.writeAttachment(resultOf(this.contents));
    this.records.writeDataEnd({ dataSectionCrc: 0 });
    this.records.writeFooter({ summaryStart: 0n, summaryOffsetStart: 0n, summaryCrc: 0 });
    this.records.writeMagic();
  }

  /** The bytes since they were taken last. */
  take() {
    const bytes = this.records.buffer.slice();
    this.records.reset();
    return bytes;
  }
}

/** The bytes of a log as a file. */
export async function fileOf(contents) {
  const parts = [];
  let size = 0;
  const writer = new McapWriter({ writable: { position: () => BigInt(size), write: async (bytes) => { size += bytes.length; parts.push(bytes.slice()); } } });
  await writer.start({ profile: "ros2", library: "test" });
  const ids = new Map();
  for (const [topic, { schema, messageEncoding, metadata }] of contents.channels) {
    ids.set(topic, await writer.registerChannel({ topic, messageEncoding, metadata, schemaId: await writer.registerSchema(schema) }));
  }
  for (const message of contents.messages) await writer.addMessage(stampedAs(ids.get(message.topic), message));
  await writer.addAttachment(resultOf(contents));
  await writer.end();
  return Buffer.concat(parts);
}

/** 10 minutes at 20 Hz of poses, in the world of a log, with an event a second; with what the robot believed instead of targets where it `believes`. */
export function longLog(contents, believes) {
  const { channels } = contents;
  const types = { "/belief": "geometry_msgs/msg/PoseWithCovarianceStamped" };
  const text = new TextEncoder();
  const stamped = new TextDecoder().decode(channels.get("/pose").schema.data);
  const covariance = "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n" + "=".repeat(80) + "\nMSG: geometry_msgs/PoseWithCovariance\ngeometry_msgs/Pose pose\nfloat64[36] covariance\n"
    + stamped.slice(stamped.indexOf("=".repeat(10)));
  const all = { ...contents, channels: new Map(channels).set("/belief", { ...channels.get("/pose"), schema: { name: types["/belief"], encoding: "ros2msg", data: text.encode(covariance) } }) };
  const moving = ["/pose", "/tf", "/joint_states", "/rosout", ...(believes ? ["/shots", "/targets", "/target_positions"] : [])];
  const still = contents.messages.filter(({ topic }) => !moving.includes(topic));
  const pose = (i, off = 0) => ({ position: { x: 8 * Math.sin(i / 800) + off, y: 5 * Math.sin(i / 460), z: 0 }, orientation: { x: 0, y: 0, z: Math.sin(i / 1200), w: Math.cos(i / 1200) } });
  const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: "map" };
  const spread = Array.from({ length: 36 }, (_, k) => (k === 0 ? 9e-4 : k === 7 ? 4e-4 : 0));
  const rows = Array.from({ length: 12001 }, (_, i) => [
    { topic: "/pose", t: i / 20, message: { header, pose: pose(i) } },
    ...(i % 20 === 0 ? [{ topic: "/rosout", t: i / 20, message: { stamp: header.stamp, level: 20, name: "wait", msg: `waits for the ${i / 20}th time`, file: "", function: "", line: 0 } }] : []),
    ...(believes ? [{ topic: "/belief", t: i / 20, message: { header, pose: { pose: pose(i, 0.02 * Math.sin(i / 90)), covariance: spread } } }] : [])]).flat();
  const writers = new Map([...new Set(rows.map(({ topic }) => topic))].map((topic) => [topic, new MessageWriter(definition(all.channels.get(topic).schema))]));
  const made = rows.map(({ topic, t, message }) => ({ topic, t, data: writers.get(topic).writeMessage(message) }));
  return { ...all, messages: [...still, ...made].sort((a, b) => a.t - b.t) };
}
