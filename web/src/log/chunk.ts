// A chunk of an MCAP file, and the messages in it.
import { McapStreamReader, type McapIndexedReader } from "@mcap/core";
import { decompressors } from "./decode";

/** The place of a chunk in the file, and its content. */
export type ChunkIndex = McapIndexedReader["chunkIndexes"][number];

/** A message as it stands in the file: the number of its channel, its time in ns. */
export interface Raw { id: number; time: bigint; data: Uint8Array }

// A record begins with its opcode and its size, a message with channel, number and two times.
const messageOpcode = 5;
const recordHead = 9;
const messageHead = 22;

/** The messages of a chunk, which is given as its record of the file. Throws where it is damaged, after what is whole. */
export function* messagesOf(bytes: Uint8Array): Generator<Raw> {
  const reader = new McapStreamReader({ noMagicPrefix: true, includeChunks: true });
  reader.append(bytes);
  const chunk = reader.nextRecord();
  if (chunk?.type !== "Chunk") throw new Error("the index names a chunk where there is none");
  const { compression, uncompressedSize, records } = chunk;
  const decompress = compression === "" ? () => records : decompressors[compression];
  if (!decompress) throw new Error(`chunks of compression ${compression} are not read`);
  const all = decompress(records, uncompressedSize);
  const view = new DataView(all.buffer, all.byteOffset, all.byteLength);
  for (let at = 0, size; at < all.length; at += recordHead + size) {
    size = Number(view.getBigUint64(at + 1, true));
    const data = at + recordHead;
    if (all[at] !== messageOpcode) continue;
    yield { id: view.getUint16(data, true), time: view.getBigUint64(data + 6, true), data: all.subarray(data + messageHead, data + size) };
  }
}
