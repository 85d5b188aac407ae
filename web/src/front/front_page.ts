// The front page: what Outrider is, a run that moves, a card for each mission of the folder, and its other files.
import { startRun, type FileRow, type RunRow } from "../api";
import { h } from "../base/dom";
import "./front.css";
import { CardPictures } from "./card_picture";
import { exampleScenario } from "./example";
import { Hero } from "./hero";
import { missionCard } from "./mission_card";
import { missionsOf } from "./missions";
import { otherFiles } from "./other_files";

const sentence = "A ground robot finds its way, and does a job, in a yard or a building that it knows or maps itself.";

export class FrontPage {
  readonly element: HTMLElement;
  readonly title: string;
  private hero = new Hero();
  private pictures = new CardPictures();
  private refusal = h("p", { class: "refused", role: "alert" });

  constructor(folder: string, files: FileRow[], runs: readonly RunRow[], open: (files: File[]) => void) {
    this.title = folder;
    const input = h("input", { type: "file", multiple: true, hidden: true });
    input.addEventListener("change", () => open([...(input.files ?? [])]));
    const words = h("div", { class: "front-words" }, h("h1", {}, sentence), h("div", { class: "front-acts" },
      h("a", { class: "button primary", href: "#example" }, "Watch this run"), h("a", { class: "button", href: "#draw" }, "Draw a map"),
      h("button", { type: "button", class: "button", onclick: () => input.click() }, "Open a file"), input),
    h("p", { class: "hint" }, "Or drop a log (.mcap) or a map anywhere on this page: map_server, PNG, SDF, MovingAI or polygons."));
    const missions = missionsOf(files, exampleScenario);
    const cards = missions.map((mission) => missionCard(mission, runs, this.pictures.of(mission.path), (path) => void this.start(path)));
    const rest = otherFiles(files);
    this.element = h("div", { class: "page front" }, h("section", { class: "front-head" }, words, this.hero.element),
      h("div", { class: "page-head" }, h("h2", {}, `Missions in ${folder}`), filterOf(cards, missions.map(({ title, job, about, path }) => `${title} ${job} ${about} ${path}`), rest)), this.refusal,
      cards.length > 0 ? h("ul", { class: "cards" }, ...cards) : h("p", { class: "hint" }, "There is no scenario in this folder; the documentation of a job shows one."), rest);
  }

  close(): void {
    this.hero.close();
    this.pictures.close();
  }

  private async start(path: string): Promise<void> {
    this.refusal.textContent = "";
    await startRun(path).catch((error: Error) => { this.refusal.textContent = error.message; });
  }
}

/** A field that hides the cards and the files that do not hold its text. */
function filterOf(cards: readonly HTMLElement[], words: readonly string[], rest: HTMLElement): HTMLElement {
  const filter = h("input", { type: "text", placeholder: "Filter", "aria-label": "Filter missions and files", id: "filter" });
  filter.addEventListener("input", () => {
    const wanted = filter.value.toLowerCase();
    cards.forEach((card, i) => { card.hidden = !words[i]!.toLowerCase().includes(wanted); });
    for (const one of rest.querySelectorAll<HTMLElement>("li")) one.hidden = !one.dataset.path!.toLowerCase().includes(wanted);
  });
  return filter;
}
