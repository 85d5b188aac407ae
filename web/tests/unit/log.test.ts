// Reading: the same log as a file, as a stream cut at any byte, cut short, and read window by window.
import { McapIndexedReader } from "@mcap/core";
import { describe, expect, it, vi } from "vitest";
import { LiveLog } from "../../src/live/live_log";
import { Chunks } from "../../src/log/chunks";
import { decoderOf, decompressors } from "../../src/log/decode";
import { openLog } from "../../src/log/file";
import type { LaserScan, PaidCost } from "../../src/log/messages";
import { indexAt, RunLog, type Stamped } from "../../src/log/run_log";
import { LogStream } from "../../src/log/stream";
import { parseSummary } from "../../src/log/summary";
import { logOf, mcapOf, type Made } from "./made";

const paid = (t: number, value: number): Made => ({ topic: "/paid", type: "outrider_msgs/msg/PaidCost", t, message: { paid: value } });
const scan = (t: number): Made => ({ topic: "/scan", type: "sensor_msgs/msg/LaserScan", t,
  message: { angle_min: -1, angle_increment: 0.1, range_min: 0.1, range_max: 10, ranges: new Float32Array(40).fill(t) } });
const messages = Array.from({ length: 400 }, (_, i) => [paid(i / 10, i), scan(i / 10)]).flat();
const values = (all: readonly Stamped<PaidCost>[]): number[] => all.map(({ message }) => message.paid);
const count = Array.from({ length: 400 }, (_, i) => i);

/** Waits until something that is read in the background is there. */
const eventually = async <T>(get: () => T): Promise<T> => vi.waitFor(get, { timeout: 300_000 });
const arrived = async <T>(get: () => T | null): Promise<T> => eventually(() => {
  const found = get();
  if (found === null) throw new Error("not yet");
  return found;
});

describe("a file", () => {
  it("is read whole: messages by topic with their types, run.json, the end", async () => {
    const log = await openLog(new Blob([await mcapOf(messages)]));
    expect([...log.channels.values()].map(({ topic, type }) => [topic, type])).toEqual([["/paid", "outrider_msgs/msg/PaidCost"], ["/scan", "sensor_msgs/msg/LaserScan"]]);
    expect(values(log.messages("/paid"))).toEqual(count);
    expect(log.messages<LaserScan>("/scan")[7]!.message.ranges[3]).toBeCloseTo(0.7);
    expect([log.end, log.cut, log.isLazy("/scan")]).toEqual([39.9, false, false]);
    expect(log.summary).toMatchObject({ status: "done", metrics: { time_s: 3 }, warnings: ["slow"], tables: { rows: [{ a: 1 }] }, settings: {} });
    expect(log.messages("/nothing")).toEqual([]);
  });

  it("decodes messages in messages, lists, texts and whole numbers of 64 bits", async () => {
    const point = { header: { stamp: { sec: 3, nanosec: 5 }, frame_id: "map" }, point: { x: 1, y: 2, z: NaN } };
    const landmarks = { landmarks: [{ id: 9007199254740995n, name: "a post", known: true, ranges: Float32Array.of(1, 2) }, { id: -1n, name: "", known: false, ranges: new Float32Array() }] };
    const log = await openLog(new Blob([await mcapOf([{ topic: "/p", type: "geometry_msgs/msg/PointStamped", t: 0, message: point },
      { topic: "/l", type: "outrider_msgs/msg/Landmarks", t: 0, message: landmarks }])]));
    expect(log.latest("/p")).toEqual(point);
    expect(log.latest("/l")).toEqual(landmarks);
  });

  it("counts from its first message where its times count from 1970", async () => {
    const log = await openLog(new Blob([await mcapOf([paid(1, 1), paid(3, 2)], { start: 1_700_000_000_000_000_000n })]));
    expect(log.messages("/paid").map(({ t }) => t)).toEqual([0, 2]);
  });

  it("that was cut short is read to where it got", async () => {
    const bytes = await mcapOf(messages);
    for (const part of [0.2, 0.35, 0.5]) {
      const log = await openLog(new Blob([bytes.slice(0, part * bytes.length)]));
      const read = values(log.messages("/paid"));
      expect(log.cut).toBe(true);
      expect(log.summary).toBeNull();
      expect(read).toEqual(count.slice(0, read.length));
      expect(read.length).toBeGreaterThan(20);
    }
  });

  it("that is damaged is read to the damage", async () => {
    const bytes = await mcapOf(messages);
    bytes.fill(0xff, bytes.length * 0.6);
    const log = await openLog(new Blob([bytes]));
    expect(log.cut).toBe(true);
    expect(log.messages("/paid").length).toBeGreaterThan(100);
  });

  it("that is no log is refused with a sentence; an old report is told from anything else", async () => {
    await expect(openLog(new Blob(['{\n "outrider_report": 1, "status": "done"}']))).rejects.toThrow(/report of an older version; run the job again with --out DIR, which leaves DIR\/run\.mcap/);
    await expect(openLog(new Blob(['{\n "status": "done"}']))).rejects.toThrow(/no log of a run; a run with --out DIR leaves its log as DIR\/run\.mcap/);
    await expect(openLog(new Blob(["hello"]))).rejects.toThrow(/no log of a run/);
    await expect(openLog(new Blob([]))).rejects.toThrow(/no log of a run/);
  });
});

describe("a large file", () => {
  const open = async (): Promise<RunLog> => openLog(new Blob([await mcapOf(messages)]), 1000);

  it("has light topics whole and heavy ones when they are asked for", async () => {
    const log = await open();
    const changed = vi.fn();
    log.changed = changed;
    expect([log.isLazy("/scan"), log.isLazy("/paid"), log.has("/scan"), log.end]).toEqual([true, false, true, 39.9]);
    await eventually(() => expect(log.messages("/paid").length).toBe(400));
    expect(log.messages("/scan")).toEqual([]);
    expect(log.at("/scan", 20.05)).toBeNull();
    const one = await arrived(() => log.at<LaserScan>("/scan", 20.05));
    expect(changed).toHaveBeenCalledWith(false);
    expect(one!.t).toBe(20);
    expect(one!.message.ranges[0]).toBe(20);
    expect(log.summary!.status).toBe("done");
  });

  it("that fits in memory has its scans alone read when they are asked for; only the parts that are read are moved", async () => {
    const bytes = new Uint8Array(await mcapOf(messages));
    let moved = 0;
    const remote = { size: bytes.length, whole: () => Promise.resolve(new Blob([bytes])), read: (from: number, to: number) => {
      moved += to - from;
      return Promise.resolve(bytes.slice(from, to));
    } };
    const log = await openLog(remote, 1e9, 1000);
    expect([log.isLazy("/scan"), log.isLazy("/paid")]).toEqual([true, false]);
    const before = moved;
    expect(before).toBeGreaterThan(0);
    expect((await arrived(() => log.at<LaserScan>("/scan", 20.05)))!.t).toBe(20);
    await eventually(() => expect(log.messages("/paid").length).toBe(400));
    expect(log.file).toBe(remote);
  });

  it("gives the same windows as a file in memory", async () => {
    const [lazy, whole] = [await open(), await openLog(new Blob([await mcapOf(messages)]))];
    for (const [from, to] of [[0, 0], [-1, 1], [3.05, 3.95], [5, 20], [12.8, 12.8], [39, 99], [50, 60]] as const) {
      const part = lazy.window("/scan", from, to);
      expect(part.until).toBeLessThanOrEqual(to);
      const [a, b] = [await arrived(() => { const span = lazy.window("/scan", from, to); return span.until === to ? span : null; }), whole.window("/scan", from, to)];
      expect(a.messages.map(({ t }) => t)).toEqual(b.messages.map(({ t }) => t));
      expect(part.messages.every(({ t }) => t <= part.until)).toBe(true);
    }
    for (const t of [-1, 0, 6.4, 6.39, 33.33, 99]) expect((await arrived(() => lazy.at("/scan", t)))?.t).toBe((whole.at("/scan", t))?.t);
  });

  it("may have chunks that overlap in time, and chunks without the topic", async () => {
    const order = Array.from({ length: 300 }, (_, i) => (7 * i) % 300);  // each chunk has messages from everywhere
    const late = Array.from({ length: 100 }, (_, i) => paid(30 + i / 10, i));
    const bytes = await mcapOf([...order.slice(0, 150).map((i) => scan(i / 10)), ...late, ...order.slice(150).map((i) => scan(i / 10))]);
    const [lazy, whole] = [await openLog(new Blob([bytes]), 1000), await openLog(new Blob([bytes]))];
    expect([lazy.isLazy("/scan"), whole.isLazy("/scan")]).toEqual([true, false]);
    for (const t of [-1, 0, 3.33, 14.2, 29.9, 35]) {
      const found = await arrived(() => lazy.at<LaserScan>("/scan", t));
      expect(found?.t).toBe(whole.at("/scan", t)?.t);
      if (found) expect(found.message.ranges[0]).toBeCloseTo(found.t);
    }
    const span = await arrived(() => { const one = lazy.window("/scan", 3, 17); return one.until === 17 ? one : null; });
    expect(span.messages.map(({ t }) => t)).toEqual(whole.window("/scan", 3, 17).messages.map(({ t }) => t));
  });

  it("is moved one chunk at a time, and lets go of chunks that were not asked for of late", async () => {
    const bytes = new Uint8Array(await mcapOf(messages));
    const reads: [number, number][] = [];
    const remote = { size: bytes.length, whole: () => Promise.resolve(new Blob([bytes])), read: (from: number, to: number) => {
      reads.push([from, to]);
      return Promise.resolve(bytes.slice(from, to));
    } };
    const index = await McapIndexedReader.Initialize({ decompressHandlers: decompressors, readable: {
      size: () => Promise.resolve(BigInt(bytes.length)), read: (offset, size) => Promise.resolve(bytes.slice(Number(offset), Number(offset + size))) } });
    const { id, schemaId, messageEncoding } = [...index.channelsById.values()].find(({ topic }) => topic === "/scan")!;
    const decode = decoderOf(messageEncoding, index.schemasById.get(schemaId))!;
    const chunks = new Chunks(index.chunkIndexes, new Map([["/scan", { id, decode }]]), remote, 0n, () => undefined, 3000);
    expect(index.chunkIndexes.length).toBeGreaterThan(20);
    const ask = async (t: number): Promise<number> => {
      const before = reads.length;
      expect((await arrived(() => chunks.at("/scan", t)))!.t).toBeCloseTo(t);
      return reads.length - before;
    };
    expect(await ask(20)).toBe(1);
    expect(await ask(20)).toBe(0);
    for (let t = 1; t < 39; ++t) await ask(t);
    expect(await ask(38)).toBe(0);
    expect(await ask(20)).toBe(1);
  });
});

describe("a stream", () => {
  it("is the same log wherever it is cut", async () => {
    const bytes = await mcapOf(messages.slice(0, 60), { chunked: false });
    const whole = await openLog(new Blob([bytes]));
    for (const step of [1, 7, 64, 1000, bytes.length]) {
      const stream = new LogStream(new RunLog());
      for (let at = 0; at < bytes.length; at += step) stream.feed(bytes.subarray(at, at + step));
      expect(stream.done).toBe(true);
      expect(stream.log.messages("/paid")).toEqual(whole.messages("/paid"));
      expect(stream.log.messages("/scan")).toEqual(whole.messages("/scan"));
      expect(stream.log.summary).toEqual(whole.summary);
    }
    expect(whole.cut).toBe(false);
  });

  it("has messages as soon as they are whole", async () => {
    const bytes = await mcapOf(messages.slice(0, 60), { chunked: false });
    const stream = new LogStream(new RunLog());
    let before = 0;
    for (let at = 0; at < bytes.length; at += 100) {
      stream.feed(bytes.subarray(at, at + 100));
      const now = stream.log.messages("/paid").length;
      expect(now).toBeGreaterThanOrEqual(before);
      before = now;
    }
    expect(before).toBe(30);
  });

  it("that is no MCAP throws", () => {
    expect(() => new LogStream(new RunLog()).feed(new TextEncoder().encode("hello, this is not a log at all"))).toThrow();
  });
});

describe("the log", () => {
  const log = logOf({ "/a": [[3, "c"], [1, "a"], [2, "b"], [2, "b2"]] });

  it("is in the order of time; of one time, in which messages came", () => {
    expect(log.messages("/a").map(({ message }) => message)).toEqual(["a", "b", "b2", "c"]);
  });
  it("has the latest message at a time", () => {
    expect([0.9, 1, 1.9, 2, 3, 99].map((t) => log.latest("/a", t))).toEqual([undefined, "a", "a", "b2", "c", "c"]);
    expect(log.latest("/a")).toBe("c");
    expect(log.window("/a", 1, 2).messages.map(({ message }) => message)).toEqual(["b", "b2"]);
  });
  it("finds messages as a search from the front does", () => {
    const times = [0, 0, 0.5, 2, 2, 3].map((t) => ({ t }));
    for (let t = -1; t < 4; t += 0.25) expect(indexAt(times, t)).toBe(times.findLastIndex((one) => one.t <= t));
  });
  it("takes a run.json of which much is missing, and none of nonsense", () => {
    expect(parseSummary("{}")).toMatchObject({ status: "", metrics: {}, tables: {} });
    expect(parseSummary("[")).toBeNull();
    expect(parseSummary("null")).toBeNull();
  });
});

describe("the log of a run that goes on", () => {
  const bytes = mcapOf(Array.from({ length: 30 }, (_, t) => paid(t, t)), { chunked: false });
  const feed = (live: LiveLog, part: Uint8Array): void => { for (let at = 0; at < part.length; at += 333) live.feed(part.subarray(at, at + 333)); };
  const seenOf = (live: LiveLog): number => live.log.messages("/paid").length;

  it("is in the end the log of the file", async () => {
    const live = new LiveLog();
    live.restart();
    feed(live, await bytes);
    expect([seenOf(live), live.complete, live.log.summary!.status]).toEqual([30, true, "done"]);
    expect(live.log.messages("/paid")).toEqual((await openLog(new Blob([await bytes]))).messages("/paid"));
  });

  it("does not go back when the connection broke and the log comes again", async () => {
    const all = await bytes;
    const live = new LiveLog();
    live.restart();
    feed(live, all.subarray(0, Math.floor(0.4 * all.length)));
    const seen = seenOf(live);
    expect(seen).toBeGreaterThan(3);
    live.restart();
    feed(live, all.subarray(0, Math.floor(0.2 * all.length)));
    expect([seenOf(live), live.complete]).toEqual([seen, false]);
    feed(live, all.subarray(Math.floor(0.2 * all.length)));
    expect(seenOf(live)).toBe(30);
    expect(live.complete).toBe(true);
  });
});
