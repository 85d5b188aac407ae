// Decoding: from the bytes of a message and the text of its schema to an object with its fields.
import type { McapTypes } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { decompress } from "fzstd";

export type Decode = (bytes: Uint8Array) => unknown;

/** The compressions of MCAP that the page can undo. `outrider` writes zstd. */
export const decompressors: McapTypes.DecompressHandlers = {
  zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))),
};

const text = new TextDecoder();
const made = new Map<string, Decode>();

/** Returns the decoder of a channel; null for an encoding that the page does not read. */
export function decoderOf(messageEncoding: string, schema: { name: string; encoding: string; data: Uint8Array } | undefined): Decode | null {
  if (messageEncoding === "json") return (bytes) => JSON.parse(text.decode(bytes)) as unknown;
  if (messageEncoding !== "cdr" || schema?.encoding !== "ros2msg") return null;
  const definition = text.decode(schema.data);
  const key = `${schema.name}\n${definition}`;
  let decode = made.get(key);
  if (!decode) {
    const reader = new MessageReader(parse(definition, { ros2: true }));
    decode = (bytes) => reader.readMessage(bytes);
    made.set(key, decode);
  }
  return decode;
}
