import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, describe, expect, it } from "vitest";
import { arcCurves, PathText } from "../../src/base/ink";
import { Zip } from "../../src/base/zip";
import { frameCount, frameName, frameTime, rangeFault } from "../../src/watch/film";

const folder = mkdtempSync(join(tmpdir(), "outrider-film-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

/** The files of an archive as Python reads them, which checks their sums as well: name, size, and the sum of the bytes. */
function readBack(archive: string): [string, number, number][] {
  const script = "import json, sys, zipfile\nwith zipfile.ZipFile(sys.argv[1]) as z:\n"
    + "    print(json.dumps([[i.filename, i.file_size, sum(z.read(i))] for i in z.infolist()]))";
  return JSON.parse(execFileSync("python3", ["-c", script, archive], { encoding: "utf8" })) as [string, number, number][];
}

describe("an archive", () => {
  it("is read by another program, file by file, whatever they hold", async () => {
    const sizes = [0, 1, 255, 70000];
    const contents = sizes.map((size, k) => Uint8Array.from({ length: size }, (_, i) => (i * 31 + k * 7) & 255));
    const zip = new Zip();
    for (const [k, bytes] of contents.entries()) await zip.add(frameName(k), new Blob([bytes]));
    const archive = join(folder, "frames.zip");
    writeFileSync(archive, new Uint8Array(await zip.blob().arrayBuffer()));
    expect(readBack(archive)).toEqual(contents.map((bytes, k) => [`frame-0000${k}.png`, bytes.length, bytes.reduce((sum, byte) => sum + byte, 0)]));
  });

  it("is the same twice, and one of nothing is one", async () => {
    const made = async (names: string[]): Promise<string> => {
      const zip = new Zip();
      for (const name of names) await zip.add(name, new Blob([name]));
      return Buffer.from(await zip.blob().arrayBuffer()).toString("hex");
    };
    expect(await made(["a", "b"])).toBe(await made(["a", "b"]));
    writeFileSync(join(folder, "none.zip"), Buffer.from(await made([]), "hex"));
    expect(readBack(join(folder, "none.zip"))).toEqual([]);
  });

  it("refuses what its format cannot hold", async () => {
    const huge = { size: 0xffffffff, arrayBuffer: () => Promise.resolve(new ArrayBuffer(0)) } as Blob;
    await expect(new Zip().add("huge", huge)).rejects.toThrow("4 GiB");
  });
});

describe("the frames of a film", () => {
  it("stand at from + k / rate, the end included where one falls on it", () => {
    const range = { from: 2, to: 3, rate: 10 };
    expect(frameCount(range)).toBe(11);
    expect(frameTime(range, 10)).toBe(3);
    expect(frameCount({ from: 0, to: 0.99, rate: 10 })).toBe(10);
    expect(frameCount({ from: 4, to: 4, rate: 25 })).toBe(1);
    for (let rate = 1; rate <= 60; ++rate) {
      const one = { from: 0.1, to: 10.1, rate };
      expect(frameCount(one)).toBe(10 * rate + 1);
      expect(frameTime(one, frameCount(one) - 1)).toBeLessThanOrEqual(one.to + 1e-9);
    }
  });

  it("are refused with a sentence that names the field", () => {
    expect(rangeFault({ from: 0, to: 10, rate: 25 }, 10)).toBe("");
    expect(rangeFault({ from: -1, to: 10, rate: 25 }, 10)).toMatch(/^From.*0 to 10/);
    expect(rangeFault({ from: NaN, to: 10, rate: 25 }, 10)).toMatch(/^From/);
    expect(rangeFault({ from: 5, to: 4, rate: 25 }, 10)).toMatch(/^To.*5\.00 to 10\.00/);
    expect(rangeFault({ from: 0, to: 11, rate: 25 }, 10)).toMatch(/^To/);
    expect(rangeFault({ from: 0, to: 10, rate: 0 }, 10)).toMatch(/^Frames a second/);
    expect(rangeFault({ from: 0, to: 3600, rate: 25 }, 3600)).toMatch(/90,001 frames/);
  });
});

describe("ink that is written down", () => {
  it("draws arcs as curves that keep to the ellipse", () => {
    for (const [across, tall, turn, from, to] of [[1, 1, 0, 0, 2 * Math.PI], [3, 0.5, 0.7, 1, 5], [2, 1, -2, 5, 1], [1, 2, 0, -3, -2.9]] as const) {
      for (const [x0, y0, x1, y1, x2, y2, x3, y3] of arcCurves(4, -3, across, tall, turn, from, to) as [number, number, number, number, number, number, number, number][]) {
        for (let s = 0; s <= 1; s += 0.05) {
          const curve = (a: number, b: number, c: number, d: number): number => (1 - s) ** 3 * a + 3 * s * (1 - s) ** 2 * b + 3 * s * s * (1 - s) * c + s ** 3 * d;
          const [dx, dy] = [curve(x0, x1, x2, x3) - 4, curve(y0, y1, y2, y3) + 3];
          const [u, v] = [dx * Math.cos(turn) + dy * Math.sin(turn), dy * Math.cos(turn) - dx * Math.sin(turn)];
          expect(Math.abs(Math.hypot(u / across, v / tall) - 1)).toBeLessThan(3e-4);
        }
      }
    }
  });

  it("ends an arc where a canvas ends it: the way of growing angles, at most once around", () => {
    const last = (from: number, to: number): [number, number] => arcCurves(0, 0, 1, 1, 0, from, to).at(-1)!.slice(6) as [number, number];
    for (const [from, to] of [[0, 1], [5, 1], [-3, 3], [1, 40], [2, 2]] as const) {
      const end = to - from >= 2 * Math.PI ? from : to;
      expect(last(from, to)[0]).toBeCloseTo(Math.cos(end));
      expect(last(from, to)[1]).toBeCloseTo(Math.sin(end));
    }
  });

  it("writes lines as SVG does, through the places it is given", () => {
    const path = new PathText((x, y) => [10 * x, -10 * y]);
    path.lineTo(1, 2);
    path.lineTo(3, 4);
    path.closePath();
    path.rect(0, 0, 1, 1);
    expect(path.d).toBe("M10 -20L30 -40ZM0 0L10 0L10 -10L0 -10Z");
  });
});
