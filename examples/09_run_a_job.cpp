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
// mission_s = 40.3885
// planned_s = 38.7208
// expected_s = 38.7208
// lower_bound_s = 22.8907
// gap = 0.408826
// anywhere_lower_bound_s = 22.8907
// anywhere_gap = 0.408826
// tour_proven = 0
// stops_offered = 0
// driven_m = 21.6646
// turned_rad = 4.78908
// shots = 23
// stops = 3
// places = 18526
// shots_in_passing = 15
// hits_in_passing = 15
