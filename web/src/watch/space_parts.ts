// Pieces that things in space are made of: prisms, lines, ribbons on the ground, pictures laid on it.
import { BufferGeometry, CanvasTexture, DoubleSide, ExtrudeGeometry, Float32BufferAttribute, Line, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, NearestFilter, PlaneGeometry, Shape, SRGBColorSpace, Vector2 } from "three";
import type { Object3D } from "three";
import type { Box } from "../base/camera";
import type { Vec2 } from "../base/outline";
import type { Vec3 } from "../report/types";
import type { Now } from "./layer";

/** A thing in space, and how it follows the time. */
export interface Actor { things: Object3D[]; act?: (now: Now) => void }

export const lambert = (colour: string, opacity = 1): MeshLambertMaterial =>
  new MeshLambertMaterial({ color: colour, transparent: opacity < 1, opacity });

/** Of one colour whatever the light, and hiding nothing: for what is no body. */
export const glass = (colour: string, opacity: number): MeshBasicMaterial =>
  new MeshBasicMaterial({ color: colour, transparent: true, opacity, depthWrite: false, side: DoubleSide });

export function geometryOf(points: Vec3[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points.flat(), 3));
  return geometry;
}

const lineMaterial = (colour: string, opacity: number): LineBasicMaterial =>
  new LineBasicMaterial({ color: colour, opacity, transparent: opacity < 1 });
export const lineOf = (points: Vec3[], colour: string, opacity = 1): Line => new Line(geometryOf(points), lineMaterial(colour, opacity));
/** From the first to the second, from the third to the fourth, ... */
export const linesOf = (points: Vec3[], colour: string, opacity = 1): LineSegments => new LineSegments(geometryOf(points), lineMaterial(colour, opacity));

/** New places for a geometry of as many. */
export function moveTo(geometry: BufferGeometry, points: Vec3[]): void {
  const positions = geometry.getAttribute("position");
  points.forEach((point, i) => positions.setXYZ(i, ...point));
  positions.needsUpdate = true;
}

/** A band along a way, flat as the ground; two triangles for each step of it. */
export function ribbon(way: Vec3[], width: number, colour: string): Mesh {
  let aside: Vec2 = [0, 0];
  const points = way.flatMap(([x, y, z], i): Vec3[] => {
    const [before, after] = [way[Math.max(0, i - 1)]!, way[Math.min(i + 1, way.length - 1)]!];
    const [dx, dy] = [after[0] - before[0], after[1] - before[1]];
    const length = Math.hypot(dx, dy);
    if (length > 0) aside = [(-0.5 * width * dy) / length, (0.5 * width * dx) / length];
    return [[x + aside[0], y + aside[1], z], [x - aside[0], y - aside[1], z]];
  });
  const geometry = geometryOf(points);
  geometry.setIndex(way.slice(1).flatMap((_, i) => [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 2, 2 * i + 1, 2 * i + 3]));
  const mesh = new Mesh(geometry, new MeshBasicMaterial({ color: colour, side: DoubleSide }));
  mesh.frustumCulled = false;
  return mesh;
}

/** A prism between two heights. */
export function prism(outline: Vec2[], low: number, high: number, material: MeshLambertMaterial): Mesh {
  const shape = new Shape(outline.map(([x, y]) => new Vector2(x, y)));
  const mesh = new Mesh(new ExtrudeGeometry(shape, { depth: Math.max(1e-3, high - low), bevelEnabled: false }), material);
  mesh.position.z = low;
  return mesh;
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
