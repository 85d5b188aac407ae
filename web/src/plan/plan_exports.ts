// Exports of the planning page: the first view, map and path as a drawing in metres, the answers.
import type { MenuItem } from "../base/menu";
import { saveCanvas, saveText } from "../base/save";
import type { Pane, Scene } from "./pane";
import { pathSvg } from "./path_svg";

export function planExports(map: string, scene: Scene, panes: Pane[]): MenuItem[] {
  const [first] = panes;
  if (!first) return [];
  const name = `${map}-${first.answer?.planner ?? "plan"}`;
  /** Without what only the page draws. */
  const answers = panes.flatMap(({ answer }) => (answer ? { ...answer, trace: undefined, blocked: undefined, legs: undefined } : []));
  return [
    { name: "PNG", about: "the first view as a picture", key: "s", act: () => saveCanvas(first.canvas, `${name}.png`) },
    { name: "SVG", about: "map and path, in metres", key: "g", act: () => saveText(pathSvg(scene, first.answer), `${name}.svg`, "image/svg+xml") },
    { name: "JSON", about: "the answers, with their paths", key: "J", act: () => saveText(JSON.stringify(answers, null, 1), `${name}.json`),
      refusal: answers.length < panes.length && "when the answer is there" },
  ];
}
