// Windows of time of the heavy topics of a large file. A window is read by the index of the file when it is first
// asked for; those that were not asked for of late are let go.
import type { McapIndexedReader } from "@mcap/core";
import type { Decode } from "./decode";
import { indexAt, type Span, type Stamped } from "./run_log";

const messagesInWindow = 64;
const mostWindows = 48;

/** A heavy topic: its decoder, and the length of its windows, s. */
export interface HeavyTopic { decode: Decode; length: number }

/** A window long enough for some messages of a topic with so many. */
export const windowLength = (count: number, duration: number): number =>
  Math.max(0.5, (duration * messagesInWindow) / Math.max(1, count));

export class Windows {
  private read = new Map<string, Stamped<unknown>[] | null>();  // null: being read

  /** `origin` is the time of the log that counts as 0, ns. `arrived` is called after each window that was read. */
  constructor(private reader: McapIndexedReader, private topics: Map<string, HeavyTopic>, private origin: bigint, private arrived: () => void) {}

  has(topic: string): boolean { return this.topics.has(topic); }

  /** The latest message not after t; undefined before the first, null while it is being read. */
  at(topic: string, t: number): Stamped<unknown> | undefined | null {
    const { length } = this.topics.get(topic)!;
    for (let index = Math.floor(Math.max(0, t) / length); index >= 0; --index) {
      const all = this.window(topic, index);
      if (!all) return null;
      const found = all[indexAt(all, t)];
      if (found) return found;
    }
    return undefined;
  }

  /** Messages after `from` and not after `to`, up to the first window that is not read yet. */
  between(topic: string, from: number, to: number): Span<unknown> {
    const { length } = this.topics.get(topic)!;
    const messages: Stamped<unknown>[] = [];
    for (let index = Math.floor(Math.max(0, from) / length); index * length <= to; ++index) {
      const all = this.window(topic, index);
      if (!all) return { messages, until: Math.max(from, index * length - 1e-9) };
      messages.push(...all.slice(indexAt(all, from) + 1, indexAt(all, to) + 1));
    }
    return { messages, until: to };
  }

  private window(topic: string, index: number): Stamped<unknown>[] | null {
    const key = `${index} ${topic}`;
    const known = this.read.get(key);
    if (known === undefined) {
      this.read.set(key, null);
      void this.load(key, topic, index);
      return null;
    }
    this.read.delete(key);  // asked for last
    this.read.set(key, known);
    return known;
  }

  private async load(key: string, topic: string, index: number): Promise<void> {
    const { decode, length } = this.topics.get(topic)!;
    const ns = (seconds: number): bigint => this.origin + BigInt(Math.round(1e9 * seconds));
    const found: Stamped<unknown>[] = [];
    const [startTime, endTime] = [ns(index * length), ns((index + 1) * length) - 1n];
    for await (const message of this.reader.readMessages({ topics: [topic], startTime, endTime, validateCrcs: false })) {
      found.push({ t: Number(message.logTime - this.origin) / 1e9, message: decode(message.data.slice()) });
    }
    this.read.set(key, found);
    for (const [old, held] of this.read) {
      if (this.read.size <= mostWindows) break;
      if (held) this.read.delete(old);
    }
    this.arrived();
  }
}
