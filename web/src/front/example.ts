// The example: the log of the mission scenarios/yard/yard.yaml, made by the tool (web/build/example.mjs).
import type { RunLog } from "../log/run_log";

const address = new URL("./example.mcap", import.meta.url).href;

/** The scenario that the example is a run of. */
export const exampleScenario = "yard/yard.yaml";

export async function openExample(): Promise<RunLog> {
  const [response, { openLog }] = await Promise.all([fetch(address), import("../log/file")]);
  if (!response.ok) throw new Error("the example is missing from this page");
  return openLog(await response.blob());
}
