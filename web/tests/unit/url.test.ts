// @vitest-environment jsdom
import { afterAll, beforeAll, describe, expect, it, vi } from "vitest";
import { formatAddress, keepInAddress, parseAddress } from "../../src/base/url";
import { keyName, keyOf, Keys } from "../../src/base/keys";

describe("addresses", () => {
  beforeAll(() => void vi.useFakeTimers());
  afterAll(() => void vi.useRealTimers());

  it("come back as they were written", () => {
    for (const address of [
      { view: "watch", path: "out/yard/run.mcap", query: { t: "12.5", view: "3d" } },
      { view: "plan", path: "a folder/ümlaut & more.map", query: { start: "1,2", goal: "3,-4" } },
      { view: "", path: "", query: {} },
      { view: "watch", path: "100%.mcap", query: { a: "x=y&z?" } },
    ]) expect(parseAddress(formatAddress(address))).toEqual(address);
  });

  it("can be typed by hand", () => {
    expect(parseAddress("#/watch/a.mcap?t=3")).toEqual({ view: "watch", path: "a.mcap", query: { t: "3" } });
    expect(parseAddress("#watch/100%.mcap").path).toBe("100%.mcap");
    expect(formatAddress({ view: "plan", path: "m", query: { start: "1,2", empty: "" } })).toBe("#plan/m?start=1,2");
  });

  it("keep the present view", () => {
    location.hash = "#watch/a.json?t=1&view=3d";
    keepInAddress({ t: "2", view: "" });
    expect(location.hash).toBe("#watch/a.json?t=2");
  });

  it("change at most four times a second, and no other view", () => {
    location.hash = "#watch/b.json";
    vi.advanceTimersByTime(1000);
    const change = vi.spyOn(history, "replaceState");
    for (let t = 1; t <= 60; ++t) {
      keepInAddress({ t: String(t), ...(t === 7 ? { view: "3d" } : {}) });
      vi.advanceTimersByTime(1000 / 60);
    }
    vi.advanceTimersByTime(1000);
    expect(location.hash).toBe("#watch/b.json?t=60&view=3d");
    expect(change.mock.calls.length).toBeLessThanOrEqual(6);
    keepInAddress({ t: "61" });
    keepInAddress({ t: "62" });
    location.hash = "#watch/c.json";
    vi.advanceTimersByTime(1000);
    expect(location.hash).toBe("#watch/c.json");
  });
});

describe("keys", () => {
  it("act once, and leave fields and buttons alone", () => {
    const keys = new Keys();
    let acted = 0;
    keys.set("a", [{ key: " ", words: "", act: () => { acted += 1; } }, { key: "Shift+Home", words: "", act: () => { acted += 10; } }]);
    const press = (key: string, on: Element, shiftKey = false): void => {
      const event = new KeyboardEvent("keydown", { key, shiftKey, bubbles: true });
      Object.defineProperty(event, "target", { value: on });
      keys.handle(event);
    };
    press(" ", document.body);
    press(" ", document.createElement("input"));
    press(" ", document.createElement("button"));
    press("Home", document.body);
    expect(acted).toBe(1);
    press("Home", document.body, true);
    expect(acted).toBe(11);
    keys.set("a", []);
    press(" ", document.body);
    expect(acted).toBe(11);
  });

  it("stay with the view that came later when the one before closes", () => {
    const keys = new Keys();
    const [before, later] = [{}, {}];
    keys.set("View", [{ key: "a", words: "old", act: () => undefined }], before);
    keys.set("Film", [{ key: "b", words: "old", act: () => undefined }], before);
    keys.set("View", [{ key: "a", words: "new", act: () => undefined }], later);
    keys.drop(before);
    expect(keys.list().map(([group, [first]]) => [group, first!.words])).toEqual([["View", "new"]]);
  });

  it("have names", () => {
    expect(keyOf({ key: "?", shiftKey: true })).toBe("?");
    expect(keyOf({ key: "ArrowLeft", shiftKey: true })).toBe("Shift+ArrowLeft");
    expect([" ", "+", "Shift+ArrowLeft"].map(keyName)).toEqual(["space", "+", "Shift \u2190"]);
  });
});
