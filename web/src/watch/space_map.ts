// The map as it was at a time, in space: a carpet of what is free, and its walls as high as the range finder sees.
import { BoxGeometry, DynamicDrawUsage, InstancedMesh, Matrix4 } from "three";
import { theme } from "../base/theme";
import { mapOf, occupied, type MapNow } from "../log/map";
import type { Run } from "../log/run";
import { laserMount } from "../log/sensed";
import { topic } from "../log/topics";
import { MapPicture } from "./map_layer";
import { carpet, lambert, type Actor } from "./space_parts";

/** Walls with room for so many cells. */
function wallsFor(count: number, cell_m: number, height: number): InstancedMesh {
  const walls = new InstancedMesh(new BoxGeometry(cell_m, cell_m, height), lambert(theme["solid-high"]), count);
  walls.instanceMatrix.setUsage(DynamicDrawUsage);
  walls.frustumCulled = false;
  return walls;
}

const boxOf = ({ origin: [x, y], columns, rows, cell_m }: MapNow): [number, number, number, number] => [x, y, x + columns * cell_m, y + rows * cell_m];

export function mapActor(run: Run): Actor[] {
  const last = run.log.has(topic.map) ? mapOf(run.log).at(run.duration) : null;
  if (!last || last.known === 0) return [];
  const { extent: { low, high }, cell_m } = last;
  const across = cell_m * Math.max(high[0] - low[0], high[1] - low[1]);
  const height = laserMount(run).height || Math.min(0.6, 0.1 + 0.02 * across);
  const most = last.cells.reduce((sum, value) => sum + Number(value >= occupied), 0);
  const walls = wallsFor(Math.max(64, 2 * most), cell_m, height);
  const picture = new MapPicture();
  picture.paint(last);
  let followed = -1;
  const { mesh, texture } = carpet(picture.canvas, boxOf(last), 0.002);
  const matrix = new Matrix4();

  /** The map may have grown or moved: its carpet and its walls follow. */
  function follow(map: MapNow): void {
    const { cells, columns, origin: [x, y] } = map;
    const [x0, y0, x1, y1] = boxOf(map);
    const [lx0, ly0, lx1, ly1] = boxOf(last!);
    mesh.scale.set((x1 - x0) / (lx1 - lx0), (y1 - y0) / (ly1 - ly0), 1);
    mesh.position.set((x0 + x1) / 2, (y0 + y1) / 2, 0.002);
    texture.dispose();  // its size may be another
    texture.needsUpdate = true;
    let count = 0;
    for (let i = 0; i < cells.length && count < walls.instanceMatrix.count; ++i) {
      if (cells[i]! < occupied) continue;
      matrix.makeTranslation(x + (i % columns + 0.5) * map.cell_m, y + (Math.floor(i / columns) + 0.5) * map.cell_m, height / 2);
      walls.setMatrixAt(count++, matrix);
    }
    walls.count = count;
    walls.instanceMatrix.needsUpdate = true;
  }

  return [{ things: [mesh, walls], act: ({ t }) => {
    const map = mapOf(run.log).at(t);
    mesh.visible = walls.visible = map !== null;
    if (!map || (!picture.paint(map) && map.version === followed)) return;
    followed = map.version;
    follow(map);
  } }];
}
