// A run whose server is this file: it sends the bytes of a log as far as it is asked to, as one that runs would (docs/server.md).
import { Stream } from "./streams.mjs";

const frameBytes = 5000;  // frames are cut at any byte

/** Tells a log to `page` as the run #live/told. */
export async function tellRun(page, contents) {
  const { result, messages } = contents;
  const asked = [];  // what each connection asked for
  let sent = [];     // bytes so far
  let socket = null;
  let told = -Infinity;
  let ended = false;
  const row = () => ({ run: "told", id: "told", job: result.job, scenario: "told.yaml", state: ended ? result.status : "running", error: "" });
  const say = (message) => socket?.send(JSON.stringify({ run: "told", ...message }));
  const send = (bytes) => {
    for (let at = 0; at < bytes.length; at += frameBytes) socket?.send(Buffer.from(bytes.subarray(at, at + frameBytes)));
  };
  const stream = new Stream(contents);
  const tell = () => {
    sent.push(stream.take());
    send(sent.at(-1));
  };
  await page.route("**/api/v1/runs/told", (route) => route.fulfill({ json: row() }));
  await page.routeWebSocket("**/api/v1/live", (here) => {
    here.onMessage((text) => {
      const { type, from } = JSON.parse(text);
      if (type !== "watch") return;
      asked.push(from);
      socket = here;
      say({ type: "run", ...row() });
      sent = [Buffer.concat(sent)];
      send(sent[0]);
    });
  });
  return {
    asked,
    /** All that has happened until t. */
    upTo(t) {
      for (const message of messages) if (message.t > told && message.t <= t) stream.add(message);
      told = t;
      tell();
    },
    /** The connection breaks; the page is to come back. */
    drop() {
      const broken = socket;
      socket = null;
      broken.close();
    },
    end() {
      stream.end();
      tell();
      ended = true;
      say({ type: "end", ...row() });
    },
  };
}
