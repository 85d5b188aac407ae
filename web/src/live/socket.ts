// The WebSocket to the server: it reconnects after every break and sends the opening messages again.
import { token } from "../api";

export interface Message { type: string; [key: string]: unknown }

export class Socket {
  private socket: WebSocket | null = null;
  private closed = false;
  private wait = 250;
  private timer = 0;

  /**
   * `opened` returns the messages to send after each connection; `receive` takes each message; `state` is called when
   * the connection opens or breaks.
   */
  constructor(private opened: () => Message[], private receive: (message: Message) => void,
    private state: (connected: boolean) => void = () => undefined) {
    this.connect();
  }

  get ready(): boolean { return this.socket?.readyState === WebSocket.OPEN; }

  private connect(): void {
    const url = new URL("api/v1/live", location.href);
    url.protocol = url.protocol.replace("http", "ws");
    url.search = token() ? `?token=${encodeURIComponent(token())}` : "";
    url.hash = "";
    const socket = new WebSocket(url);
    this.socket = socket;
    socket.onopen = () => {
      this.wait = 250;
      this.state(true);
      for (const message of this.opened()) this.send(message);
    };
    socket.onmessage = (event) => this.receive(JSON.parse(String(event.data)) as Message);
    socket.onclose = () => {
      if (this.closed) return;
      this.state(false);
      this.timer = window.setTimeout(() => this.connect(), this.wait);
      this.wait = Math.min(4000, 2 * this.wait);
    };
  }

  send(message: Message): void {
    if (this.ready) this.socket!.send(JSON.stringify(message));
  }

  close(): void {
    this.closed = true;
    clearTimeout(this.timer);
    this.socket?.close();
  }
}
