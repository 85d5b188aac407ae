// Scenes: what the ground of a scenario looks like, asked for once each and one after the other, since the server reads
// files for each.
import { getJson, scenePath, type SceneAnswer } from "./api";

const kept = new Map<string, Promise<SceneAnswer | null>>();
const most = 200;
let last: Promise<unknown> = Promise.resolve();

/** The scene of a scenario; null where it has none that can be drawn. */
export function sceneOf(path: string): Promise<SceneAnswer | null> {
  let asked = kept.get(path);
  if (asked) return asked;
  asked = last.then(() => getJson<SceneAnswer>(scenePath(path)).catch(() => null));
  last = asked;
  kept.set(path, asked);
  if (kept.size > most) kept.delete(kept.keys().next().value!);
  return asked;
}
