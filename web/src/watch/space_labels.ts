// Names in space: of targets, always as large on the screen, before whatever stands between.
import { CanvasTexture, LinearFilter, Sprite, SpriteMaterial, SRGBColorSpace } from "three";
import { theme } from "../base/theme";
import type { Run } from "../log/run";
import { targetsOf } from "../log/targets";
import { label } from "./layer";
import type { Actor } from "./space_parts";

const [height_px, dense] = [20, 2];
/** Size of a sprite that is as high as the view is 1. */
const share = 1 / 30;

function nameSprite(text: string): Sprite {
  const canvas = document.createElement("canvas");
  const font = `500 ${13 * dense}px ${theme.sans}`;
  const pen = canvas.getContext("2d")!;
  pen.font = font;
  canvas.width = Math.ceil(pen.measureText(text).width) + 12 * dense;
  canvas.height = height_px * dense;
  pen.font = font;
  pen.textBaseline = "middle";
  pen.scale(1, 1);
  label(pen, text, 6 * dense, canvas.height / 2, theme.ink, theme.yard);
  const map = new CanvasTexture(canvas);
  map.colorSpace = SRGBColorSpace;
  map.minFilter = LinearFilter;
  const sprite = new Sprite(new SpriteMaterial({ map, sizeAttenuation: false, depthTest: false, transparent: true }));
  sprite.scale.set((share * canvas.width) / canvas.height, share, 1);
  sprite.center.set(0.5, -0.25);
  sprite.renderOrder = 2;
  return sprite;
}

export const labelActor = (run: Run): Actor[] => targetsOf(run).map((target) => {
  const sprite = nameSprite(target.name.length > 28 ? `${target.name.slice(0, 27)}\u2026` : target.name);
  return { things: [sprite], act: ({ t }) => {
    const place = target.placeAt(t);
    sprite.visible = place !== null;
    if (place) sprite.position.set(place[0], place[1], target.centre[2] + target.last.size.z / 2);
  } };
});
