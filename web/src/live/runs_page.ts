// The runs page: lists the missions of this server, newest first, with a form that starts another.
import { mostCompared } from "../compare/differences";
import { getJson, startRun, type FileRow, type RunsAnswer } from "../api";
import { h } from "../base/dom";
import { formatAddress } from "../base/url";
import { runList } from "./run_list";
import { Socket } from "./socket";

/** The ages of runs are told anew after so long. */
const renewed_ms = 30_000;

export class RunsPage {
  readonly element: HTMLElement;
  private list = h("ul", { class: "rows", "aria-label": "Runs" });
  private notice = h("p", { class: "hint", role: "status" });
  private answer: RunsAnswer = { runs: [], notice: "" };
  private timer = window.setInterval(() => this.show(this.answer), renewed_ms);
  private refusal = h("p", { class: "refused", role: "alert" });
  private chosen = new Set<string>();
  private compare = h("button", { type: "button", class: "button", onclick: () => this.showCompared() }, "Compare");
  private socket: Socket;

  constructor(files: FileRow[], chosen: string) {
    const scenarios = files.filter((file) => file.kind === "scenario");
    const known = chosen === "" || scenarios.some(({ path }) => path === chosen);
    const select = h("select", { id: "scenario", "aria-label": "Scenario", required: true }, known ? null : h("option", { value: "", selected: true, disabled: true }, "Choose a scenario"),
      ...scenarios.map((file) => h("option", { value: file.path, selected: file.path === chosen }, file.path)));
    if (!known) this.refusal.textContent = `${chosen}: there is no such scenario under the folder; choose another.`;
    const seed = h("input", { type: "number", min: 0, step: 1, placeholder: "as it says", "aria-label": "Seed", id: "seed" });
    const form = h("form", { class: "start panel" }, h("label", {}, "Scenario ", select), h("label", {}, "seed ", seed),
      h("button", { type: "submit", class: "button primary", disabled: scenarios.length === 0 }, "Run"), this.refusal);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.start(select.value, seed.value === "" ? null : Number(seed.value));
    });
    this.element = h("div", { class: "page" }, h("h1", {}, "Run a mission"), form, h("div", { class: "page-head" }, h("h2", {}, "Runs"), this.compare), this.notice, this.list);
    this.socket = new Socket({ opened: () => [{ type: "runs" }], receive: (message) => {
      if (message.type === "runs") this.show(message as unknown as RunsAnswer);
    } });
    void getJson<RunsAnswer>("runs").then((answer) => this.show(answer), () => undefined);
  }

  close(): void {
    clearInterval(this.timer);
    this.socket.close();
  }

  private async start(scenario: string, seed: number | null): Promise<void> {
    this.refusal.textContent = "";
    await startRun(scenario, seed).catch((error: Error) => { this.refusal.textContent = error.message; });
  }

  /** Two are compared or more; where there is room for no other, it takes the place of the first. */
  private choose(id: string, on: boolean): void {
    if (on) this.chosen.add(id);
    else this.chosen.delete(id);
    if (this.chosen.size > mostCompared) this.chosen.delete([...this.chosen][0]!);
    this.show(this.answer);
  }

  private showChoice(): void {
    this.compare.disabled = this.chosen.size < 2;
    this.compare.title = this.compare.disabled ? "Choose two runs or more that left a log" : "Show them beside each other, and where their numbers differ";
  }

  /** The older one comes first. */
  private showCompared(): void {
    const ids = this.answer.runs.map(({ id }) => id).filter((id) => this.chosen.has(id)).reverse();
    location.hash = formatAddress({ view: "compare", path: "", query: { runs: ids.join(",") } });
  }

  private show(answer: RunsAnswer): void {
    this.answer = answer;
    this.notice.textContent = answer.notice ? `${answer.notice[0]!.toUpperCase()}${answer.notice.slice(1)}.` : "";
    const held = document.activeElement?.closest<HTMLElement>("[data-run]")?.dataset.run;
    const tag = document.activeElement?.tagName.toLowerCase();
    this.list.replaceChildren(...runList(answer.runs, Date.now() / 1000, { again: (run) => void this.start(run.scenario, run.seed), chosen: this.chosen, choose: (run, on) => this.choose(run.id, on) }));
    this.showChoice();
    if (held) this.list.querySelector<HTMLElement>(`[data-run="${held}"] ${tag}`)?.focus();
  }
}
