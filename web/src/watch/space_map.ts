// The map as it is discovered, in space: a carpet of what is free, and its walls as high as the range finder sees.
import { BoxGeometry, InstancedMesh, Matrix4 } from "three";
import { theme } from "../base/theme";
import type { Run } from "../report/run";
import { Discovery } from "./explore_layer";
import { carpet, lambert, type Actor } from "./space_parts";

export function mapActor(run: Run): Actor[] {
  const { explore, slam } = run.report;
  const map = explore?.map ?? slam?.map;
  if (!map || map.columns === 0) return [];
  const { origin: [x, y], columns, rows, cell_m } = map;
  const discovery = new Discovery(map);
  const { mesh, texture } = carpet(discovery.canvas, [x, y, x + columns * cell_m, y + rows * cell_m], 0.002);
  const height = explore?.laser?.height_m ?? (explore ? 0.2 : Math.min(0.6, 0.1 + 0.02 * Math.max(columns, rows) * cell_m));
  const cells = discovery.occupied();
  const walls = new InstancedMesh(new BoxGeometry(cell_m, cell_m, height), lambert(theme["solid-high"]), cells.length);
  const matrix = new Matrix4();
  cells.forEach((cell, i) => {
    matrix.makeTranslation(x + (cell % columns + 0.5) * cell_m, y + (Math.floor(cell / columns) + 0.5) * cell_m, height / 2);
    walls.setMatrixAt(i, matrix);
  });
  walls.frustumCulled = false;
  return [{ things: [mesh, walls], act: ({ t }) => {
    discovery.paint(t);
    texture.needsUpdate = true;
    walls.count = discovery.knownAt(t, cells);
  } }];
}
