// The still things in space: the ground, hills with lines of equal height, solids as prisms of their footprints.
import { BufferGeometry, Color, DoubleSide, Float32BufferAttribute, Group, Mesh, MeshLambertMaterial, type MeshLambertMaterialParameters, PlaneGeometry } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { Box } from "../base/camera";
import { clamp, roundStep } from "../base/numbers";
import { nearestOnPolygon, roundedPoints, type Rounded } from "../base/outline";
import { theme } from "../base/theme";
import type { Vec3 } from "../log/geometry";
import type { Relief } from "../log/relief";
import type { Run } from "../log/run";
import { topic } from "../log/topics";
import { bodiesOf, slopesOf } from "../log/world";
import { highestOf } from "./ground_layer";
import { lineOf, linesOf, prism } from "./space_parts";

function floorOf([x0, y0, x1, y1]: Box, colour: string): Group {
  const group = new Group();
  const floor = new Mesh(new PlaneGeometry(x1 - x0, y1 - y0), new MeshLambertMaterial({ color: colour, side: DoubleSide }));
  floor.position.set((x0 + x1) / 2, (y0 + y1) / 2, -0.01);
  group.add(floor);
  const step = roundStep(Math.max(x1 - x0, y1 - y0) / 24);
  const grid: Vec3[] = [];
  for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) grid.push([x, y0, 0], [x, y1, 0]);
  for (let y = Math.ceil(y0 / step) * step; y <= y1; y += step) grid.push([x0, y, 0], [x1, y, 0]);
  return group.add(linesOf(grid, theme.line));
}

const within = (x: number, y: number, { core, radius_m }: Rounded): boolean => nearestOnPolygon(x, y, core).distance <= radius_m + 1e-9;

/** The surface as it is collided with, darker where it is higher; what is too steep to drive on is tinted. */
export function hill(relief: Relief, steep: Rounded[]): Mesh {
  const { columns, rows } = relief.grid;
  const [bottom, top, danger] = [new Color(theme.yard), new Color(theme["solid-high"]), new Color(theme.failed)];
  const heights = Array.from(relief.grid.heights);
  const low = heights.reduce((least, z) => Math.min(least, z), Infinity);
  const span = heights.reduce((most, z) => Math.max(most, z - low), 1e-3);
  const tone = ([x, y, z]: Vec3): number[] =>
    bottom.clone().lerp(top, 0.2 + (0.4 * (z - low)) / span).lerp(danger, steep.some((piece) => within(x, y, piece)) ? 0.25 : 0).toArray();
  const posts: Vec3[] = [];
  const corners: number[] = [];
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      posts.push(relief.post(column, row));
      if (row + 1 === rows || column + 1 === columns) continue;
      const low = row * columns + column;
      corners.push(low, low + 1, low + columns + 1, low, low + columns + 1, low + columns);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(posts.flat(), 3));
  geometry.setAttribute("color", new Float32BufferAttribute(posts.flatMap(tone), 3));
  geometry.setIndex(corners);
  geometry.computeVertexNormals();
  return new Mesh(geometry, new MeshLambertMaterial({ vertexColors: true, side: DoubleSide }));
}

/** Two coats of solids that show what is behind them: the first only hides what is farther, of the second. */
function veil(prisms: Mesh[]): Mesh[] {
  if (prisms.length === 0) return [];
  const geometry = mergeGeometries(prisms.map((one) => one.geometry.translate(0, 0, one.position.z)));
  const coat = (order: number, options: MeshLambertMaterialParameters): Mesh => {
    const mesh = new Mesh(geometry, new MeshLambertMaterial({ color: theme["solid-high"], transparent: true, side: DoubleSide, ...options }));
    mesh.renderOrder = order;
    return mesh;
  };
  return [coat(1, { colorWrite: false }), coat(2, { opacity: 0.2, depthWrite: false })];
}

function solidsOf(run: Run): Mesh[] {
  const highest = Math.max(1e-3, highestOf(run));
  return bodiesOf(run).flatMap((solid) => {
    const { low, high } = solid;
    if (high <= low || solid.kind === "height_field") return [];
    const color = new Color(theme["solid-low"]).lerp(new Color(theme["solid-high"]), Math.sqrt(clamp(high / highest, 0, 1)));
    const material = new MeshLambertMaterial({ color, transparent: !solid.blocks_driving, opacity: solid.blocks_driving ? 1 : 0.55, side: DoubleSide });
    return solid.footprint.map((piece) => roundedPoints(piece.core, piece.radius_m)).filter((outline) => outline.length > 2)
      .map((outline) => prism(outline, low, high, material));
  });
}

/** Returns the world; the true walls are a shade of themselves if the map is what counts. */
export function stillWorld(run: Run, area: Box): Group {
  const mapped = run.log.has(topic.map);
  const slopes = slopesOf(run);
  const group = run.ground ? new Group().add(hill(run.ground, slopes?.steep ?? [])) : floorOf(area, mapped ? theme.ground : theme.yard);
  const solids = solidsOf(run);
  for (const one of mapped ? veil(solids) : solids) group.add(one);
  for (const { height, points } of slopes?.contours ?? []) {
    group.add(lineOf(points.map(([x, y]) => [x, y, height + 0.01]), theme.soft, 0.6));
  }
  return group;
}
