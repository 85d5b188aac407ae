// A run as a file: a small one is read whole before it is shown. In a larger one the scans are read when they are shown,
// in one that does not fit in memory all heavy topics, and all others in the background. A log that was cut short has no index, so it is read to where it got.
import { McapIndexedReader, type McapTypes } from "@mcap/core";
import { messagesOf, type ChunkIndex } from "./chunk";
import { Chunks, type HeavyTopic } from "./chunks";
import { decoderOf, decompressors } from "./decode";
import { RunLog, type Channel } from "./run_log";
import { sourceOf, type Source } from "./source";
import { LogStream, originOf } from "./stream";
import { parseSummary } from "./summary";
import { heavyTypes, scanTypes, unread } from "./topics";

/** Decompressed size up to which a file is read before it is shown, and up to which all but its scans are kept in memory. */
export const mostAtOnce = 24 << 20;
export const mostInMemory = 256 << 20;
const pieceBytes = 4 << 20;
const mostBetween = 64 << 10;  // bytes of other things that are read along with chunks around them
const patience_ms = 40;  // for which the page stands still while a large file is read
const magic = [0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a];

const readable = (source: Source): McapTypes.IReadable => ({
  size: () => Promise.resolve(BigInt(source.size)),
  read: (offset, size) => source.read(Number(offset), Number(offset + size)),
});

/** Why a file is no log, as a sentence; null when it begins as one. */
async function faultOf(source: Source): Promise<string | null> {
  const head = await source.read(0, Math.min(64, source.size));
  if (magic.every((byte, i) => head[i] === byte)) return null;
  const start = new TextDecoder().decode(head).trimStart();
  if (/^\{\s*"outrider_report"/.test(start)) {
    return "this is a report of an older version; run the job again with --out DIR, which leaves DIR/run.mcap";
  }
  return "this is no log of a run; a run with --out DIR leaves its log as DIR/run.mcap";
}

/** Opens a log. Throws a sentence where the file is none. */
export async function openLog(file: Blob | Source, inMemory = mostInMemory, atOnce = Math.min(mostAtOnce, inMemory)): Promise<RunLog> {
  const source = file instanceof Blob ? sourceOf(file) : file;
  const fault = await faultOf(source);
  if (fault) throw new Error(fault);
  const index = await McapIndexedReader.Initialize({ readable: readable(source), decompressHandlers: decompressors, messageIndexCacheSizeBytes: 32 << 20 })
    .catch(() => null);
  const bytes = index?.chunkIndexes.reduce((sum, chunk) => sum + Number(chunk.uncompressedSize), 0) ?? 0;
  const log = index && bytes > atOnce ? await openLarge(source, index, bytes > inMemory ? heavyTypes : scanTypes) : await readWhole(source);
  log.file = source;
  return log;
}

async function readWhole(source: Source): Promise<RunLog> {
  const log = new RunLog();
  const stream = new LogStream(log);
  try {
    for (let at = 0; at < source.size && !stream.done; at += pieceBytes) {
      stream.feed(await source.read(at, Math.min(at + pieceBytes, source.size)));
    }
  } catch (error) {
    if (log.channels.size === 0) throw error;  // else it holds up to where it is damaged
  }
  log.cut = !stream.done;
  return log;
}

const pause = (): Promise<void> => new Promise((done) => setTimeout(done, 0));

async function openLarge(source: Source, index: McapIndexedReader, lazyTypes: ReadonlySet<string>): Promise<RunLog> {
  const log = new RunLog();
  const { statistics } = index;
  const origin = originOf(statistics?.messageStartTime ?? 0n);
  log.ahead = Number((statistics?.messageEndTime ?? origin) - origin) / 1e9;
  const heavy = new Map<string, HeavyTopic>();
  const light = new Map<number, Channel>();
  for (const { id, topic, schemaId, messageEncoding } of index.channelsById.values()) {
    const schema = index.schemasById.get(schemaId);
    const decode = decoderOf(messageEncoding, schema);
    const channel = log.addChannel(topic, schema?.name ?? "", decode);
    if (unread.has(topic)) continue;
    if (!lazyTypes.has(schema?.name ?? "")) light.set(id, channel);
    else if (decode) heavy.set(topic, { id, decode });
  }
  for await (const { data } of index.readAttachments({ name: "run.json" })) log.summary = parseSummary(new TextDecoder().decode(data));
  log.readLazily(new Chunks(index.chunkIndexes, heavy, source, origin, () => log.changed(false)));
  await new Promise<void>((opened) => void readLight(source, index.chunkIndexes, log, light, origin, opened));
  return log;
}

/** Chunks that lie beside each other in the file, together no longer than a piece unless one alone is. */
function piecesOf(chunks: readonly ChunkIndex[]): { from: number; to: number; chunks: ChunkIndex[] }[] {
  const pieces: { from: number; to: number; chunks: ChunkIndex[] }[] = [];
  for (const chunk of [...chunks].sort((a, b) => Number(a.chunkStartOffset - b.chunkStartOffset))) {
    const from = Number(chunk.chunkStartOffset);
    const to = from + Number(chunk.chunkLength);
    const last = pieces.at(-1);
    if (last && from - last.to <= mostBetween && to - last.from <= pieceBytes) {
      last.to = to;
      last.chunks.push(chunk);
    } else {
      pieces.push({ from, to, chunks: [chunk] });
    }
  }
  return pieces;
}

/** Reads the light topics piece by piece; calls `opened` and `log.changed` now and then. */
async function readLight(source: Source, chunks: readonly ChunkIndex[], log: RunLog, light: ReadonlyMap<number, Channel>, origin: bigint, opened: () => void): Promise<void> {
  const ids = [...light.keys()];
  const wanted = chunks.filter(({ messageIndexOffsets }) => ids.some((id) => messageIndexOffsets.has(id)));
  let since = performance.now();
  try {
    for (const piece of piecesOf(wanted)) {
      const bytes = await source.read(piece.from, piece.to);
      for (const { chunkStartOffset, chunkLength } of piece.chunks) {
        const start = Number(chunkStartOffset) - piece.from;
        for (const { id, time, data } of messagesOf(bytes.subarray(start, start + Number(chunkLength)))) {
          light.get(id)?.append(Number(time - origin) / 1e9, data.slice());
        }
        if (performance.now() - since < patience_ms) continue;
        opened();
        log.changed(true);
        await pause();
        since = performance.now();
      }
    }
  } catch {
    log.cut = true;  // it is damaged; what came before is shown
  }
  opened();
  log.changed(true);
}
