// A run whose server is this file: it tells a report as far as it is asked to, as one that runs would (docs/server.md).

const empty = { drive: { beliefs: [] }, explore: { beliefs: [], decisions: [] } };

/** Tells `report` to `page` as the run #live/told. */
export async function tellRun(page, report) {
  const log = [];
  const asked = [];  // `from` of each connection
  let socket = null;
  let told = -Infinity;
  let ended = false;
  const say = (message) => {
    log.push(JSON.stringify({ seq: log.length + 1, run: "told", ...message }));
    socket?.send(log.at(-1));
  };
  const row = () => ({ id: "told", job: report.job, scenario: "told.yaml", state: ended ? report.status : "running", error: "", has_report: ended });
  await page.route("**/api/v1/runs/told", (route) => route.fulfill({ json: row() }));
  await page.route("**/api/v1/runs/told/report", (route) => route.fulfill({ json: report }));
  await page.routeWebSocket("**/api/v1/live", (here) => {
    here.onMessage((text) => {
      const { type, from } = JSON.parse(text);
      if (type !== "watch") return;
      asked.push(from);
      socket = here;
      for (const message of log.slice(from)) here.send(message);
    });
  });
  const { drive, explore } = report;
  say({ type: "state", state: "running" });
  say({ type: "scene", report: { ...report, status: "running", metrics: {}, paths: [], shots: [], events: [], track: [],
    targets: report.targets.map((one) => ({ ...one, status: "waiting", done_s: null, shots: 0 })),
    ...(drive ? { drive: { ...drive, ...empty.drive } } : {}), ...(explore ? { explore: { ...explore, ...empty.explore } } : {}) } });
  return {
    asked, log,
    /** All that has happened until t. */
    upTo(t) {
      const now = (time) => time > told && time <= t;
      const some = (list, time) => list.filter((one) => now(time(one)));
      say({ type: "samples", rows: some(report.track, (one) => one[0]) });
      say({ type: "events", events: some(report.events, (one) => one.time_s) });
      say({ type: "growth", report: { shots: some(report.shots, (one) => one.time_s + one.flight_s), paths: some(report.paths, (one) => one.end_s),
        ...(drive ? { drive: { beliefs: some(drive.beliefs, (one) => one.time_s) } } : {}) } });
      if (report.targets.some((one) => now(one.done_s))) {
        say({ type: "growth", report: { targets: report.targets.map((one) => (one.done_s <= t ? one : { ...one, status: "waiting", done_s: null })) } });
      }
      told = t;
    },
    /** The connection breaks; the page is to come back. */
    drop() {
      const broken = socket;
      socket = null;
      broken.close();
    },
    end() {
      ended = true;
      say({ type: "end", ...row() });
    },
  };
}
