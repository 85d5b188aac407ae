// Asks for plans during a drag: one question at a time, and after its answer the newest waiting one. What is asked
// while the server is away is answered by a sentence that says so, and once it is back.
import type { PlanAnswer, PlanRequest } from "../api";
import { Socket, type Message } from "../live/socket";
import { shownAnswer, type Shown } from "./shown";

export class Asker {
  private socket: Socket;
  private next: PlanRequest | null = null;
  private asked: { id: number; request: PlanRequest } | null = null;
  private id = 0;
  private away = false;

  constructor(private answered: (answer: Shown, request: PlanRequest) => void) {
    this.socket = new Socket({ opened: () => this.resumed(), receive: (message) => this.receive(message),
      state: (connected) => { if (!connected) this.sayAway(); } });
  }

  ask(request: PlanRequest): void {
    this.next = request;
    if (!this.asked) this.send();
    if (this.away) this.sayAway();
  }

  private sayAway(): void {
    this.away = true;
    const request = this.next ?? this.asked?.request;
    if (request) this.answered({ planner: request.planner, status: "unanswered", reason: "The server does not answer; trying again." }, request);
  }

  get busy(): boolean { return this.asked !== null; }

  close(): void { this.socket.close(); }

  /** Asks the question that was open when the connection broke again, unless a newer one waits. */
  private resumed(): Message[] {
    this.away = false;
    this.next ??= this.asked?.request ?? null;
    this.asked = null;
    queueMicrotask(() => this.send());
    return [];
  }

  private send(): void {
    if (!this.next || !this.socket.ready) return;
    this.asked = { id: ++this.id, request: this.next };
    this.next = null;
    this.socket.send({ type: "plan", id: this.id, request: this.asked.request });
  }

  private receive(message: Message): void {
    if (!this.asked || message.id !== this.asked.id) return;
    const { request } = this.asked;
    this.asked = null;
    if (message.type === "plan" && message.result) this.answered(shownAnswer(message.result as PlanAnswer), request);
    if (message.type === "error") {
      this.answered({ planner: request.planner, status: String(message.code), reason: String(message.error), where: String(message.where ?? "") }, request);
    }
    this.send();
  }
}
