// What `guard` does with --pddl and --validate: the mission as a PDDL problem, and the verdict on a plan for
// it.
#pragma once

#include <string>
#include <vector>

#include "flags.hpp"
#include "outrider/jobs/guard/scenario.hpp"

namespace outrider::cli {

struct PddlRequest {
  std::string folder;  ///< for the files; empty: none
  std::string plan;    ///< to judge; empty: none
  std::int64_t stops = 8;
  double tolerance_s = 0.001;

  [[nodiscard]] bool any() const { return !folder.empty() || !plan.empty(); }
};

std::vector<Option> describe(PddlRequest& request);

/// Refuses empty names, a folder that cannot be made, and flags that ask for a mission as well.
Status check(const PddlRequest& request, const Command& flags);

/// Writes the files or judges the plan, says what came of it, and returns the exit status. `scenario` is
/// loaded; `warnings` are what that gave.
int carry_out(const PddlRequest& request, const GuardScenario& scenario,
              const std::vector<std::string>& warnings, bool json);

}  // namespace outrider::cli
