// Live: one mission, drawn as it runs; when it has ended, its report.
import { getText, send, type RunRow } from "../api";
import { title } from "../banner";
import { h } from "../base/dom";
import { clockText } from "../base/numbers";
import { parseReport } from "../report/types";
import { Watch } from "../watch/watch";
import { Growth } from "./growth";
import { LiveView } from "./live_view";
import { Socket, type Message } from "./socket";

const over = new Set(["done", "not_done", "refused", "cancelled", "failed"]);
const stateWords: Record<string, string> = {
  queued: "Waiting for its turn", running: "Running", done: "Done", not_done: "Not done", refused: "Refused", cancelled: "Cancelled", failed: "Failed",
};

export class LivePage {
  readonly element = h("div", { class: "live-page" });
  private head = h("div", { class: "run-head" });
  private state = h("b", { class: "run-state" }, "Connecting");
  private words = h("span", { class: "run-words" });
  private bar = h("progress", { max: 1, "aria-label": "Progress" });
  private cancel = h("button", { type: "button", class: "button", onclick: () => void this.stop() }, "Cancel");
  private events = h("ol", { class: "events scrolls", tabindex: 0, "aria-label": "Events" });
  private view = new LiveView();
  private growth = new Growth();
  private body = h("div", { class: "run-body", hidden: true }, h("section", { class: "panel stage-panel" }, this.view.element),
    h("section", { class: "panel aside" }, this.events));
  private socket: Socket;
  private watch: Watch | null = null;
  private seen = 0;
  private present = "queued";
  private ended = false;

  constructor(private id: string, private query: Record<string, string>) {
    this.head.append(this.state, this.words, this.bar, this.cancel);
    this.element.append(h("section", { class: "panel run-panel" }, this.head), this.body);
    this.socket = new Socket(() => [{ type: "watch", run: id, from: this.seen }], (message) => this.hear(message),
      (connected) => {
        if (connected) this.show(this.present);
        else if (!this.ended) this.state.textContent = "Connection lost, trying again";
      });
  }

  close(): void {
    this.socket.close();
    this.view.close();
    this.watch?.close();
  }

  private hear(message: Message): void {
    if (message.type === "error") {
      this.state.textContent = "Not found";
      this.words.textContent = String(message.error);
      this.bar.hidden = this.cancel.hidden = true;
      return;
    }
    if (message.run !== this.id) return;
    this.seen = Math.max(this.seen, Number(message.seq ?? 0));
    if (this.growth.hear(message)) {
      this.body.hidden = false;
      this.view.show(this.growth.report!);
      this.element.dataset.samples = String(this.growth.report!.track.length);
    }
    if (message.type === "state") this.show(String(message.state));
    if (message.type === "progress") {
      const { step, steps, name, part } = message as unknown as { step: number; steps: number; name: string; part: number };
      this.show("running");
      this.words.textContent = `${name}, step ${step} of ${steps}`;
      this.bar.value = steps > 0 ? Math.min(1, (step - 1 + part) / steps) : part;
    }
    if (message.type === "events") this.addEvents(message.events as { time_s: number; kind: string; text: string }[]);
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

  private addEvents(events: { time_s: number; kind: string; text: string }[]): void {
    this.events.append(...events.map((event) => h("li", {}, h("button", { type: "button", class: event.kind, disabled: true },
      h("time", {}, clockText(event.time_s, 1)), h("span", {}, event.text)))));
    this.events.scrollTop = this.events.scrollHeight;
  }

  private async stop(): Promise<void> {
    this.cancel.disabled = true;
    await send("DELETE", `runs/${this.id}`).catch((error: Error) => { this.words.textContent = error.message; });
    this.cancel.disabled = false;
  }

  /** Shows the report where the run left one, else why it left none. */
  private async end(run: RunRow): Promise<void> {
    if (this.ended) return;
    this.ended = true;
    this.show(run.state);
    this.words.textContent = run.error || run.scenario;
    if (!run.has_report) return;
    try {
      const text = await getText(`runs/${this.id}/report`);
      const report = parseReport(text);
      if (typeof report === "string") throw new Error(report);
      this.watch = new Watch(report, this.query);
      this.element.replaceChildren(h("div", { class: "run-head" }, ...title(report, text.match(/"seed": ?(\d+)/)?.[1] ?? "")), this.watch.element);
    } catch (error) {
      this.words.textContent = error instanceof Error ? error.message : String(error);
    }
  }
}
