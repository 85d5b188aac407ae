// PDDL 2.1: writes the decision problem of a guard mission for external planners, and reads their plans.
//
// Domain and problem are of level 3 (durative actions), with :typing, :fluents and :duration-inequalities.
// temporal.hpp defines the actions. Names: pS-K is the pose at stop S with the K-th heading, tG is target G
// and fI is station I; comments in the problem explain them. The domain contains only what the problem needs:
// it does not mention supplies that are unlimited.
//
// A plan has one action per line, in any order. ';' starts a comment; upper and lower case are the same:
//     0.000: (drive p0-0 p3-0) [4.250]
//     4.251: (shoot p3-0 t1 direct) [1.800]
//
// Faults: bad_input for the first wrong line, with file:line, the wrong words and the correct form.
// Bounds: 100,000 actions, times from 0 to 1e9 s. O(length of the text x log names).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/geometry/vec.hpp"
#include "research/guard/temporal.hpp"

namespace outrider {

/// Names and positions for the comments in a problem.
struct PddlNotes {
  std::string yard;                   ///< name of the world
  std::vector<Vec2> places;           ///< position of each stop
  std::vector<std::string> targets;   ///< name of each goal
  std::vector<std::string> stations;  ///< name of each station
  std::vector<std::string> left_out;  ///< names of targets that are no goals
};

/// A plan that was read.
struct PddlPlan {
  std::vector<TemporalAction> actions;
  std::vector<std::size_t> lines;    ///< line in the file of each action
  std::vector<std::string> phrases;  ///< text of each action, such as "(drive p0-0 p3-0)"
};

/// Return the domain, the problem and a plan as PDDL text.
std::string pddl_domain(const TemporalProblem& problem);
std::string pddl_problem(const TemporalProblem& problem, const PddlNotes& notes);
std::string pddl_plan(const TemporalProblem& problem, const std::vector<TemporalAction>& actions);

/// Parses a plan. `name` stands for the file in faults.
Outcome<PddlPlan> pddl_plan_from_text(std::string_view text, const std::string& name,
                                      const TemporalProblem& problem);

}  // namespace outrider
