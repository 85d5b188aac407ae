// Pieces that things in space are made of: prisms, lines, ribbons on the ground, pictures laid on it.
import { BufferAttribute, BufferGeometry, CanvasTexture, DoubleSide, ExtrudeGeometry, Float32BufferAttribute, Line, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, NearestFilter, PlaneGeometry, Shape, SRGBColorSpace, Vector2 } from "three";
import type { Object3D } from "three";
import type { Box } from "../base/camera";
import type { Vec2 } from "../base/outline";
import type { Vec3 } from "../log/geometry";
import type { Now } from "./layer";

/** A thing in space, and how it follows the time. */
export interface Actor { things: Object3D[]; act?: (now: Now) => void }

export const lambert = (colour: string, opacity = 1): MeshLambertMaterial =>
  new MeshLambertMaterial({ color: colour, transparent: opacity < 1, opacity });

/** A material of one colour that ignores light and hides nothing, for things that are no solids. */
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

function put(into: Float32Array | Uint32Array, at: number, a: number, b: number, c: number, d: number, e: number, f: number): void {
  into[at] = a;
  into[at + 1] = b;
  into[at + 2] = c;
  into[at + 3] = d;
  into[at + 4] = e;
  into[at + 5] = f;
}

/** A band along a way (x, y, z, x, y, z, ...), flat as the ground; two triangles for each step of it. */
export function ribbon(way: Float64Array, width: number, colour: string): Mesh {
  const count = way.length / 3;
  const points = new Float32Array(6 * count);
  const corners = new Uint32Array(6 * Math.max(0, count - 1));
  let [ax, ay] = [0, 0];  // from the middle to the left
  for (let i = 0; i < count; ++i) {
    const [before, here, after] = [3 * Math.max(0, i - 1), 3 * i, 3 * Math.min(i + 1, count - 1)];
    const [dx, dy] = [way[after]! - way[before]!, way[after + 1]! - way[before + 1]!];
    const length = Math.hypot(dx, dy);
    if (length > 0) [ax, ay] = [(-0.5 * width * dy) / length, (0.5 * width * dx) / length];
    const [x, y, z] = [way[here]!, way[here + 1]!, way[here + 2]!];
    put(points, 6 * i, x + ax, y + ay, z, x - ax, y - ay, z);
    if (i > 0) put(corners, 6 * i - 6, 2 * i - 2, 2 * i - 1, 2 * i, 2 * i, 2 * i - 1, 2 * i + 1);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(points, 3));
  geometry.setIndex(new BufferAttribute(corners, 1));
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
