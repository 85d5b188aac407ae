// The names that things of a temporal problem have in PDDL, both ways.
#pragma once

#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "research/guard/temporal.hpp"

namespace outrider {

struct PddlNames {
  std::vector<std::string> poses;
  std::vector<std::string> targets;
  std::vector<std::string> stations;

  explicit PddlNames(const TemporalProblem& problem) {
    std::map<std::size_t, std::size_t> headings;
    for (const TemporalPose& pose : problem.poses) {
      poses.push_back(fmt::format("p{}-{}", pose.stop, headings[pose.stop]++));
    }
    for (std::size_t g = 0; g < problem.supplies.table.goals; ++g) targets.push_back(fmt::format("t{}", g));
    for (std::size_t f = 0; f < problem.supplies.stations.size(); ++f)
      stations.push_back(fmt::format("f{}", f));
  }
};

inline const char* pddl_name(WayRound way) {
  return way == WayRound::direct ? "direct" : way == WayRound::plus ? "plus" : "minus";
}

inline const char* pddl_fill(Store store) { return store == Store::water ? "fill-water" : "fill-charge"; }

}  // namespace outrider
