// The app: it shows one view at a time, given by the address.
import "./base/style.css";
import "./base/app.css";
import "./base/access.css";
import { addressOf } from "./addresses";
import { fileAt, filePath, getJson, postMap, scenarioPath, send, type FileRow, type MapAnswer, type PlannerRow, type RunsAnswer, type ScenarioAnswer } from "./api";
import { emblem, nameOf, title, tools } from "./banner";
import { h } from "./base/dom";
import { showHelp, startLetters } from "./base/help";
import { keys } from "./base/keys";
import { offerMore, showPalette } from "./base/palette";
import { startTheme, toggleTheme } from "./base/theme";
import { entitle } from "./base/title";
import { parseAddress, type Address } from "./base/url";
import { mostCompared } from "./compare/differences";
import { mayLeave, watchLeaving, type Work } from "./leaving";
import type { RunLog } from "./log/run_log";
import type { Source } from "./log/source";
import { hideNotice, showNotice } from "./notice";
import { editorOf } from "./plan/editors";
import type { Opened } from "./plan/plan_page";

interface View extends Work { element: HTMLElement; title?: string; close?: () => void }

const main = h("main");
const links = ([["Missions", ""], ["Plan", "draw"], ["Runs", "live"]] as const).map(([name, view]) => h("a", { href: `#${view}`, "data-view": view }, name));
let present: View | null = null;
let visit = 0;

function refusalView(sentence: string): View {
  return { element: h("div", { class: "page" }, h("h1", { class: "unseen" }, "It cannot be shown"), h("p", { class: "refusal", role: "alert" }, sentence), h("p", { class: "hint" }, h("a", { href: "#" }, "To the missions and files"))) };
}

async function watchFile(file: Blob | Source, query: Record<string, string>): Promise<View> {
  const { openLog } = await import("./log/file");
  return watchLog(await openLog(file), query);
}

async function watchLog(log: RunLog, query: Record<string, string>): Promise<View> {
  const { Watch } = await import("./watch/watch");
  const watch = new Watch(log, query);
  const head = h("div", { class: "run-head" }, ...title(log));
  return { element: h("div", { class: "live-page" }, head, watch.element), title: nameOf(log), close: () => watch.close() };
}

async function planView(map: MapAnswer, query: Record<string, string>, path = "", opened: Opened | null = null): Promise<View> {
  const [{ path_planners }, { openPlan }] = await Promise.all([getJson<{ path_planners: PlannerRow[] }>("catalogue"), import("./plan/plan_page")]);
  const page = openPlan(map, path_planners, query, path, opened);
  return typeof page === "string" ? refusalView(page) : page;
}

/** Opens a scenario to change: a path planning question, or a yard. */
async function scenarioView(path: string, query: Record<string, string>): Promise<View> {
  const scenario = await getJson<ScenarioAnswer>(scenarioPath(path));
  if ("goal" in scenario) {
    const { start, goal, radius_m } = scenario;
    return planView(scenario.map, { start: start.join(), goal: goal.join(), radius: String(radius_m), ...query }, path, scenario);
  }
  const { YardPage } = await import("./plan/yard_page");
  return new YardPage(scenario);
}

const blank = { origin: [0, 0], resolution_m: 0.25, width: 64, height: 44, runs: [0, 64 * 44] };

async function viewOf({ view, path, query }: Address): Promise<View> {
  if (view === "watch") return watchFile(await fileAt(filePath(path)), query);
  if (view === "example") return watchLog(await (await import("./front/example")).openExample(), query);
  if (view === "plan" && !path) return refusalView("A map that was dropped here is not kept when the page is loaded again; drop its file once more.");
  if (view === "plan") return planView(await send<MapAnswer>("POST", "maps", { path }), query, path);
  if (view === "change") return scenarioView(path, query);
  if (view === "draw") return planView(await send<MapAnswer>("POST", "maps", { grid: blank }), query);
  if (view === "live" && path) {
    const { LivePage } = await import("./live/live_page");
    return new LivePage(path, query);
  }
  if (view === "compare") {
    const { ComparePage } = await import("./compare/compare_page");
    return ComparePage.open((query.runs ?? "").split(",").filter(Boolean).slice(0, mostCompared), query);
  }
  const listed = getJson<{ folder: string; files: FileRow[] }>("files");
  if (view === "live") {
    const [{ files }, { RunsPage }] = await Promise.all([listed, import("./live/runs_page")]);
    return new RunsPage(files.filter((file) => editorOf(file) !== "question"), query.scenario ?? "");
  }
  const [{ folder, files }, { runs }, { FrontPage }] = await Promise.all([listed, getJson<RunsAnswer>("runs"), import("./front/front_page")]);
  return new FrontPage(folder, files, runs, (dropped) => void openFiles(dropped));
}

async function show(make: () => Promise<View>): Promise<void> {
  const mine = ++visit;
  let view: View;
  try {
    view = await make();
  } catch (error) {
    view = refusalView(error instanceof Error ? error.message : String(error));
  }
  if (mine !== visit) {  // another view was requested meanwhile
    view.close?.();
    return;
  }
  present?.close?.();
  present = view;
  hideNotice();
  main.replaceChildren(view.element);
  const { path } = parseAddress(location.hash);
  entitle(view.title ?? (view.element.querySelector("h1")?.textContent || path.split("/").at(-1)));
}

/** Shows the view of the address, unless one stays with work that is not saved. */
function route(event?: HashChangeEvent): void {
  if (event && !mayLeave(present)) {
    history.pushState(history.state, "", event.oldURL);
    return;
  }
  const address = parseAddress(location.hash);
  const at = address.view === "plan" || address.view === "change" ? "draw" : address.view === "watch" || address.view === "example" ? "" : address.view === "compare" ? "live" : address.view;
  for (const link of links) link.toggleAttribute("aria-current", link.dataset.view === at);
  void show(() => viewOf(address));
}

/** Reads dropped files: the log of a run, or anything else, which the server reads, as a map. Returns what shows it; throws a sentence. */
async function readDropped(files: File[]): Promise<() => Promise<View>> {
  const maps = files.filter(({ name }) => /\.(map|txt|ya?ml|sdf|world|mcap|json)$/i.test(name)).map(({ name }) => name);
  if (maps.length > 1) throw new Error(`${maps.length} files that are shown alone were dropped, ${maps.join(" and ")}; drop one of them, with its images where it has some.`);
  const [first] = files;
  if (files.length === 1 && /\.(mcap|json)$/.test(first!.name)) {
    const { openLog } = await import("./log/file");
    const log = await openLog(first!);
    return () => watchLog(log, {});
  }
  const map = await postMap(files);
  const { groundOf } = await import("./plan/ground");
  const ground = groundOf(map);
  if (typeof ground === "string") throw new Error(ground);
  return () => {
    history.replaceState(null, "", "#plan");
    return planView(map, {});
  };
}

/** Shows dropped files. What cannot be shown is said over the view that is there. */
async function openFiles(files: File[]): Promise<void> {
  if (files.length === 0) return;
  const before = visit;
  try {
    const make = await readDropped(files);
    if (before === visit && mayLeave(present)) await show(make);
  } catch (error) {
    showNotice(error instanceof Error ? error.message : String(error));
  }
}

function listen(): void {
  addEventListener("hashchange", route);
  const highlight = (on: boolean): void => { document.body.classList.toggle("drop-here", on); };
  addEventListener("dragover", (event) => {
    event.preventDefault();
    highlight(event.dataTransfer?.types.includes("Files") ?? false);
  });
  addEventListener("dragleave", (event) => { if (!event.relatedTarget) highlight(false); });
  addEventListener("drop", (event) => {
    event.preventDefault();
    highlight(false);
    void openFiles([...(event.dataTransfer?.files ?? [])]);
  });
  startLetters();
  keys.listen();
  keys.set("Page", [
    { key: "?", words: "every key that works here", act: showHelp },
    { key: "Ctrl+k", words: "find a command", act: showPalette },
    { key: "d", words: "light or dark", act: toggleTheme },
    { key: "F", words: "missions and files", act: () => { location.hash = ""; } },
    { key: "P", words: "plan on a map of your own", act: () => { location.hash = "draw"; } },
    { key: "L", words: "runs", act: () => { location.hash = "live"; } },
  ]);
}

/** Every file of the folder can be opened from the palette. */
offerMore(async () => (await getJson<{ files: FileRow[] }>("files")).files.flatMap((file) => {
  const to = addressOf(file);
  return to ? [{ group: "open", words: file.path, act: () => { location.hash = to; } }] : [];
}));
watchLeaving(() => present);
startTheme(parseAddress(location.hash).query.theme ?? null);
document.body.append(h("header", { class: "top" }, h("a", { href: "#", class: "home" }, emblem(), "Outrider"), h("nav", {}, ...links), tools()), main);
listen();
route();
