// The jobs of the tool: the one list of them, and the options of those that a scenario can name.
#pragma once

#include <string_view>
#include <vector>

#include "outrider/jobs/cover/scenario.hpp"
#include "outrider/jobs/drive/scenario.hpp"
#include "outrider/jobs/explore/scenario.hpp"
#include "outrider/jobs/guard/scenario.hpp"
#include "outrider/jobs/plan/scenario.hpp"
#include "outrider/jobs/pursue/scenario.hpp"
#include "outrider/jobs/slam/scenario.hpp"

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
