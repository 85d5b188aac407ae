import { describe, expect, it } from "vitest";
import { differencesOf } from "../../src/compare/differences";

describe("the numbers of two runs", () => {
  it("are beside each other with what the second has more", () => {
    const rows = differencesOf([{ targets: 24, mission_s: 58.1, covered_fraction: 0.5, shots: 23, driven_m: 21.6 }, { targets: 24, mission_s: 161, covered_fraction: 0.52, shots: 20, gap: 0.25 }]);
    const texts = rows.map(({ name, values, differs, change }) => [name, ...values.map(({ value, unit }) => `${value} ${unit}`.trim()), differs, change]);
    expect(texts).toEqual([
      ["targets", "24", "24", false, "same"],
      ["mission time", "58.1 s", "2:41 min", true, "+1:43 min"],
      ["covered share", "50.00 %", "52.00 %", true, "+2.00 %"],
      ["shots", "23", "20", true, "\u22123"],
      ["driven length", "21.6 m", "\u2013", true, "not in both"],
      ["gap", "\u2013", "25.0 %", true, "not in both"],
    ]);
  });

  it("that are shown alike are the same, and so is nothing", () => {
    expect(differencesOf([{ time_s: 10.0001 }, { time_s: 10.0002 }])[0]).toMatchObject({ differs: false, change: "same" });
    expect(differencesOf([{ cost: null }, { cost: null }])[0]).toMatchObject({ values: [{ value: "\u2013" }, { value: "\u2013" }], differs: false });
    expect(differencesOf([{}, {}])).toEqual([]);
  });
});
