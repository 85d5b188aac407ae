// The smallest report that the page takes, for tests.
import type { Report } from "../../src/report/types";

export function report(more: Partial<Report> = {}): Report {
  return {
    outrider_report: 1, status: "done", job: "guard", reason: "", seed: 1, metrics: {}, targets: [], settings: {}, warnings: [],
    world: { name: "w", bounds: [[0, 0], [4, 4]], gravity_mps2: 9.8, solids: [] },
    robot: { radius_m: 0.2, gun_length_m: 0.3, ball_radius_m: 0.02, margin_m: 0.03, start: [0, 0, 0] },
    paths: [], shots: [], events: [], track: [], ...more,
  };
}
