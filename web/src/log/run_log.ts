// RunLog: the messages of a run by their topics, in the order of time. It only grows. A file, a live connection and
// the one-file page all fill it (file.ts, stream.ts).
import type { Chunks } from "./chunks";
import type { Decode } from "./decode";
import type { Source } from "./source";
import type { Summary } from "./summary";
import { unread } from "./topics";

export interface Stamped<T> { t: number; message: T }
/** The messages of a span of time, as far as it has been read. */
export interface Span<T> { messages: readonly Stamped<T>[]; until: number }

/** Index of the last message that is not after t; -1 before the first. O(log n). */
export function indexAt(messages: readonly { t: number }[], t: number): number {
  let low = 0;
  let high = messages.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (messages[middle]!.t <= t) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** The messages of one topic. Each is decoded when the topic is first asked for. */
export class Channel {
  private decoded: Stamped<unknown>[] = [];
  private waiting: { t: number; bytes: Uint8Array }[] = [];
  /** Time of the latest message, s. */
  end = 0;

  constructor(readonly topic: string, readonly type: string, private decode: Decode | null) {}

  get count(): number { return this.decoded.length + this.waiting.length; }

  append(t: number, bytes: Uint8Array): void {
    if (this.decode) this.waiting.push({ t, bytes });
    this.end = Math.max(this.end, t);
  }

  /** One of its messages, of which only that is decoded. */
  get sample(): unknown { return this.decoded[0]?.message ?? (this.waiting[0] && this.decode?.(this.waiting[0].bytes)); }

  /** In the order of time; of one time, in the order in which they came. */
  get messages(): readonly Stamped<unknown>[] {
    for (const { t, bytes } of this.waiting) {
      const one = { t, message: this.decode!(bytes) };
      const last = this.decoded.at(-1);
      if (last && last.t > t) this.decoded.splice(indexAt(this.decoded, t) + 1, 0, one);
      else this.decoded.push(one);
    }
    this.waiting = [];
    return this.decoded;
  }
}

const none: readonly never[] = [];

export class RunLog {
  readonly channels = new Map<string, Channel>();
  /** run.json, once it has been read. */
  summary: Summary | null = null;
  /** Time until which a file that is read piece by piece goes on, s. */
  ahead = 0;
  /** The log has been read as far as it goes, and has no end: its run was killed, or its file was cut. */
  cut = false;
  /** The file, where there is one, to be saved. */
  file: Pick<Source, "whole"> | null = null;
  /** Called when a part of a large file has been read: light topics that `grew`, or what was asked for. What shows the log sets it. */
  changed: (grew: boolean) => void = () => undefined;
  private chunks: Chunks | null = null;

  addChannel(topic: string, type: string, decode: Decode | null): Channel {
    let channel = this.channels.get(topic);
    if (!channel) {
      channel = new Channel(topic, type, unread.has(topic) ? null : decode);
      this.channels.set(topic, channel);
    }
    return channel;
  }

  /** Heavy topics are read from a large file when they are shown. */
  readLazily(chunks: Chunks): void { this.chunks = chunks; }

  /** Time of the latest message, s. */
  get end(): number { return Math.max(this.ahead, ...[...this.channels.values()].map((one) => one.end)); }
  /** How many messages have been read. */
  get count(): number { return [...this.channels.values()].reduce((sum, one) => sum + one.count, 0); }

  has(topic: string): boolean {
    return this.isLazy(topic) || (this.channels.get(topic)?.count ?? 0) > 0;
  }

  /** Returns true if not all messages of the topic are in memory. */
  isLazy(topic: string): boolean { return this.chunks?.has(topic) ?? false; }

  /** All messages of a topic; those read lazily are asked for by window() and at(). */
  messages<T>(topic: string): readonly Stamped<T>[] {
    return (this.channels.get(topic)?.messages ?? none) as readonly Stamped<T>[];
  }

  /** The message that holds at t: the latest one at or before it. */
  latest<T>(topic: string, t = Infinity): T | undefined {
    const all = this.messages<T>(topic);
    return all[indexAt(all, t)]?.message;
  }

  /** As latest(), of any topic, with its time; null while it is being read. `changed` is called then. */
  at<T>(topic: string, t: number): Stamped<T> | undefined | null {
    if (this.isLazy(topic)) return this.chunks!.at(topic, t) as Stamped<T> | undefined | null;
    const all = this.messages<T>(topic);
    return all[indexAt(all, t)];
  }

  /** The messages after `from` and not after `until`, which is `to`; or less, while the next part is being read. */
  window<T>(topic: string, from: number, to: number): Span<T> {
    if (this.isLazy(topic)) return this.chunks!.between(topic, from, to) as Span<T>;
    const all = this.messages<T>(topic);
    return { messages: all.slice(indexAt(all, from) + 1, indexAt(all, to) + 1), until: to };
  }
}
