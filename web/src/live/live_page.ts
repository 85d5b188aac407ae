// The live view: shows one mission while it runs with the same views as afterwards. When it has ended, its report
// replaces the live data.
import { getJson, getText, send, type RunRow } from "../api";
import { heading, title } from "../banner";
import { h } from "../base/dom";
import { formatAddress } from "../base/url";
import { parseReport, type Report } from "../report/types";
import { Watch } from "../watch/watch";
import { Growth } from "./growth";
import { Socket, type Message } from "./socket";

/** The interval at which new data is shown. */
const rest_ms = 200;
const over = new Set(["done", "not_done", "refused", "cancelled", "failed"]);
/** States in which the planning page shows a finished plan, or that there is none, because a plan leaves no report. */
const showsPlan = new Set(["done", "not_done", "refused"]);
const isFile = (scenario: string): boolean => /\.ya?ml$/.test(scenario);
const stateWords: Record<string, string> = {
  queued: "Waiting for its turn", running: "Running", done: "Done", not_done: "Not done", refused: "Refused", cancelled: "Cancelled", failed: "Failed",
};

export class LivePage {
  readonly element = h("div", { class: "live-page" });
  private name = h("h1");
  private state = h("b", { class: "run-state" }, "Connecting");
  private words = h("span", { class: "run-words" });
  private bar = h("progress", { max: 1, "aria-label": "Progress" });
  private cancel = h("button", { type: "button", class: "button", onclick: () => void this.stop() }, "Cancel");
  private head = h("div", { class: "run-head" }, this.name, this.state, this.words, this.bar, this.cancel);
  /** Explains why nothing or not everything is drawn. */
  private omitted = h("p", { class: "hint", role: "status", hidden: true });
  private growth = new Growth();
  private socket: Socket | null = null;
  private watch: Watch | null = null;
  private timer = 0;
  private seen = 0;
  private present = "queued";
  private ended = false;
  private closed = false;

  constructor(private id: string, private query: Record<string, string>) {
    this.element.append(this.head, this.omitted);
    void this.begin();
  }

  close(): void {
    this.closed = true;
    clearTimeout(this.timer);
    this.socket?.close();
    this.watch?.close();
  }

  /** Shows a finished run as any report. For other runs, the server sends all messages so far, then new ones. */
  private async begin(): Promise<void> {
    const run = await getJson<RunRow>(`runs/${this.id}`).catch((error: Error) => error);
    if (this.closed) return;
    if (run instanceof Error) {
      this.notFound(run.message);
    } else if (over.has(run.state) && run.has_report) {
      void this.end(run);
    } else {
      this.socket = new Socket(() => [{ type: "watch", run: this.id, from: this.seen }], (message) => this.receive(message), (connected) => {
        if (connected) this.show(this.present);
        else if (!this.ended) this.state.textContent = "Connection lost, trying again";
      });
    }
  }

  private notFound(sentence: string): void {
    this.state.textContent = "Not found";
    this.words.textContent = sentence;
    this.bar.hidden = this.cancel.hidden = true;
  }

  private receive(message: Message): void {
    if (message.type === "error") this.notFound(String(message.error));
    if (message.run !== this.id) return;
    this.seen = Math.max(this.seen, Number(message.seq ?? 0));
    if (this.growth.receive(message)) this.timer ||= window.setTimeout(() => this.grow(), this.watch ? rest_ms : 0);
    if (message.type === "omitted") {
      this.omitted.hidden = false;
      this.omitted.textContent = `${message.what === "scene" ? "Not drawn while it runs" : "Not all is drawn while it runs"}: ${String(message.sentence)}.`;
    }
    if (message.type === "state") this.show(String(message.state));
    if (message.type === "progress") {
      const { step, steps, name, part } = message as unknown as { step: number; steps: number; name: string; part: number };
      this.show("running");
      this.words.textContent = `${name}, step ${step} of ${steps}`;
      this.bar.value = steps > 0 ? Math.min(1, (step - 1 + part) / steps) : part;
    }
    if (message.type === "end") void this.end(message as unknown as RunRow);
  }

  private show(state: string): void {
    this.present = state;
    this.element.dataset.state = state;
    this.state.textContent = stateWords[state] ?? state;
    this.state.className = `run-state ${state}`;
    this.cancel.hidden = over.has(state);
    this.bar.hidden = over.has(state);
  }

  /** Updates the view to the data received so far. */
  private grow(): void {
    clearTimeout(this.timer);
    this.timer = 0;
    const { report } = this.growth;
    if (!report) return;
    this.name.replaceWith(this.name = heading(report));
    this.element.dataset.samples = String(report.track.length);
    this.display(report);
  }

  private display(report: Report): void {
    if (this.watch) {
      this.watch.renew(report, !this.ended);
      return;
    }
    this.watch = new Watch(report, this.query, !this.ended);
    this.element.append(this.watch.element);
  }

  private async stop(): Promise<void> {
    this.cancel.disabled = true;
    await send("DELETE", `runs/${this.id}`).catch((error: Error) => { this.words.textContent = error.message; });
    this.cancel.disabled = false;
  }

  /** Shows the report if the run left one, in place of the live data; otherwise why there is none. */
  private async end(run: RunRow): Promise<void> {
    if (this.ended) return;
    this.ended = true;
    this.show(run.state);
    this.words.textContent = run.error || run.scenario;
    if (!run.has_report) {
      this.grow();
      if (run.job === "plan" && showsPlan.has(run.state) && isFile(run.scenario)) {
        location.replace(formatAddress({ view: "change", path: run.scenario, query: {} }));
      }
      return;
    }
    try {
      const text = await getText(`runs/${this.id}/report`);
      if (this.closed) return;
      const report = parseReport(text);
      if (typeof report === "string") throw new Error(report);
      clearTimeout(this.timer);
      this.display(report);
      this.omitted.hidden = true;
      this.head.replaceChildren(...title(report, text.match(/"seed": ?(\d+)/)?.[1] ?? ""));
    } catch (error) {
      this.grow();
      this.words.textContent = error instanceof Error ? error.message : String(error);
    }
  }
}
