// The WebSocket to the server: it reconnects after every break and sends the opening messages again.
import { token } from "../api";

export interface Message { type: string; [key: string]: unknown }

export interface SocketEvents {
  /** The messages to send after each connection. */
  opened: () => Message[];
  /** Takes each message of text. */
  receive: (message: Message) => void;
  /** Takes each binary frame: bytes of the log of a run, cut anywhere. */
  bytes?: (frame: Uint8Array) => void;
  /** Called when the connection opens or breaks. */
  state?: (connected: boolean) => void;
}

export class Socket {
  private socket: WebSocket | null = null;
  private closed = false;
  private wait = 250;
  private timer = 0;

  constructor(private events: SocketEvents) { this.connect(); }

  get ready(): boolean { return this.socket?.readyState === WebSocket.OPEN; }

  private connect(): void {
    const url = new URL("api/v1/live", location.href);
    url.protocol = url.protocol.replace("http", "ws");
    url.search = token() ? `?token=${encodeURIComponent(token())}` : "";
    url.hash = "";
    const socket = new WebSocket(url);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    const { events } = this;
    socket.onopen = () => {
      this.wait = 250;
      events.state?.(true);
      for (const message of events.opened()) this.send(message);
    };
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      if (typeof data === "string") events.receive(JSON.parse(data) as Message);
      else events.bytes?.(new Uint8Array(data));
    };
    socket.onclose = () => {
      if (this.closed) return;
      events.state?.(false);
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
