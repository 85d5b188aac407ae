// Text in space, always as large on the screen, before whatever stands between: names of targets, each where it covers no other; numbers of places.
import { CanvasTexture, LinearFilter, type PerspectiveCamera, Sprite, SpriteMaterial, SRGBColorSpace, Vector3 } from "three";
import { theme } from "../base/theme";
import type { Vec3 } from "../log/geometry";
import type { Run } from "../log/run";
import { targetsOf } from "../log/targets";
import { disk, label } from "./layer";
import { shortName } from "./names";
import type { Actor } from "./space_parts";

const dense = 2;  // pixels of a texture in one of the screen

/** How large a sprite is on the screen, and whether it gives way to others. */
interface Text { width: number; height: number; name: boolean; first: boolean }
const textOf = (sprite: Sprite): Text => sprite.userData as Text;

function spriteOf(canvas: HTMLCanvasElement, name: boolean): Sprite {
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  map.minFilter = LinearFilter;
  map.generateMipmaps = false;
  const sprite = new Sprite(new SpriteMaterial({ map, sizeAttenuation: false, depthTest: false, transparent: true }));
  const text: Text = { width: canvas.width / dense, height: canvas.height / dense, name, first: false };
  Object.assign(sprite.userData, text);
  sprite.renderOrder = name ? 3 : 2;
  return sprite;
}

function nameSprite(text: string): Sprite {
  const canvas = document.createElement("canvas");
  const font = `500 12px ${theme.sans}`;
  const pen = canvas.getContext("2d")!;
  pen.font = font;
  canvas.width = dense * (Math.ceil(pen.measureText(text).width) + 8);
  canvas.height = dense * 18;
  pen.scale(dense, dense);
  pen.font = font;
  pen.textBaseline = "middle";
  label(pen, text, 4, 9, theme.ink, theme.yard);
  return spriteOf(canvas, true);
}

/** A number in a circle, as the plan has it. */
export function numberSprite(number: number, filled: boolean, at: Vec3): Sprite {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 20 * dense;
  const pen = canvas.getContext("2d")!;
  pen.scale(dense, dense);
  disk(pen, 10, 10, 8.5);
  pen.fillStyle = filled ? theme.open : theme.yard;
  pen.fill();
  pen.strokeStyle = theme.open;
  pen.lineWidth = 1.5;
  pen.stroke();
  pen.font = `650 11px ${theme.sans}`;
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  label(pen, String(number), 10, 10.5, theme.ink, theme.yard);
  const sprite = spriteOf(canvas, false);
  sprite.position.set(...at);
  return sprite;
}

export const labelActor = (run: Run): Actor[] => targetsOf(run).map((target) => {
  const sprite = nameSprite(shortName(target.name));
  return { things: [sprite], act: ({ t, target: selected }) => {
    const place = target.placeAt(t);
    sprite.visible = place !== null;
    textOf(sprite).first = target === selected;
    if (place) sprite.position.set(place[0], place[1], target.centre[2] + target.last.size.z / 2);
  } };
});

/** From what stands at its place: above it, below it, to its right, to its left. */
const sides = [[0.5, -0.3], [0.5, 1.3], [-0.12, 0.5], [1.12, 0.5]] as const;
export type Area = [number, number, number, number];
export const apart = (a: Area, b: Area): boolean => a[2] <= b[0] || b[2] <= a[0] || a[3] <= b[1] || b[3] <= a[1];

/**
 * Sets the size of texts for a picture of so many pixels, and puts names where they cover no other text: the selected one first, then the near ones.
 * Hides those that have no room, also beside what lies over the view (`covered`). Depends on the view alone. Returns how many names are shown.
 */
export function placeTexts(texts: Sprite[], camera: PerspectiveCamera, width: number, height: number, covered: readonly Area[] = []): number {
  const one = (2 * Math.tan((camera.fov * Math.PI) / 360)) / height;  // a pixel
  const taken = [...covered];
  const seen = texts.filter(({ visible }) => visible).map((sprite) => {
    const { x, y, z } = sprite.getWorldPosition(new Vector3()).project(camera);
    const text = textOf(sprite);
    sprite.scale.set(one * text.width, one * text.height, 1);
    return { sprite, text, z, x: (0.5 + 0.5 * x) * width, y: (0.5 - 0.5 * y) * height };
  });
  const areaAt = ({ text, x, y }: typeof seen[number], [u, v]: readonly [number, number]): Area =>
    [x - u * text.width, y - (1 - v) * text.height, x + (1 - u) * text.width, y + v * text.height];
  for (const mark of seen) if (!mark.text.name) taken.push(areaAt(mark, [0.5, 0.5]));
  const names = seen.filter(({ text }) => text.name).sort((a, b) => Number(b.text.first) - Number(a.text.first) || a.z - b.z);
  let shown = 0;
  for (const name of names) {
    const free = (area: Area): boolean => area[0] >= 0 && area[2] <= width && area[1] >= 0 && area[3] <= height && taken.every((other) => apart(area, other));
    const side = name.z < 1 ? sides.find((where) => free(areaAt(name, where))) : undefined;
    name.sprite.visible = side !== undefined;
    if (!side) continue;
    taken.push(areaAt(name, side));
    name.sprite.center.set(side[0], side[1]);
    ++shown;
  }
  return shown;
}
