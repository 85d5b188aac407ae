// The content of a pane: the row of a planner with the details of its search, or why the server refused the question.
import type { PlanAnswer, PlanRow, PlanView } from "../api";

export type Shown = Partial<PlanRow> & Pick<PlanRow, "planner" | "status" | "reason"> & PlanView & { where?: string };

export const shownAnswer = ({ rows, view }: PlanAnswer): Shown => ({ ...rows[0]!, ...view });
