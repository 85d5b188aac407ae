// A job of a scenario file, run as `outrider run` runs it: its verdict and its metrics.
#include <fmt/format.h>

#include "outrider/jobs/catalog.hpp"

int main() {
  const auto run = outrider::run_job("scenarios/stations/stations.yaml", {{"seed", "2"}});
  if (!run) return fmt::print("{}\n", to_string(run.error())), 1;
  fmt::print("{}\n", run->report.status);
  for (const auto& [name, value] : run->report.metrics) fmt::print("{} = {:.6g}\n", name, value);
}

// Prints:
// done
// targets = 24
// reached = 23
// failed = 0
// unreachable = 1
// reached_by_reference_rule = 23
// mission_s = 135.469
// planned_s = 135.066
// expected_s = 135.066
// lower_bound_s = 56.7339
// gap = 0.579956
// anywhere_lower_bound_s = 31.5695
// anywhere_gap = 0.766267
// tour_proven = 0
// stops_offered = 297
// driven_m = 32.1653
// turned_rad = 9.08701
// shots = 23
// stops = 6
// places = 18569
// fills = 3
// unplanned_fills = 0
// least_water = 0
// least_charge_j = 344.567
