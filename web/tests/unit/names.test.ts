// Places of names in the plan.
import { describe, expect, it, vi } from "vitest";
import type { Ink } from "../../src/base/ink";

vi.hoisted(() => { (globalThis as { matchMedia?: unknown }).matchMedia = () => ({ matches: false, addEventListener: () => undefined }); });
const { placeNames, shortName } = await import("../../src/watch/names");

const ink = { font: "", measureText: (text: string) => ({ width: 6 * text.length }) } as unknown as Ink;
const view = { width: 400, height: 300 };

describe("names beside what they name", () => {
  it("stand to the right where there is room, else to the left, above or below, else nowhere", () => {
    expect(placeNames(ink, view, [{ text: "abc", x: 100, y: 100 }])).toEqual([{ x: 11, y: 0 }]);
    expect(placeNames(ink, view, [{ text: "abc", x: 395, y: 100 }])).toEqual([{ x: -29, y: 0 }]);
    expect(placeNames(ink, view, [{ text: "a".repeat(60), x: 200, y: 100 }])).toEqual([{ x: -180, y: -16 }]);
    expect(placeNames(ink, view, [{ text: "a".repeat(90), x: 200, y: 100 }])).toEqual([null]);
  });

  it("cover no sign and no other name, and the first have their choice", () => {
    const crowd = Array.from({ length: 60 }, (_, i) => ({ text: `name ${i}`, x: 200 + 90 * Math.sin(7 * i), y: 150 + 70 * Math.cos(5 * i) }));
    const places = placeNames(ink, view, crowd);
    expect(places[0]).not.toBeNull();
    const areas = places.flatMap((place, i) => {
      const { text, x, y } = crowd[i]!;
      return place ? [[x + place.x, y + place.y - 7, x + place.x + 6 * text.length, y + place.y + 7]] : [];
    });
    expect(areas.length).toBeGreaterThan(10);
    expect(areas.length).toBeLessThan(60);
    const covers = (a: number[], b: number[]): boolean => a[0]! < b[2]! && b[0]! < a[2]! && a[1]! < b[3]! && b[1]! < a[3]!;
    for (const [i, a] of areas.entries()) {
      for (const b of areas.slice(i + 1)) expect(covers(a, b)).toBe(false);
      for (const { x, y } of crowd) expect(covers(a, [x - 6, y - 6, x + 6, y + 6])).toBe(false);
    }
  });

  it("are cut where they are long", () => {
    expect(shortName("a".repeat(28))).toHaveLength(28);
    expect(shortName("a".repeat(29))).toBe(`${"a".repeat(27)}\u2026`);
  });
});
