// PNG pictures of 8 bits a channel, RGB or RGBA: enough to compare screenshots.
import { deflateSync, inflateSync } from "node:zlib";

const table = Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});
const crc = (bytes) => (bytes.reduce((sum, byte) => table[(sum ^ byte) & 255] ^ (sum >>> 8), 0xffffffff) ^ 0xffffffff) >>> 0;

/** Undoes the filters of the lines (PNG specification, section 9). */
export function readPng(png) {
  const [width, height, channels] = [png.readUInt32BE(16), png.readUInt32BE(20), png[25] === 6 ? 4 : 3];
  const parts = [];
  for (let at = 8; at < png.length;) {
    const size = png.readUInt32BE(at);
    if (png.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(png.subarray(at + 8, at + 8 + size));
    at += size + 12;
  }
  const raw = inflateSync(Buffer.concat(parts));
  const stride = width * channels;
  const data = Buffer.alloc(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (stride + 1)];
    for (let x = 0; x < stride; ++x) {
      const left = x >= channels ? data[y * stride + x - channels] : 0;
      const up = y > 0 ? data[(y - 1) * stride + x] : 0;
      const corner = y > 0 && x >= channels ? data[(y - 1) * stride + x - channels] : 0;
      const p = left + up - corner;
      const [a, b, c] = [Math.abs(p - left), Math.abs(p - up), Math.abs(p - corner)];
      const paeth = a <= b && a <= c ? left : b <= c ? up : corner;
      data[y * stride + x] = raw[y * (stride + 1) + 1 + x] + [0, left, up, (left + up) >> 1, paeth][filter];
    }
  }
  return { width, height, channels, data };
}

export function writePng({ width, height, data }) {
  const chunk = (type, bytes) => {
    const body = Buffer.concat([Buffer.from(type, "latin1"), bytes]);
    const out = Buffer.alloc(body.length + 8);
    out.writeUInt32BE(bytes.length, 0);
    body.copy(out, 4);
    out.writeUInt32BE(crc(body), body.length + 4);
    return out;
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2, 0, 0, 0], 8);
  const lines = Buffer.alloc(height * (3 * width + 1));
  for (let y = 0; y < height; ++y) data.copy(lines, y * (3 * width + 1) + 1, 3 * y * width, 3 * (y + 1) * width);
  const signature = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);
  return Buffer.concat([signature, chunk("IHDR", head), chunk("IDAT", deflateSync(lines, { level: 9 })), chunk("IEND", Buffer.alloc(0))]);
}

/** Each square of pixels as one, of their mean colour. */
export function shrunk({ width, height, channels, data }, square) {
  const [w, h] = [Math.floor(width / square), Math.floor(height / square)];
  const out = Buffer.alloc(3 * w * h);
  for (let y = 0; y < h; ++y) {
    for (let x = 0; x < w; ++x) {
      for (let k = 0; k < 3; ++k) {
        let sum = 0;
        for (let v = 0; v < square; ++v) {
          for (let u = 0; u < square; ++u) sum += data[((y * square + v) * width + x * square + u) * channels + k];
        }
        out[3 * (y * w + x) + k] = Math.round(sum / (square * square));
      }
    }
  }
  return { width: w, height: h, channels: 3, data: out };
}

/** Share of the pixels of which a channel differs by more than a tenth. */
export function difference(a, b) {
  if (a.width !== b.width || a.height !== b.height) return 1;
  let off = 0;
  for (let i = 0; i < a.width * a.height; ++i) {
    if ([0, 1, 2].some((k) => Math.abs(a.data[a.channels * i + k] - b.data[b.channels * i + k]) > 25)) off += 1;
  }
  return off / (a.width * a.height);
}
