// The states of runs, in words.
import type { RunRow } from "../api";

const words: Record<RunRow["state"], string> = {
  queued: "Waiting for its turn", running: "Running", done: "Done", not_done: "Not done", refused: "Refused", cancelled: "Cancelled", failed: "Failed", cut_short: "Cut short",
};

export const stateWords = (state: string): string => words[state as RunRow["state"]] ?? state;
/** It has come to its end, whichever it was. */
export const isOver = (state: string): boolean => state !== "queued" && state !== "running";
