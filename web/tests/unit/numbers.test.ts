import { describe, expect, it } from "vitest";
import { clockText, metric, minus, roundStep, wrapped } from "../../src/base/numbers";

describe("numbers for people", () => {
  it("writes minutes and seconds", () => {
    expect(clockText(0)).toBe("0:00");
    expect(clockText(62.5, 1)).toBe("1:02.5");
    expect(clockText(59.96, 1)).toBe("1:00.0");  // rounds before it splits
    expect(clockText(null)).toBe("\u2013");
  });

  it("knows the unit of a metric by its name", () => {
    expect(metric("mission_s", 58.107)).toEqual({ label: "mission", value: "58.1", unit: "s" });
    expect(metric("driven_m", 21.67)).toEqual({ label: "driven", value: "21.7", unit: "m" });
    expect(metric("turned_rad", 2 * Math.PI)).toEqual({ label: "turned", value: "1.00", unit: "turns" });
    expect(metric("reach_m2", 41.26)).toEqual({ label: "reach", value: "41.3", unit: "m\u00b2" });
    expect(metric("covered_fraction", 0.99987)).toEqual({ label: "covered", value: "99.99", unit: "%" });
    expect(metric("places", 18569)).toEqual({ label: "places", value: "18,569", unit: "" });
    expect(metric("gap", null).value).toBe("\u2013");
  });

  it("finds round steps that are large enough", () => {
    for (const least of [0.013, 0.2, 0.21, 1, 3, 7.5, 99]) {
      const step = roundStep(least);
      expect(step).toBeGreaterThanOrEqual(least * (1 - 1e-9));
      expect(step).toBeLessThan(2.5 * least + 1e-9);
      expect([1, 2, 5]).toContain(Math.round(step / 10 ** Math.floor(Math.log10(step) + 1e-9)));
    }
  });

  it("wraps angles and writes a true minus", () => {
    expect(wrapped(7 * Math.PI / 2)).toBeCloseTo(-Math.PI / 2);
    expect(minus("-3")).toBe("\u22123");
  });
});
