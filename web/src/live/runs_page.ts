// The runs page: lists the missions of this server, newest first, with a form that starts another.
import { getJson, startRun, type FileRow, type RunRow } from "../api";
import { h } from "../base/dom";
import { formatAddress } from "../base/url";
import { Socket } from "./socket";

export class RunsPage {
  readonly element: HTMLElement;
  private list = h("ul", { class: "rows", "aria-label": "Runs" });
  private refusal = h("p", { class: "refused", role: "alert" });
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
      void this.start(select.value, seed.value);
    });
    this.element = h("div", { class: "page" }, h("h1", {}, "Run a mission"), form, h("h2", {}, "Runs"), this.list);
    this.socket = new Socket({ opened: () => [{ type: "runs" }], receive: (message) => {
      if (message.type === "runs") this.show(message.runs as RunRow[]);
    } });
    void getJson<{ runs: RunRow[] }>("runs").then(({ runs }) => this.show(runs), () => undefined);
  }

  close(): void { this.socket.close(); }

  private async start(scenario: string, seed: string): Promise<void> {
    this.refusal.textContent = "";
    await startRun(scenario, seed === "" ? null : Number(seed)).catch((error: Error) => { this.refusal.textContent = error.message; });
  }

  private show(runs: RunRow[]): void {
    this.list.replaceChildren(...runs.map((run) => h("li", {}, h("a", { href: formatAddress({ view: "live", path: run.id, query: {} }) },
      h("span", { class: "name" }, run.scenario || "a text"), h("span", { class: "kind" }, run.job), h("span", { class: `run-state ${run.state}` }, run.state.replace("_", " "))))));
    if (runs.length === 0) this.list.replaceChildren(h("li", { class: "none" }, "None yet."));
  }
}
