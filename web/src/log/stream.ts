// LogStream: fills a RunLog from the bytes of an MCAP stream, cut at any byte. A live run, the one-file page and a
// file without an index are read by it.
import { McapStreamReader, type McapTypes } from "@mcap/core";
import { decoderOf, decompressors } from "./decode";
import type { Channel, RunLog } from "./run_log";
import { parseSummary } from "./summary";

const text = new TextDecoder();

/** Times of a run count from 0. A log of others counts from 1970; there the first message is at 0. */
export const originOf = (first: bigint): bigint => (first > 100_000_000_000_000_000n ? first : 0n);

type Schema = McapTypes.TypedMcapRecords["Schema"];

export class LogStream {
  private reader = new McapStreamReader({ decompressHandlers: decompressors, validateCrcs: false });
  private schemas = new Map<number, Schema>();
  private channels = new Map<number, Channel>();
  private origin: bigint | null = null;

  constructor(readonly log: RunLog) {}

  /** The stream has come to its end. */
  get done(): boolean { return this.reader.done(); }

  /** Throws where the bytes are no MCAP; the log has what came before. */
  feed(bytes: Uint8Array): void {
    if (this.done) return;
    this.reader.append(bytes);
    for (let record = this.reader.nextRecord(); record; record = this.reader.nextRecord()) this.take(record);
  }

  private take(record: McapTypes.TypedMcapRecord): void {
    if (record.type === "Schema") this.schemas.set(record.id, record);
    if (record.type === "Channel" && !this.channels.has(record.id)) {
      const schema = this.schemas.get(record.schemaId);
      this.channels.set(record.id, this.log.addChannel(record.topic, schema?.name ?? "", decoderOf(record.messageEncoding, schema)));
    }
    if (record.type === "Message") {
      this.origin ??= originOf(record.logTime);
      this.channels.get(record.channelId)!.append(Number(record.logTime - this.origin) / 1e9, record.data.slice());
    }
    if (record.type === "Attachment" && record.name === "run.json") this.log.summary = parseSummary(text.decode(record.data));
  }
}
