// What stands still in space: the ground, solids as prisms of their footprints, lines of equal height, tags.
import { BoxGeometry, BufferGeometry, CanvasTexture, Color, DoubleSide, ExtrudeGeometry, Float32BufferAttribute, Group, Line,
  LineBasicMaterial, Mesh, MeshLambertMaterial, NearestFilter, PlaneGeometry, Shape, SRGBColorSpace, Vector2 } from "three";
import type { Box } from "../base/camera";
import { clamp, finite, roundStep } from "../base/numbers";
import { roundedPoints, type Vec2 } from "../base/outline";
import { theme } from "../base/theme";
import type { Run } from "../report/run";
import { highestOf } from "./ground_layer";

export function lineOf(points: number[][], colour: string, opacity = 1): Line {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points.flatMap(([x = 0, y = 0, z = 0]) => [x, y, z]), 3));
  return new Line(geometry, new LineBasicMaterial({ color: colour, opacity, transparent: opacity < 1 }));
}

/** A prism between two heights. */
export function prism(outline: Vec2[], low: number, high: number, material: MeshLambertMaterial): Mesh {
  const shape = new Shape(outline.map(([x, y]) => new Vector2(x, y)));
  const mesh = new Mesh(new ExtrudeGeometry(shape, { depth: Math.max(1e-3, high - low), bevelEnabled: false }), material);
  mesh.position.z = low;
  return mesh;
}

function groundOf([x0, y0, x1, y1]: Box, colour: string): Group {
  const group = new Group();
  const floor = new Mesh(new PlaneGeometry(x1 - x0, y1 - y0), new MeshLambertMaterial({ color: colour, side: DoubleSide }));
  floor.position.set((x0 + x1) / 2, (y0 + y1) / 2, -0.01);
  group.add(floor);
  const step = roundStep(Math.max(x1 - x0, y1 - y0) / 24);
  for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) group.add(lineOf([[x, y0], [x, y1]], theme.line));
  for (let y = Math.ceil(y0 / step) * step; y <= y1; y += step) group.add(lineOf([[x0, y], [x1, y]], theme.line));
  return group;
}

/** A picture laid on the ground, as the map of costs or the map that is discovered. */
export function carpet(canvas: HTMLCanvasElement, [x0, y0, x1, y1]: Box, height: number): { mesh: Mesh; texture: CanvasTexture } {
  const texture = new CanvasTexture(canvas);
  texture.magFilter = texture.minFilter = NearestFilter;
  texture.colorSpace = SRGBColorSpace;
  texture.generateMipmaps = false;
  const mesh = new Mesh(new PlaneGeometry(x1 - x0, y1 - y0), new MeshLambertMaterial({ map: texture, transparent: true }));
  mesh.position.set((x0 + x1) / 2, (y0 + y1) / 2, height);
  return { mesh, texture };
}

export function stillWorld(run: Run, area: Box): Group {
  const group = groundOf(area, run.report.explore ? theme.ground : theme.yard);
  const { world, drive } = run.report;
  const highest = Math.max(1e-3, highestOf(run));
  for (const solid of world.solids) {
    const [low, high] = [finite(solid.low_z_m), finite(solid.high_z_m)];
    if (high <= low || solid.kind === "height_field") continue;
    const tone = new Color(theme["solid-low"]).lerp(new Color(theme["solid-high"]), Math.sqrt(clamp(high / highest, 0, 1)));
    const material = new MeshLambertMaterial({ color: tone, transparent: !solid.blocks_driving, opacity: solid.blocks_driving ? 1 : 0.55, side: DoubleSide });
    for (const piece of solid.footprint) {
      const outline = roundedPoints(piece.core, piece.radius_m);
      if (outline.length > 2) group.add(prism(outline, low, high, material));
    }
  }
  for (const { height_m, points } of world.terrain?.contours ?? []) {
    group.add(lineOf(points.map(([x, y]) => [x, y, height_m]), theme.soft));
  }
  for (const tag of drive?.tags ?? []) {
    const board = new Mesh(new BoxGeometry(0.01, tag.size_m, tag.size_m), new MeshLambertMaterial({ color: theme.ink }));
    board.position.set(tag.position[0], tag.position[1], 0.3);
    board.rotation.z = tag.facing_rad;
    group.add(board);
  }
  return group;
}

