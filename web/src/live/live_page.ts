// The live view: shows one mission while it runs with the same views as afterwards. Its log comes as it is written.
import { faultText, fileAt, getJson, send, type RunRow, type SceneAnswer } from "../api";
import { heading, nameOf, title } from "../banner";
import { announce } from "../base/announce";
import { h } from "../base/dom";
import { entitle } from "../base/title";
import { formatAddress } from "../base/url";
import type { RunLog } from "../log/run_log";
import { topic } from "../log/topics";
import { sceneOf } from "../scenes";
import { Watch } from "../watch/watch";
import { LiveLog } from "./live_log";
import { isOver, stateWords } from "./states";
import { Socket, type Message } from "./socket";

/** The interval at which new data is shown. */
const rest_ms = 200;
const isFile = (scenario: string): boolean => /\.ya?ml$/.test(scenario);

export class LivePage {
  readonly element = h("div", { class: "live-page" });
  private name = h("h1");
  private state = h("b", { class: "run-state" }, "Connecting");
  private words = h("span", { class: "run-words" });
  private bar = h("progress", { max: 1, "aria-label": "Progress" });
  private cancel = h("button", { type: "button", class: "button", onclick: () => void this.stop() }, "Cancel");
  private head = h("div", { class: "run-head" }, this.name, this.state, this.words, this.bar, this.cancel);
  private live = new LiveLog();
  private scene: SceneAnswer | null = null;
  /** The log of a run that had ended before. */
  private kept: RunLog | null = null;
  private socket: Socket | null = null;
  private watch: Watch | null = null;
  private timer = 0;
  private present = "queued";
  private ended: RunRow | null = null;
  private closed = false;

  constructor(private id: string, private query: Record<string, string>) {
    this.element.append(this.head);
    void this.begin();
  }

  close(): void {
    this.closed = true;
    clearTimeout(this.timer);
    this.socket?.close();
    this.watch?.close();
  }

  /** The server sends the log so far, then what is added to it. Of a run that has ended the parts of its file are read that are shown. */
  private async begin(): Promise<void> {
    const run = await getJson<RunRow>(`runs/${this.id}`).catch((error: Error) => error);
    if (this.closed) return;
    if (run instanceof Error) {
      this.notFound(run.message);
      return;
    }
    if (isOver(run.state) && run.has_log) {
      await this.openKept(run).catch((error: Error) => this.notFound(error.message));
      return;
    }
    if (isFile(run.scenario)) {
      void sceneOf(run.scenario).then((scene) => {
        this.scene = scene;
        if (scene) this.watch?.expect(scene);
      });
    }
    this.socket = new Socket({
      opened: () => {
        this.live.restart();
        return [{ type: "watch", run: this.id, from: 0 }];
      },
      receive: (message) => this.receive(message),
      bytes: (frame) => this.take(frame),
      state: (connected) => {
        if (connected) this.show(this.present);
        else if (!this.ended) announce(this.state.textContent = "Connection lost, trying again");
      },
    });
  }

  private async openKept(run: RunRow): Promise<void> {
    const { openLog } = await import("../log/file");
    this.kept = await openLog(await fileAt(`runs/${run.id}/log`));
    if (!this.closed) this.end(run);
  }

  /** The log as far as it is there, and true if it is whole. */
  private get log(): { log: RunLog; complete: boolean } {
    return this.kept ? { log: this.kept, complete: !this.kept.cut } : this.live;
  }

  private notFound(sentence: string): void {
    this.state.textContent = "Not found";
    this.words.textContent = sentence;
    this.bar.hidden = this.cancel.hidden = true;
  }

  private take(frame: Uint8Array): void {
    try {
      if (this.live.feed(frame)) this.timer ||= window.setTimeout(() => this.grow(), this.watch ? rest_ms : 0);
    } catch (error) {
      this.words.textContent = error instanceof Error ? error.message : String(error);
      this.socket?.close();
    }
  }

  private receive(message: Message): void {
    if (message.type === "error") this.notFound(String(message.error));
    if (message.run !== this.id) return;
    if (message.type === "run" || message.type === "state") this.show(String(message.state));
    if (message.type === "progress") {
      const { step, steps, name, part } = message as unknown as { step: number; steps: number; name: string; part: number };
      this.show("running");
      this.words.textContent = `${name}, step ${step} of ${steps}`;
      this.bar.value = steps > 0 ? Math.min(1, (step - 1 + part) / steps) : part;
    }
    if (message.type === "end") this.end(message as unknown as RunRow);
  }

  private show(state: string): void {
    if (state !== this.present) announce(stateWords(state));
    this.present = state;
    this.element.dataset.state = state;
    this.state.textContent = stateWords(state);
    this.state.className = `run-state ${state}`;
    this.cancel.hidden = isOver(state);
    this.bar.hidden = isOver(state);
  }

  /** Updates the view to the log received so far. */
  private grow(): void {
    clearTimeout(this.timer);
    this.timer = 0;
    const { log, complete } = this.log;
    const goesOn = !complete && !this.ended;
    if (this.ended) log.file ??= { whole: async () => (await fileAt(`runs/${this.id}/log`)).whole() };
    this.element.dataset.samples = String((log.channels.get(topic.pose) ?? log.channels.get(topic.belief))?.count ?? 0);
    if (complete) this.head.replaceChildren(...title(log));
    else this.name.replaceWith(this.name = heading(log));
    entitle(complete ? nameOf(log) : `${this.name.lastChild?.textContent ?? ""}, ${stateWords(this.present).toLowerCase()}`);
    if (this.watch) {
      this.watch.renew(log, goesOn);
      return;
    }
    this.watch = new Watch(log, this.query, goesOn);
    if (this.scene) this.watch.expect(this.scene);
    this.element.append(this.watch.element);
  }

  private async stop(): Promise<void> {
    this.cancel.disabled = true;
    await send("DELETE", `runs/${this.id}`).catch((error: Error) => { this.words.textContent = error.message; });
    this.cancel.disabled = false;
  }

  /** A run that left no log: which one, and why, with the ways on. */
  private tellWhy(run: RunRow): void {
    this.words.textContent = "";
    this.name.textContent = run.scenario;
    entitle(`${run.scenario}, ${stateWords(run.state).toLowerCase()}`);
    const change = isFile(run.scenario) ? [h("a", { href: formatAddress({ view: "change", path: run.scenario, query: {} }) }, "Change the scenario"), " or "] : [];
    this.element.append(h("div", { class: "page" }, h("p", { class: "refusal", role: "alert" }, faultText(run) || "It ended before it had anything to show."),
      h("p", { class: "hint" }, ...change, h("a", { href: formatAddress({ view: "live", path: "", query: isFile(run.scenario) ? { scenario: run.scenario } : {} }) }, "run another mission"))));
  }

  /** The run is over. Paths of planners are shown by the page that plans. */
  private end(run: RunRow): void {
    this.ended = run;
    this.show(run.state);
    announce(`${stateWords(run.state)}. ${faultText(run) || run.summary?.reason || ""}`.trim());
    this.words.textContent = faultText(run) || run.scenario;
    const { channels } = this.log.log;
    const answersQuestion = [...channels.keys()].some((name) => name.startsWith(topic.planOf));
    if (answersQuestion && (run.state === "done" || run.state === "not_done") && isFile(run.scenario)) {
      location.replace(formatAddress({ view: "change", path: run.scenario, query: {} }));
    } else if (channels.size > 0) this.grow();
    else this.tellWhy(run);
  }
}
