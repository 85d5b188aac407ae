// The view of the robot's camera in space: its pyramid of view, tags.
import { BoxGeometry, CanvasTexture, Group, Matrix4, Mesh, MeshLambertMaterial, PlaneGeometry, SRGBColorSpace, Vector3 } from "three";
import { theme } from "../base/theme";
import type { Vec3 } from "../log/geometry";
import type { Tag } from "../log/messages";
import type { Run } from "../log/run";
import { cornerRays, eyeOf, lensAt, middleOf, Sight, tagsOf } from "./eye";
import { geometryOf, glass, linesOf, moveTo, type Actor } from "./space_parts";

/** Not its true pattern: a frame with its number. */
function drawnFace(tag: Tag): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 128;
  const ctx = canvas.getContext("2d")!;
  for (const [colour, margin] of [["#fff", 0], ["#000", 12], ["#fff", 30]] as const) {
    ctx.fillStyle = colour;
    ctx.fillRect(margin, margin, 128 - 2 * margin, 128 - 2 * margin);
  }
  ctx.fillStyle = "#000";
  ctx.font = `700 ${tag.id > 99 ? 34 : 48}px sans-serif`;
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  ctx.fillText(String(tag.id), 64, 67);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

const faces = new WeakMap<Tag, CanvasTexture>();

/** Drawn once, however often the run grows. */
function face(tag: Tag): CanvasTexture {
  if (!faces.has(tag)) faces.set(tag, drawnFace(tag));
  return faces.get(tag)!;
}

function board(tag: Tag, middle: Vec3): Group {
  const group = new Group();
  const size = 1.25 * tag.size;  // with its white margin
  const paper = new Mesh(new PlaneGeometry(size, size), new MeshLambertMaterial({ map: face(tag) }));
  paper.applyMatrix4(new Matrix4().makeBasis(new Vector3(0, 1, 0), new Vector3(0, 0, 1), new Vector3(1, 0, 0)));
  const back = new Mesh(new BoxGeometry(0.01, size, size), new MeshLambertMaterial({ color: theme.soft }));
  back.position.x = -0.006;
  group.add(paper, back);
  group.position.set(...middle);
  group.rotation.z = tag.facing;
  return group;
}

/** Tags, the pyramid of what the camera has in its picture, and lines to the tags it took the pose from. */
export function eyeActor(run: Run): Actor[] {
  const tags = tagsOf(run);
  if (tags.length === 0) return [];
  const boards = tags.map((tag) => board(tag, middleOf(tag, eyeOf(run) ?? undefined)));
  const sight = Sight.of(run);
  if (!sight) return [{ things: boards }];
  const { eye } = sight;
  const depth = 0.3 * sight.reach;
  const rays = cornerRays(eye);
  const corners = rays.map(([x, y, z]): Vec3 => [depth * x, depth * y, depth * z]);
  const lens: Vec3 = [0, 0, 0];
  const pyramid = new Group();
  pyramid.add(linesOf(corners.flatMap((corner, i) => [lens, corner, corner, corners[(i + 1) % 4]!]), theme.water, 0.8),
    new Mesh(geometryOf(corners.flatMap((corner, i) => [lens, corner, corners[(i + 1) % 4]!])), glass(theme.water, 0.1)));
  const lines = linesOf(tags.flatMap(() => [lens, lens]), theme.water);
  lines.frustumCulled = false;
  return [{ things: [...boards, pyramid, lines], act: ({ t }) => {
    const at = run.track.at(t);
    const from: Vec3 = [...lensAt(eye, at), eye.above];
    pyramid.position.set(...from);
    pyramid.rotation.z = at.heading;
    const seen = sight.tagsSeen(t, at);
    moveTo(lines.geometry, seen.flatMap((tag) => [from, middleOf(tag, eye)]));
    lines.geometry.setDrawRange(0, 2 * seen.length);
  } }];
}
