// The plan in space: from where targets can be hit, the tour with its stops, the places that an exploration compares.
import { type BufferGeometry, CanvasTexture, Mesh, MeshBasicMaterial, NearestFilter, PlaneGeometry, SRGBColorSpace } from "three";
import { theme } from "../base/theme";
import type { Decision } from "../log/messages";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { firingMapOf, tourOf } from "../log/tours";
import { areaOf } from "./area";
import { firingPicture } from "./firing_map_layer";
import { numberSprite } from "./space_labels";
import { ribbon, type Actor } from "./space_parts";
import { radiusOf, wayOnGround } from "./space_robot";

const most_segments = 160;  // along a side of what lies on hills

/** Lifts each corner of a plane about the origin to the ground below it. */
function drape(geometry: BufferGeometry, run: Run, x: number, y: number): void {
  const corners = geometry.getAttribute("position");
  for (let i = 0; i < corners.count; ++i) corners.setZ(i, run.height(x + corners.getX(i), y + corners.getY(i)));
}

export function firingMapActor(run: Run): Actor[] {
  const grid = firingMapOf(run)?.message;
  if (!grid) return [];
  const { origin: { position }, width, height, resolution } = grid.info;
  const [x, y] = [position.x + 0.5 * width * resolution, position.y + 0.5 * height * resolution];
  const texture = new CanvasTexture(firingPicture(grid, theme.water));
  texture.magFilter = texture.minFilter = NearestFilter;
  texture.generateMipmaps = false;
  texture.colorSpace = SRGBColorSpace;
  const segments = (cells: number): number => (run.ground ? Math.min(most_segments, cells) : 1);
  const sheet = new Mesh(new PlaneGeometry(width * resolution, height * resolution, segments(width), segments(height)),
    new MeshBasicMaterial({ map: texture, transparent: true, opacity: 0.45, depthWrite: false }));
  if (run.ground) drape(sheet.geometry, run, x, y);
  sheet.position.set(x, y, 0.01);
  return [{ things: [sheet] }];
}

export function tourActor(run: Run): Actor[] {
  const tour = tourOf(run);
  if (!tour || tour.stops.length === 0) return [];
  const [x0, y0, x1, y1] = areaOf(run);
  const { way } = wayOnGround(run, tour.way.map(() => 0), tour.way, 0.016);
  const stops = tour.stops.map(({ at: [x, y] }, i) => numberSprite(i + 1, false, [x, y, run.height(x, y)]));
  return [{ things: [ribbon(way, Math.max(0.15 * radiusOf(run), 0.003 * Math.max(x1 - x0, y1 - y0)), theme.open), ...stops] }];
}

/** The places that the present decision compared, in their order; the chosen one is filled. */
export function candidateActor(run: Run): Actor[] {
  const decisions = run.log.messages<Decision>(topic.decisions);
  const most = decisions.reduce((sum, { message }) => Math.max(sum, message.candidates?.length ?? 0), 0);
  const marks = Array.from({ length: most }, (_, i) => [false, true].map((chosen) => numberSprite(i + 1, chosen, [0, 0, 0])));
  if (most === 0) return [];
  return [{ things: marks.flat(), act: ({ t }) => {
    const candidates = run.log.latest<Decision>(topic.decisions, t)?.candidates ?? [];
    marks.forEach((pair, i) => pair.forEach((sprite, filled) => {
      const one = candidates[i];
      sprite.visible = one !== undefined && Number(one.chosen) === filled;
      if (one) sprite.position.set(one.position.x, one.position.y, run.height(one.position.x, one.position.y));
    }));
  } }];
}
