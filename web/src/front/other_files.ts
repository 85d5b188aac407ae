// The files that are no missions: logs to watch, maps to plan on.
import type { FileRow } from "../api";
import { h } from "../base/dom";
import { formatAddress } from "../base/url";
import { kindWords } from "./kinds";

const groups = [
  ["log", "watch", "Logs", "runs to watch again"],
  ["map", "plan", "Maps", "ground to plan on"],
] as const;

function row(file: FileRow, view: string): HTMLElement {
  return h("li", { "data-path": file.path }, h("a", { href: formatAddress({ view, path: file.path, query: {} }) },
    h("span", { class: "name" }, file.path), h("span", { class: "kind" }, kindWords(file))));
}

export function otherFiles(files: readonly FileRow[]): HTMLElement {
  return h("div", { class: "groups" }, ...groups.map(([kind, view, name, what]) => {
    const some = files.filter((file) => file.kind === kind);
    return h("section", { class: "panel group" }, h("h2", {}, name, h("span", {}, ` ${what}`)),
      some.length > 0 ? h("ul", { class: "rows" }, ...some.map((file) => row(file, view))) : h("p", { class: "none" }, "None in this folder."));
  }));
}
