// The heavy topics of a large file. Their messages are read chunk by chunk, when they are first asked for; chunks that
// were not asked for of late are let go.
import { messagesOf, type ChunkIndex } from "./chunk";
import type { Decode } from "./decode";
import { indexAt, type Span, type Stamped } from "./run_log";
import type { Source } from "./source";

/** A heavy topic: the number of its channel in the file, and its decoder. */
export interface HeavyTopic { id: number; decode: Decode }

const fewestHeld = 4;
const askedAhead = 16;  // chunks that are asked for together where several are needed

/** A message that is decoded when it is first looked at. */
class Waiting implements Stamped<unknown> {
  private decoded: unknown = undefined;
  constructor(readonly t: number, private bytes: Uint8Array | null, private decode: Decode) {}

  get message(): unknown {
    if (this.bytes) this.decoded = this.decode(this.bytes.slice());
    this.bytes = null;
    return this.decoded;
  }
}

/** A chunk with messages of a topic, by its first and last time, s; and the last time of it and of all before it. */
interface Part { chunk: ChunkIndex; from: number; to: number; end: number }

/** Returns how many of the first parts pass a test that none passes after one that does not. O(log n). */
function countOf(parts: readonly Part[], passes: (part: Part) => boolean): number {
  let [low, high] = [0, parts.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (passes(parts[middle]!)) low = middle + 1;
    else high = middle;
  }
  return low;
}

export class Chunks {
  private parts = new Map<string, Part[]>();  // by topic, in the order of their first times
  private topics = new Map<number, { topic: string; decode: Decode }>();
  private read = new Map<ChunkIndex, Map<string, Stamped<unknown>[]> | null>();  // null: being read
  private bytes = 0;

  /** `origin` is the time of the log that counts as 0, ns. `arrived` is called after each chunk that was read. At most
   *  `mostBytes` of chunks are held, but a few of any size. */
  constructor(chunks: readonly ChunkIndex[], heavy: ReadonlyMap<string, HeavyTopic>, private source: Source, private origin: bigint,
    private arrived: () => void, private mostBytes = 64 << 20) {
    const sorted = chunks.map((chunk) => ({ chunk, from: this.seconds(chunk.messageStartTime), to: this.seconds(chunk.messageEndTime) }))
      .sort((a, b) => a.from - b.from);
    for (const [topic, { id, decode }] of heavy) {
      this.topics.set(id, { topic, decode });
      let end = -Infinity;
      this.parts.set(topic, sorted.filter(({ chunk }) => chunk.messageIndexOffsets.has(id))
        .map((part) => ({ ...part, end: (end = Math.max(end, part.to)) })));
    }
  }

  has(topic: string): boolean { return this.parts.has(topic); }

  /** The latest message not after t; undefined before the first, null while it is being read. */
  at(topic: string, t: number): Stamped<unknown> | undefined | null {
    let best: Stamped<unknown> | undefined;
    const parts = this.parts.get(topic)!;
    for (let i = countOf(parts, ({ from }) => from <= t) - 1; i >= 0 && (!best || parts[i]!.end > best.t); --i) {
      if (best && parts[i]!.to <= best.t) continue;
      const all = this.messages(topic, parts[i]!);
      if (!all) {
        this.ask(topic, parts.slice(Math.max(0, i - askedAhead), i).filter(({ to }) => to >= t));
        return null;
      }
      const found = all[indexAt(all, t)];
      if (found && (!best || found.t > best.t)) best = found;
    }
    return best;
  }

  /** Messages after `from` and not after `to`, up to the first chunk that is not read yet. */
  between(topic: string, from: number, to: number): Span<unknown> {
    const messages: Stamped<unknown>[] = [];
    let until = to;
    const parts = this.parts.get(topic)!;
    for (let i = countOf(parts, ({ end }) => end <= from); i < parts.length && parts[i]!.from <= to; ++i) {
      const part = parts[i]!;
      const all = this.messages(topic, part);
      if (!all) {
        until = Math.max(from, part.from - 1e-9);
        this.ask(topic, parts.slice(i + 1, i + askedAhead).filter((next) => next.from <= to));
        break;
      }
      messages.push(...all.slice(indexAt(all, from) + 1, indexAt(all, to) + 1));
    }
    return { messages: messages.filter(({ t }) => t <= until).sort((a, b) => a.t - b.t), until };
  }

  private ask(topic: string, parts: readonly Part[]): void {
    for (const part of parts) this.messages(topic, part);
  }

  private seconds(time: bigint): number { return Number(time - this.origin) / 1e9; }

  private messages(topic: string, { chunk }: Part): Stamped<unknown>[] | null {
    const known = this.read.get(chunk);
    if (known === undefined) {
      this.read.set(chunk, null);
      void this.load(chunk);
    }
    if (!known) return null;
    this.read.delete(chunk);  // asked for last
    this.read.set(chunk, known);
    return known.get(topic) ?? [];
  }

  private async load(chunk: ChunkIndex): Promise<void> {
    const found = new Map<string, Stamped<unknown>[]>();
    const start = Number(chunk.chunkStartOffset);
    const bytes = await this.source.read(start, start + Number(chunk.chunkLength)).catch(() => null);
    if (!bytes) {
      this.read.delete(chunk);  // the server does not answer: it is asked for again with the next frame
      return;
    }
    try {
      for (const { id, time, data } of messagesOf(bytes)) {
        const known = this.topics.get(id);
        if (!known) continue;
        const all = found.get(known.topic) ?? found.set(known.topic, []).get(known.topic)!;
        all.push(new Waiting(this.seconds(time), data, known.decode));
      }
    } catch {
      // The chunk is damaged; what came before the damage is shown.
    }
    for (const all of found.values()) all.sort((a, b) => a.t - b.t);
    this.read.set(chunk, found);
    this.bytes += Number(chunk.uncompressedSize);
    this.letGo();
    this.arrived();
  }

  private letGo(): void {
    for (const [chunk, held] of this.read) {
      if (this.bytes <= this.mostBytes || this.read.size <= fewestHeld) return;
      if (!held) continue;
      this.read.delete(chunk);
      this.bytes -= Number(chunk.uncompressedSize);
    }
  }
}
