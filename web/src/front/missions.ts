// Titles of the cards of missions, and their order.
import type { FileRow } from "../api";

export interface Mission { path: string; title: string; job: string; about: string }

const sentence = (words: string): string => words.charAt(0).toUpperCase() + words.slice(1);
const plain = (name: string): string => name.replace(/[_-]+/g, " ").trim();

/** A name for people: "explore/narrow_corridor.yaml" is "Narrow corridor", "yard/yard.yaml" is "Yard". */
export function titleOf(path: string): string {
  const name = path.split("/").at(-1)!.replace(/\.ya?ml$/i, "");
  return sentence(plain(name)) || path;
}

/** Adds the folder to titles that are not unique and do not say it: "Office (explore)", "Office (slam)", "Yard" of yard/yard.yaml. */
function distinct(missions: Mission[]): Mission[] {
  const count = (title: string): number => missions.filter((one) => one.title === title).length;
  return missions.map((one) => {
    const folder = one.path.split("/").slice(0, -1).join("/");
    return count(one.title) > 1 && folder && titleOf(folder) !== one.title ? { ...one, title: `${one.title} (${folder})` } : one;
  });
}

/** The scenarios among the files: `first`, if it is there, then by path. A scenario with the name of its folder comes first in it. */
export function missionsOf(files: readonly FileRow[], first = ""): Mission[] {
  const rank = (path: string): string => {
    if (path === first) return "";
    const [folder = "", name = ""] = path.split("/").slice(-2);
    return path.replace(/[^/]*$/, (last) => (name === `${folder}.yaml` ? " " : last));
  };
  const missions = files.filter(({ kind }) => kind === "scenario")
    .map(({ path, job, description }) => ({ path, title: titleOf(path), job: job ?? "", about: description ?? "" }));
  return distinct(missions).sort((a, b) => (rank(a.path) < rank(b.path) ? -1 : 1));
}
