// Runs a job of a scenario file as `outrider run` does: its verdict and its metrics.
#include <iostream>

#include "outrider/jobs/catalog.hpp"

int main() {
  const auto run = outrider::run_job("scenarios/yard/yard.yaml");
  if (!run) {
    std::cerr << to_string(run.error()) << '\n';
    return 1;
  }
  std::cout << run->report.status << '\n';
  for (const auto& [name, value] : run->report.metrics) std::cout << name << " = " << value << '\n';
}

// Prints:
// done
// targets = 24
// reached = 23
// failed = 0
// unreachable = 1
// reached_by_reference_rule = 23
// mission_s = 58.0518
// planned_s = 55.9933
// expected_s = 55.9933
// lower_bound_s = 54.8734
// gap = 0.02
// anywhere_lower_bound_s = 31.5695
// anywhere_gap = 0.436191
// tour_proven = 0
// stops_offered = 139
// driven_m = 21.9267
// turned_rad = 4.79498
// shots = 23
// stops = 3
// places = 18526
