// The colours: text and marks stand out from their ground, and states can be told apart by people who see no red
// or no green (Machado, Oliveira, Fernandes 2009, full severity).
import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";

type Rgb = [number, number, number];
const sheet = readFileSync(new URL("../../src/base/style.css", import.meta.url), "utf8");

function colours(selector: string): Record<string, Rgb> {
  const block = sheet.slice(sheet.indexOf(selector)).match(/\{([^}]*)\}/)![1]!;
  return Object.fromEntries([...block.matchAll(/--([\w-]+):\s*#([0-9a-f]{6})\s*;/g)].map(([, name, hex]) =>
    [name!, [0, 2, 4].map((at) => parseInt(hex!.slice(at, at + 2), 16) / 255) as Rgb]));
}

const linear = (value: number): number => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
const luminance = ([r, g, b]: Rgb): number => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);

/** WCAG 2.2 contrast. */
function contrast(a: Rgb, b: Rgb): number {
  const [x, y] = [luminance(a), luminance(b)];
  return (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05);
}

const sights: Record<string, number[][]> = {
  all: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
};

/** Distance in CIE L*a*b* as somebody sees two colours. */
function apart(a: Rgb, b: Rgb, matrix: number[][]): number {
  const lab = (colour: Rgb): Rgb => {
    const [r, g, blue] = matrix.map((row) => Math.min(1, Math.max(0, row.reduce((sum, k, i) => sum + k * linear(colour[i]!), 0)))) as Rgb;
    const f = (t: number): number => (t > 0.008856 ? Math.cbrt(t) : 7.787 * t + 16 / 116);
    const x = f((0.4124 * r + 0.3576 * g + 0.1805 * blue) / 0.95047);
    const y = f(0.2126 * r + 0.7152 * g + 0.0722 * blue);
    const z = f((0.0193 * r + 0.1192 * g + 0.9505 * blue) / 1.08883);
    return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
  };
  const [p, q] = [lab(a), lab(b)];
  return Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

describe.each([["light", ":root {"], ["dark", ':root[data-theme="dark"] {']])("the %s colours", (_, selector) => {
  const palette = colours(selector);

  it("are readable as text", () => {
    for (const ground of ["panel", "yard"]) {
      expect(contrast(palette.ink!, palette[ground]!)).toBeGreaterThan(7);
      for (const text of ["soft", "reached", "failed", "unreachable", "water", "robot"]) {
        expect(contrast(palette[text]!, palette[ground]!), `${text} on ${ground}`).toBeGreaterThan(4.5);
      }
    }
  });

  it("can be told apart without red or green", () => {
    const lines = ["robot", "water", "reached", "failed", "belief"];
    for (const [sight, matrix] of Object.entries(sights)) {
      for (const a of lines) {
        for (const b of lines.slice(lines.indexOf(a) + 1)) {
          expect(apart(palette[a]!, palette[b]!, matrix), `${a} and ${b}, ${sight}`).toBeGreaterThan(15);
        }
      }
      expect(apart(palette.open!, palette.closed!, matrix)).toBeGreaterThan(25);
    }
  });
});
