// Packs files into a zip archive without compression, because pictures are compressed already.
// Source: PKWARE, .ZIP File Format Specification 6.3.10, sections 4.3 and 4.4.

const most = 0xffffffff;  // largest archive in bytes without the 64-bit extension
const mostFiles = 0xffff;
const firstDay = 0x21;  // 1 January 1980: a fixed date, so the same files always make the same archive

const table = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n;
});

function crc32(bytes: Uint8Array): number {
  let sum = ~0;
  for (const byte of bytes) sum = table[(sum ^ byte) & 255]! ^ (sum >>> 8);
  return ~sum >>> 0;
}

/** Packs numbers of 2 or 4 bytes, little-endian: the widths as in "4:2:2", and the values. */
function packed(sizes: string, values: number[]): Uint8Array<ArrayBuffer> {
  const widths = sizes.split(":").map(Number);
  const view = new DataView(new ArrayBuffer(widths.reduce((sum, width) => sum + width, 0)));
  let at = 0;
  widths.forEach((width, i) => {
    if (width === 2) view.setUint16(at, values[i]!, true);
    else view.setUint32(at, values[i]!, true);
    at += width;
  });
  return new Uint8Array(view.buffer);
}

export class Zip {
  private parts: BlobPart[] = [];
  private directory: BlobPart[] = [];
  private files = 0;
  private size = 0;
  private directorySize = 0;

  /** Adds a file with an ASCII name. Throws if the archive would exceed 65,535 files or 4 GiB. */
  async add(name: string, content: Blob): Promise<void> {
    const letters = new TextEncoder().encode(name);
    const entry = 46 + letters.length;
    if (this.files === mostFiles || this.size + 30 + letters.length + content.size + this.directorySize + entry + 22 > most) {
      throw new Error("a zip archive takes 65,535 files and 4 GiB; save a shorter time, or fewer frames a second");
    }
    const crc = crc32(new Uint8Array(await content.arrayBuffer()));
    const common = [0, 0, 0, firstDay, crc, content.size, content.size, letters.length, 0];
    this.parts.push(packed("4:2:2:2:2:2:4:4:4:2:2", [0x04034b50, 10, ...common]), letters, content);
    this.directory.push(packed("4:2:2:2:2:2:2:4:4:4:2:2:2:2:2:4:4", [0x02014b50, 10, 10, ...common, 0, 0, 0, 0, this.size]), letters);
    this.size += 30 + letters.length + content.size;
    this.directorySize += entry;
    this.files += 1;
  }

  blob(): Blob {
    const end = packed("4:2:2:2:2:4:4:2", [0x06054b50, 0, 0, this.files, this.files, this.directorySize, this.size, 0]);
    return new Blob([...this.parts, ...this.directory, end], { type: "application/zip" });
  }
}
