// PDDL 2.1: the decision problem of a guard mission for planners of others, and plans for it.
//
// Domain and problem are of level 3 (durative actions), with :typing, :fluents and :duration-inequalities;
// what the actions are is told by guard/temporal.hpp. Names: pose pS-K is stop S with the K-th heading there,
// target tG and station fI are numbers as well; comments of the problem say what they stand for. Only what
// the problem needs is in the domain: without supplies that end there is no word about them.
//
// A plan has one action a line, in any order; ';' starts a comment, letters may be of either case:
//     0.000: (drive p0-0 p3-0) [4.250]
//     4.251: (shoot p3-0 t1 direct) [1.800]
//
// Errors: bad_input with file:line, the words and what would be right, on the first wrong line.
// Bounds: 100,000 actions, times from 0 to 1e9 s. O(length of the text x log names).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/geometry/vec.hpp"
#include "outrider/jobs/guard/temporal.hpp"

namespace outrider {

/// What the comments of a problem tell.
struct PddlNotes {
  std::string yard;
  std::vector<Vec2> places;           ///< by stop
  std::vector<std::string> targets;   ///< by goal
  std::vector<std::string> stations;  ///< by station
  std::vector<std::string> left_out;  ///< targets that are no goals
};

struct PddlPlan {
  std::vector<TemporalAction> actions;
  std::vector<std::size_t> lines;    ///< of the file, by action
  std::vector<std::string> phrases;  ///< "(drive p0-0 p3-0)", by action
};

std::string pddl_domain(const TemporalProblem& problem);
std::string pddl_problem(const TemporalProblem& problem, const PddlNotes& notes);
std::string pddl_plan(const TemporalProblem& problem, const std::vector<TemporalAction>& actions);

/// `name` stands for the file in faults.
Outcome<PddlPlan> pddl_plan_from_text(std::string_view text, const std::string& name,
                                      const TemporalProblem& problem);

}  // namespace outrider
