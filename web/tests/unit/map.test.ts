// @vitest-environment jsdom
import { describe, expect, it } from "vitest";
import { knownArea, MapHistory } from "../../src/log/map";
import { topic } from "../../src/log/topics";
import { append, logOf, type Topics } from "./made";

const whole = (width: number, height: number, data: number[], x = 0) =>
  ({ info: { resolution: 0.5, width, height, origin: { position: { x, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } } }, data: Int8Array.from(data) });
const update = (x: number, y: number, width: number, data: number[]) => ({ x, y, width, height: data.length / width, data: Int8Array.from(data) });

/** Numbers from 0 to 1, the same each time. */
function dice(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

/** A map of 12 x 9 cells that is drawn anew twice, and changed in between. */
function randomMap(): Topics {
  const die = dice(11);
  const value = (): number => [-1, 0, 100][Math.floor(3 * die())]!;
  const maps: [number, unknown][] = [0, 70, 140].map((t) => [t, whole(12, 9, Array.from({ length: 108 }, value), t)]);
  const updates = Array.from({ length: 200 }, (_, i): [number, unknown] => {
    const [x, y, w, h] = [Math.floor(9 * die()), Math.floor(6 * die()), 1 + Math.floor(3 * die()), 1 + Math.floor(3 * die())];
    return [i + 0.5, update(x, y, w, Array.from({ length: w * h }, value))];
  });
  return { [topic.map]: maps, [topic.mapUpdates]: updates };
}

describe("the map at a time", () => {
  it("is the last whole one with all that came since", () => {
    const history = new MapHistory(logOf({ [topic.map]: [[1, whole(2, 2, [-1, 0, 100, -1])], [5, whole(3, 1, [0, 0, -1])]], [topic.mapUpdates]: [[2, update(0, 1, 2, [0, 100])]] }));
    const cells = (t: number): number[] | null => { const map = history.at(t); return map && [...map.cells]; };
    expect(cells(0.5)).toBeNull();
    expect(cells(1)).toEqual([-1, 0, 100, -1]);
    expect(cells(4)).toEqual([-1, 0, 0, 100]);
    expect(history.at(4)).toMatchObject({ known: 3, extent: { low: [0, 0], high: [1, 1] }, cell_m: 0.5 });
    expect(cells(9)).toEqual([0, 0, -1]);
    expect(cells(1.5)).toEqual([-1, 0, 100, -1]);
  });

  it("is the same whatever was shown before", () => {
    const log = logOf(randomMap());
    const [scrubbed, die] = [new MapHistory(log), dice(5)];
    for (let i = 0; i < 120; ++i) {
      const t = 210 * die();
      const [one, fresh] = [scrubbed.at(t)!, new MapHistory(log).at(t)!];
      expect([...one.cells]).toEqual([...fresh.cells]);
      expect(one.known).toBe(fresh.cells.reduce((sum, cell) => sum + Number(cell >= 0), 0));
      expect(one.origin).toEqual(fresh.origin);
    }
  });

  it("has another version when it has changed, and only then", () => {
    const history = new MapHistory(logOf(randomMap()));
    const version = history.at(10)!.version;
    expect(history.at(10.2)!.version).toBe(version);
    expect(history.at(11)!.version).not.toBe(version);
    expect(history.at(10)!.version).not.toBe(version);  // it was changed in between
  });

  it("counts what is known, and goes on when the log has grown", () => {
    const log = logOf({ [topic.map]: [[1, whole(2, 2, [-1, 0, 100, -1])]] });
    expect(knownArea(log)).toMatchObject({ time: [1], area: [0.5] });
    append(log, { [topic.mapUpdates]: [[2, update(0, 0, 1, [0])]] });
    const { time, area } = knownArea(log);
    expect([time, area]).toEqual([[1, 2], [0.5, 0.75]]);
  });
});
