import { describe, expect, it } from "vitest";
import { typeset } from "../../src/base/typeset";
import { clockText, metric, minus, roundStep, wrapped } from "../../src/base/numbers";

describe("numbers for people", () => {
  it("writes minutes and seconds", () => {
    expect(clockText(0)).toBe("0:00");
    expect(clockText(62.5, 1)).toBe("1:02.5");
    expect(clockText(59.96, 1)).toBe("1:00.0");  // rounds before it splits
    expect(clockText(3599.9)).toBe("1:00:00");
    expect(clockText(8070.6, 1)).toBe("2:14:30.6");
    expect(clockText(null)).toBe("\u2013");
  });

  it("knows the unit of a metric by its name", () => {
    expect(metric("mission_s", 58.107)).toEqual({ label: "mission time", value: "58.1", unit: "s" });
    expect(metric("driven_m", 21.67)).toEqual({ label: "driven length", value: "21.7", unit: "m" });
    expect(metric("turned_rad", 2 * Math.PI)).toEqual({ label: "turned", value: "1.00", unit: "turns" });
    expect(metric("reach_m2", 41.26)).toEqual({ label: "reach area", value: "41.3", unit: "m\u00b2" });
    expect(metric("covered_fraction", 0.99987)).toEqual({ label: "covered share", value: "99.99", unit: "%" });
    expect(metric("time_s", 8070)).toEqual({ label: "time", value: "2:14:30", unit: "h" });
    expect(metric("tour_proven", 0)).toEqual({ label: "tour proven", value: "no", unit: "" });
    expect(metric("gap", 0.01999)).toEqual({ label: "gap", value: "2.00", unit: "%" });
    expect(metric("places", 18569)).toEqual({ label: "places", value: "18,569", unit: "" });
    expect(metric("gap", null).value).toBe("\u2013");
  });

  it("tells metrics of the same stem apart by what they measure", () => {
    const label = (name: string): string => metric(name, 1).label;
    expect(["covered_fraction", "covered_m2", "planned_fraction", "planned_s", "planned_m", "planned_missed_m2"].map(label)).toEqual(
      ["covered share", "covered area", "planned share", "planned time", "planned length", "planned missed area"]);
    expect(["time_s", "area_m2", "ideal_s", "ideal_m", "lower_bound_s", "lower_bound"].map(label)).toEqual(["time", "area", "ideal time", "ideal length", "lower bound", "lower bound"]);
    expect(["t_min_s", "sure_fraction", "shots", "clearance_m"].map(label)).toEqual(["least possible time", "share covered for sure", "shots", "clearance"]);
  });

  it("rounds and sets the text of the tool, and leaves names alone", () => {
    expect(typeset("caught at 26.087855297157624 s, on 0.3 m2, at most 0.5 m/s2")).toBe("caught at 26.0879 s, on 0.3 m\u00b2, at most 0.5 m/s\u00b2");
    expect(typeset("2 places per m2; up to 12 m3")).toBe("2 places per m\u00b2; up to 12 m\u00b3");
    expect(typeset("none of 9485238 flights from 9576 places, from (0.18, -6.21) or -3")).toBe("none of 9,485,238 flights from 9,576 places, from (0.18, \u22126.21) or \u22123");
    for (const same of ["map m2.yaml of room_m2", "0.0909", "at 1234567 and 1.2.3456789", "seed 123456789"]) expect(typeset(same)).toBe(same);
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
