// Real logs: every message of every run.mcap below OUTRIDER_LOGS decodes, and schemas of ROS messages are those of ROS.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { McapIndexedReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { ros2humble } from "@foxglove/rosmsg-msgs-common";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { describe, expect, it, vi } from "vitest";
import { decompressors } from "../../src/log/decode";
import { openLog } from "../../src/log/file";
import { Run } from "../../src/log/run";
import { seriesOf } from "../../src/watch/series";

vi.hoisted(() => { (globalThis as { matchMedia?: unknown }).matchMedia = () => ({ matches: false, addEventListener: () => undefined }); });

const folder = process.env.OUTRIDER_LOGS ?? "";
const files = folder ? readdirSync(folder, { recursive: true, encoding: "utf8" }).filter((name) => name.endsWith("run.mcap")).sort() : [];

/** Fields of a definition without what has no meaning: comments, defaults written in another way. */
const fieldsOf = (text: string, name: string) => parse(text, { ros2: true })
  .map(({ name: of, definitions }) => ({ of: of ?? name, fields: definitions.map(({ name: field, type, isArray, arrayLength, isConstant, value, isComplex }) =>
    ({ field, type, isArray: isArray ?? false, arrayLength, isConstant: isConstant ?? false, value, isComplex: isComplex ?? false })) }));

type Standard = Record<string, { definitions: { name?: string; type: string; isArray?: boolean; arrayLength?: number; isComplex?: boolean; isConstant?: boolean; value?: unknown }[] }>;
const standard = ros2humble as unknown as Standard;
const shortName = (name: string): string => name.replace("/msg/", "/");

async function readerOf(file: string): Promise<McapIndexedReader> {
  const bytes = readFileSync(join(folder, file));
  return McapIndexedReader.Initialize({ decompressHandlers: decompressors, readable: {
    size: () => Promise.resolve(BigInt(bytes.length)),
    read: (offset, size) => Promise.resolve(new Uint8Array(bytes.subarray(Number(offset), Number(offset + size)))) } });
}

describe.skipIf(files.length === 0).each(files.length > 0 ? files : ["OUTRIDER_LOGS names no folder"])("%s", { timeout: 60_000 }, (file) => {
  it("decodes whole, in the order of its statistics", async () => {
    const reader = await readerOf(file);
    const readers = new Map([...reader.schemasById].map(([id, { data }]) => [id, new MessageReader(parse(new TextDecoder().decode(data), { ros2: true }))]));
    let count = 0n;
    for await (const { channelId, data } of reader.readMessages({ validateCrcs: true })) {
      const { topic, schemaId } = reader.channelsById.get(channelId)!;
      const one = readers.get(schemaId)!;
      one.readMessage(data);
      if (data.byteLength - one.lastReadByteLength() > 3) throw new Error(`${topic}: ${data.byteLength - one.lastReadByteLength()} bytes are left over`);
      count += 1n;
    }
    expect(count).toBe(reader.statistics!.messageCount);
    const names = [];
    for await (const { name, data } of reader.readAttachments({ validateCrcs: true })) {
      names.push(name);
      expect(JSON.parse(new TextDecoder().decode(data))).toHaveProperty("status");
    }
    expect(names).toEqual(["run.json"]);
  });

  it("has schemas of ROS messages as ROS has them", async () => {
    const reader = await readerOf(file);
    for (const { name, data } of reader.schemasById.values()) {
      for (const { of, fields } of fieldsOf(new TextDecoder().decode(data), name)) {
        const known = standard[shortName(of)];
        if (!known) continue;
        const plain = fields.map(({ field, type, isArray, arrayLength, isConstant }) => [field, shortName(type), isArray, arrayLength, isConstant]);
        const wanted = known.definitions.map((one) => [one.name, shortName(one.type), one.isArray ?? false, one.arrayLength, one.isConstant ?? false]);
        expect(plain, of).toEqual(wanted);
      }
    }
  });

  it("opens on the page with a path and plots", async () => {
    const log = await openLog(new Blob([readFileSync(join(folder, file))]));
    const run = new Run(log);
    expect(log.cut).toBe(false);
    expect(log.summary?.status).toBeTruthy();
    expect(run.track.length).toBeGreaterThan(0);
    for (const { time, lines } of seriesOf(run)) for (const { values } of lines) expect(values.length).toBe(time.length);
  });
});
