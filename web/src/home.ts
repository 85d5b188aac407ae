// The home page: the files in the served folder, namely runs to watch, scenarios to run, maps to plan on.
import type { FileRow } from "./api";
import { h } from "./base/dom";
import { formatAddress } from "./base/url";
import { editorOf } from "./plan/editors";

const views = { run: "watch", scenario: "live", map: "plan", other: "" } as const;
const groups = [
  ["run", "Runs", "what happened, to watch again"],
  ["scenario", "Scenarios", "missions to run"],
  ["map", "Maps", "ground to plan on"],
] as const;

const size = (bytes: number): string =>
  (bytes < 1000 ? `${bytes} B` : bytes < 1e6 ? `${(bytes / 1e3).toFixed(0)} kB` : `${(bytes / 1e6).toFixed(1)} MB`);

/** Logs are known by their names. */
const kindOf = ({ path, kind }: FileRow): FileRow["kind"] => (path.endsWith(".mcap") ? "run" : kind);

function row(file: FileRow): HTMLElement {
  const change = { view: "change", path: file.path, query: {} };
  const editor = editorOf(file);
  const address = editor === "question" ? change
    : file.kind === "scenario" ? { view: "live", path: "", query: { scenario: file.path } } : { view: views[kindOf(file)], path: file.path, query: {} };
  return h("li", { "data-path": file.path }, h("a", { href: formatAddress(address) }, h("span", { class: "name" }, file.path),
    h("span", { class: "kind" }, file.job ?? ""), h("span", { class: "size" }, size(file.bytes))),
  editor === "yard" && h("a", { class: "change", href: formatAddress(change), title: "Move its robot and its targets" }, "change"));
}

export function home(folder: string, files: FileRow[], open: (files: File[]) => void): HTMLElement {
  const filter = h("input", { type: "text", placeholder: "Filter", "aria-label": "Filter the files", id: "filter" });
  const input = h("input", { type: "file", multiple: true, hidden: true });
  input.addEventListener("change", () => open([...(input.files ?? [])]));
  const lists = groups.map(([kind, name, what]) => {
    const some = files.filter((file) => kindOf(file) === kind);
    return h("section", { class: "panel group" }, h("h2", {}, name, h("span", {}, ` ${what}`)),
      some.length > 0 ? h("ul", { class: "rows" }, ...some.map(row)) : h("p", { class: "none" }, "None in this folder."));
  });
  filter.addEventListener("input", () => {
    for (const list of lists) for (const one of list.querySelectorAll<HTMLElement>("li")) one.hidden = !one.dataset.path!.includes(filter.value);
  });
  return h("div", { class: "page" }, h("div", { class: "page-head" }, h("h1", {}, folder), filter,
    h("a", { class: "button", href: "#draw" }, "Draw a map"),
    h("button", { type: "button", class: "button", onclick: () => input.click() }, "Open a file"), input),
  h("p", { class: "hint" }, "Drop a run (.mcap) or a map anywhere on this page: map_server, PNG, SDF, MovingAI or polygons."),
  h("div", { class: "groups" }, ...lists));
}
