// The jobs of the tool: the one list of them, and the options of those that a scenario can name.
#pragma once

#include <string_view>
#include <vector>

#include "outrider/io/cover_scenario.hpp"
#include "outrider/io/drive_scenario.hpp"
#include "outrider/io/explore_scenario.hpp"
#include "outrider/io/guard_scenario.hpp"
#include "outrider/io/plan_scenario.hpp"
#include "outrider/io/pursuit_scenario.hpp"
#include "outrider/io/slam_scenario.hpp"

namespace outrider::cli {

struct Job {
  std::string_view name;
  std::string_view sentence;
  std::string_view flags;  ///< how keys of its scenarios become flags; empty: it has no scenarios
};

/// By name.
const std::vector<Job>& jobs();

/// Scenarios at their defaults, for their options, which point into this.
struct BlankScenarios {
  GuardScenario guard;
  PursuitScenario pursue;
  CoverScenario cover;
  DriveScenario drive;
  ExploreScenario explore;
  PlanScenario plan;
  SlamScenario slam;

  /// None for a job without scenarios.
  std::vector<OptionGroup> options(std::string_view job);
};

}  // namespace outrider::cli
