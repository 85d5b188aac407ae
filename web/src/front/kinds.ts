// Names of the kinds of files.
import type { FileRow } from "../api";

const byEnding: [RegExp, string][] = [
  [/\.mcap$/, "log of a run"],
  [/\.ya?ml$/, "map with an image"],
  [/\.(png|pgm)$/, "image of a map"],
  [/\.(sdf|world)$/, "world (SDF)"],
  [/\.map$/, "grid map (MovingAI)"],
  [/\.txt$/, "polygon map"],
];

/** The kind of a file in words, by how its name ends: the server says log, map or result. */
export function kindWords({ path, kind }: Pick<FileRow, "path" | "kind">): string {
  const name = path.toLowerCase().replace(/\.gz$/, "");
  return byEnding.find(([ending]) => ending.test(name))?.[1] ?? kind;
}
