// Places of names in space.
import { PerspectiveCamera, Sprite } from "three";
import { describe, expect, it, vi } from "vitest";

vi.hoisted(() => { (globalThis as { matchMedia?: unknown }).matchMedia = () => ({ matches: false, addEventListener: () => undefined }); });
const { apart, placeTexts } = await import("../../src/watch/space_labels");

const [width, height] = [800, 600];
const camera = new PerspectiveCamera(42, width / height, 0.1, 100);
camera.position.set(0, 0, 10);
camera.updateMatrixWorld();

function text(x: number, y: number, z: number, more: object = {}): Sprite {
  const sprite = new Sprite();
  Object.assign(sprite.userData, { width: 60, height: 18, name: true, first: false, ...more });
  sprite.position.set(x, y, z);
  sprite.updateMatrixWorld();
  return sprite;
}

/** The pixels that a sprite covers: its scale is its height where the distance is 1. */
function area(sprite: Sprite): [number, number, number, number] {
  const { x, y } = sprite.position.clone().project(camera);
  const one = height / (2 * Math.tan((camera.fov * Math.PI) / 360));
  const [left, low] = [(0.5 + 0.5 * x) * width - sprite.center.x * sprite.scale.x * one, (0.5 - 0.5 * y) * height + sprite.center.y * sprite.scale.y * one];
  return [left, low - sprite.scale.y * one, left + sprite.scale.x * one, low];
}

describe("names in space", () => {
  it("are as large as their pixels, above what they name where there is room", () => {
    const one = text(0, 0, 0);
    expect(placeTexts([one], camera, width, height)).toBe(1);
    const [x0, y0, x1, y1] = area(one);
    expect([x1 - x0, y1 - y0].map(Math.round)).toEqual([60, 18]);
    expect(y1).toBeLessThan(300);
  });

  it("stand beside what lies over the view, or nowhere", () => {
    const one = text(0, 0, 0);
    expect(placeTexts([one], camera, width, height, [[380, 200, 420, 299]])).toBe(1);
    expect(area(one)[1]).toBeGreaterThan(290);
    expect(placeTexts([text(0, 0, 0)], camera, width, height, [[300, 200, 500, 400]])).toBe(0);
  });

  it("cover no other text, whatever the crowd, and those without room are hidden", () => {
    const crowd = Array.from({ length: 40 }, (_, i) => text(Math.sin(7 * i), Math.cos(5 * i), Math.sin(3 * i), i % 8 === 0 ? { name: false, width: 20, height: 20 } : {}));
    const shown = placeTexts(crowd, camera, width, height);
    const names = crowd.filter(({ visible, userData }) => visible && userData.name);
    expect(names.length).toBe(shown);
    expect(shown).toBeGreaterThan(8);
    expect(shown).toBeLessThan(35);
    const covered = names.map((one) => [one, ...crowd.filter((other) => other !== one && other.visible)].map(area));
    for (const [own, ...others] of covered) for (const other of others) expect(apart(own!, other)).toBe(true);
  });

  it("yield to the one that is selected, then to nearer ones; none stands for what is behind the view", () => {
    const at = (z: number, more = {}) => text(0, 0, z, { width: 380, height: 190, ...more });  // two have room, above and below
    const [far, near, nearest, behind] = [at(0), at(1), at(2), at(11)];
    placeTexts([far, near, nearest, behind], camera, width, height);
    expect([far, near, nearest, behind].map(({ visible }) => visible)).toEqual([false, true, true, false]);
    const [chosen, ...others] = [at(0, { first: true }), at(1), at(2)];
    placeTexts([chosen!, ...others], camera, width, height);
    expect([chosen, ...others].map((one) => one!.visible)).toEqual([true, false, true]);
  });
});
