// The editors of the page, each for the scenarios of one job: the only place of the page that names a job.
import type { FileRow } from "../api";

/** Shows a question about a path with its answer at once, so it needs no run; shows a yard to change. */
export type Editor = "question" | "yard";

const editors: Record<string, Editor> = { plan: "question", guard: "yard" };

/** Returns the editor of a scenario; undefined for other files, and for scenarios that the page only runs. */
export const editorOf = ({ kind, job }: FileRow): Editor | undefined => (kind === "scenario" ? editors[job ?? ""] : undefined);
