// The second table of the suite `guard`: every policy with arriving intruders, over many seeds.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider::bench {

/// Holds a mean over seeds, and half the width of its 95 % confidence interval (normal distribution).
struct Estimate {
  double mean = 0.0;
  double half_width = 0.0;
};

struct ArrivalsRow {
  std::string yard;
  std::string policy;
  std::string objective;
  std::size_t runs = 0;
  double lost = 0.0;    ///< intruders not hit, over all runs
  Estimate inside_s;    ///< time inside of an intruder
  Estimate longest_s;   ///< longest such time in a run
  Estimate makespan_s;  ///< time after the last intruder has entered
  Estimate driven_m;
  double below_bound = 0.0;  ///< number of runs whose objective is below the proven bound
};

/// Runs a scenario with arrivals for seeds 1 to `seeds`, each policy with each objective. The last row of
/// each objective is the bound. Faults: those of the scenario.
Outcome<std::vector<ArrivalsRow>> measure_arrivals(const std::string& scenario_path, std::int64_t seeds);

std::string arrivals_table(const std::vector<ArrivalsRow>& rows);
nlohmann::ordered_json arrivals_json(const std::vector<ArrivalsRow>& rows);

}  // namespace outrider::bench
