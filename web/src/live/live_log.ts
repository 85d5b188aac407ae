// The log of a run that goes on, filled by the bytes that the server sends. After a break the server begins again: what
// was shown stays until the new log has come as far.
import { RunLog } from "../log/run_log";
import { LogStream } from "../log/stream";

export class LiveLog {
  /** The log to show. */
  log = new RunLog();
  private stream = new LogStream(this.log);

  /** The log has come to its end: it has run.json. */
  get complete(): boolean { return this.stream.done && this.stream.log === this.log; }

  /** A new connection: the log comes again from its beginning. */
  restart(): void { this.stream = new LogStream(new RunLog()); }

  /** Takes bytes, cut anywhere; returns true if there is more to show. Throws where they are no log. */
  feed(bytes: Uint8Array): boolean {
    this.stream.feed(bytes);
    const { log } = this.stream;
    if (log !== this.log && (this.stream.done || log.count >= this.log.count)) this.log = log;
    return log === this.log && log.channels.size > 0;
  }
}
