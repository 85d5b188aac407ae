// Packs encoded pictures into a WebM file. Source: RFC 8794 (EBML), RFC 9559 (Matroska), https://www.webmproject.org/docs/container.

export interface EncodedFrame { data: Uint8Array; time_ms: number; key: boolean }
export interface Film { codec: "V_VP8" | "V_VP9"; width: number; height: number; duration_ms: number }

type Content = Uint8Array | Uint8Array[];
const text = new TextEncoder();
const longestCluster_ms = 30_000;  // times within a cluster are of 16 bits

const joined = (parts: readonly Uint8Array[]): Uint8Array<ArrayBuffer> => {
  const all = new Uint8Array(parts.reduce((sum, one) => sum + one.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
};

/** A number, big-endian, in as few bytes as it takes or in `length`. */
function number(value: number, length = 0): Uint8Array {
  const bytes: number[] = [];
  for (let rest = value; rest > 0 || bytes.length < Math.max(1, length); rest = Math.floor(rest / 256)) bytes.unshift(rest % 256);
  return Uint8Array.from(bytes);
}

function real(value: number): Uint8Array {
  const bytes = new DataView(new ArrayBuffer(8));
  bytes.setFloat64(0, value);
  return new Uint8Array(bytes.buffer);
}

/** An element: its id, its size in eight bytes, what it holds. */
function element(id: number, content: Content): Uint8Array<ArrayBuffer> {
  const body = Array.isArray(content) ? joined(content) : content;
  const size = number(body.length, 8);
  size[0] = 1;
  return joined([number(id), size, body]);
}

function block({ data, time_ms, key }: EncodedFrame, from_ms: number): Uint8Array {
  return element(0xa3, joined([Uint8Array.of(0x81), number(Math.round(time_ms - from_ms), 2), Uint8Array.of(key ? 0x80 : 0), data]));
}

function clusters(frames: readonly EncodedFrame[]): Uint8Array[] {
  const made: { from: number; blocks: Uint8Array[] }[] = [];
  for (const frame of frames) {
    const last = made.at(-1);
    if (!last || (frame.key && frame.time_ms > last.from) || frame.time_ms - last.from > longestCluster_ms) made.push({ from: Math.round(frame.time_ms), blocks: [] });
    const { from, blocks } = made.at(-1)!;
    blocks.push(block(frame, from));
  }
  return made.map(({ from, blocks }) => element(0x1f43b675, [element(0xe7, number(from)), ...blocks]));
}

/** The file, of frames in the order of their times, the first of which is a key frame. */
export function webm({ codec, width, height, duration_ms }: Film, frames: readonly EncodedFrame[]): Uint8Array<ArrayBuffer> {
  const head = element(0x1a45dfa3, [element(0x4286, number(1)), element(0x42f7, number(1)), element(0x42f2, number(4)), element(0x42f3, number(8)),
    element(0x4282, text.encode("webm")), element(0x4287, number(2)), element(0x4285, number(2))]);
  const info = element(0x1549a966, [element(0x2ad7b1, number(1_000_000)), element(0x4489, real(duration_ms)), element(0x4d80, text.encode("Outrider")), element(0x5741, text.encode("Outrider"))]);
  const video = element(0xe0, [element(0xb0, number(width)), element(0xba, number(height))]);
  const tracks = element(0x1654ae6b, element(0xae, [element(0xd7, number(1)), element(0x73c5, number(1)), element(0x83, number(1)), element(0x86, text.encode(codec)), video]));
  return joined([head, element(0x18538067, [info, tracks, ...clusters(frames)])]);
}
