// Covering in space: the covered strip on the floor, what is out of reach, low walls along the area and about its holes.
import { BufferGeometry, DoubleSide, Float32BufferAttribute, Mesh, MeshLambertMaterial } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { Vec2 } from "../base/outline";
import { theme } from "../base/theme";
import { coverOf, type Cover } from "../log/cover";
import type { Vec3 } from "../log/geometry";
import type { Run } from "../log/run";
import { lastNotAfter } from "../log/track";
import { areaOf } from "./area";
import { coveredAlpha, outOfReach, passAt, pathOf, roleColours, stripOf, turnedRound, wayOf, type Role } from "./cover_layer";
import type { Now } from "./layer";
import { carpet, lineOf, ribbon, type Actor } from "./space_parts";
import { wayOnGround } from "./space_robot";
import { pictureSize, type View } from "./strip";

const mostPixels = 1400;

/** Upright faces along a closed outline. */
function wall(outline: Vec2[], height: number): Mesh {
  const points = outline.flatMap(([ax, ay], i) => {
    const [bx, by] = outline[(i + 1) % outline.length]!;
    return [ax, ay, 0, bx, by, 0, bx, by, height, ax, ay, 0, bx, by, height, ax, ay, height];
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  geometry.computeVertexNormals();
  return new Mesh(geometry, new MeshLambertMaterial({ color: theme["solid-high"], transparent: true, opacity: 0.75, side: DoubleSide }));
}

/** The way until now, in the colours of its roles. */
export function rolesActor(run: Run, cover: Cover, above: number, width: number): Actor[] {
  const { time: rows, x, y } = run.track;
  const placeAt = (t: number): Vec2 => {
    const at = run.track.at(t);
    return [at.x, at.y];
  };
  return (Object.keys(roleColours) as Role[]).flatMap((role) => {
    const reached: number[] = [];
    const ribbons = cover.passes.filter((one) => one.role === role).map(({ start, end }) => {
      const between = rows.slice(lastNotAfter(rows, start) + 1, Math.max(0, lastNotAfter(rows, end) + 1));
      const first = lastNotAfter(rows, start) + 1;
      const { time, way: places } = wayOnGround(run, [start, ...between, end], [placeAt(start), ...Array.from(between, (_, i): Vec2 => [x[first + i]!, y[first + i]!]), placeAt(end)], above);
      reached.push(...time.slice(1));
      return ribbon(places, width, theme[roleColours[role]]);
    });
    if (reached.length === 0) return [];
    const all = new Mesh(mergeGeometries(ribbons.map((one) => one.geometry)), ribbons[0]!.material);
    all.frustumCulled = false;
    return [{ things: [all], act: ({ t }: Now) => all.geometry.setDrawRange(0, t < reached[0]! ? 0 : 6 * (lastNotAfter(reached, t) + 1)) }];
  });
}

export function coverActor(run: Run): Actor[] {
  const cover = coverOf(run);
  if (!cover) return [];
  const box = areaOf(run);
  const [x0, y0, x1, y1] = box;
  const { size: [width, height], scale } = pictureSize(box, mostPixels);
  const view: View = { size: [width, height], name: "floor", px: 1 / scale,
    toPlane: (ctx) => ctx.setTransform(scale, 0, 0, -scale, -scale * x0, scale * y1) };
  const strip = stripOf(run, wayOf(run, cover), cover);
  const picture = document.createElement("canvas");
  [picture.width, picture.height] = [width, height];
  const around = pathOf([[[x0, y0], [x1, y0], [x1, y1], [x0, y1]]], turnedRound(cover.area));
  const [out, missed, overlap] = [outOfReach(cover), pathOf(cover.missed), pathOf(cover.overlap)];
  const across = Math.max(x1 - x0, y1 - y0);
  const layer = Math.max(0.004, 4e-4 * across);  // so far apart that none shows through another from afar
  const { mesh, texture } = carpet(picture, box, layer);
  const walls = cover.area.map((outline) => wall(outline, Math.max(0.25 * cover.width, 0.006 * across)));
  const planned = lineOf(cover.planned.map(([x, y]): Vec3 => [x, y, 2 * layer]), theme.soft, 0.6);

  function paint(ctx: CanvasRenderingContext2D, t: number): void {
    const fill = (path: Path2D | null, colour: string, alpha: number): void => {
      if (!path) return;
      ctx.fillStyle = colour;
      ctx.globalAlpha = alpha;
      ctx.fill(path);
    };
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.clearRect(0, 0, width, height);
    const covered = strip.paint(t, view, theme.reached);
    ctx.globalAlpha = 1.6 * coveredAlpha;  // the light takes some of it
    ctx.drawImage(covered, 0, 0);
    view.toPlane(ctx);
    fill(around, theme["solid-low"], 1);
    fill(out, theme.inflated, 1);
    if (!passAt(cover!, t)) {
      fill(overlap, theme.reached, coveredAlpha);
      fill(missed, theme.failed, 1);
    }
    ctx.globalAlpha = 1;
  }

  const floor: Actor = { things: [mesh, planned, ...walls], act: ({ t }) => {
    paint(picture.getContext("2d")!, t);
    texture.needsUpdate = true;
  } };
  return [floor, ...rolesActor(run, cover, 3 * layer, Math.min(0.2 * cover.width, Math.max(0.1 * cover.width, 0.0025 * across)))];
}
