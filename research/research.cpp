#include "research/research.hpp"

#include <algorithm>

#include "outrider/jobs/catalog.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/pursuit/catalog.hpp"
#include "research/guard/heading_plan.hpp"
#include "research/guard/pddl_task.hpp"
#include "research/guard/reference.hpp"
#ifdef OUTRIDER_WITH_OMPL
#include "research/path/sampling.hpp"
#endif
#include "research/pursuit/iterative_a_star.hpp"
#include "research/pursuit/multi_goal_a_star.hpp"
#include "research/pursuit/real_time.hpp"

namespace outrider {
namespace {

void add_pursuit_planners() {
  add_pursuit_planner(
      {.name = "iterative_a_star",
       .sentence =
           "A* in space towards cells of the target from its last one back, with penalties for being late.",
       .paper = "the method of the reference report (course CMU 16-782), from its description",
       .guarantee = {.complete = false,
                     .optimal = false,
                     .sentence = "none; a catch at one of the seconds that it tries"},
       .configure = with_pursuit_options(iterative_a_star)});
  add_pursuit_planner(
      {.name = "multi_goal_a_star",
       .sentence = "A* over (cell, second) with every cell of the target in its second as a goal.",
       .paper =
           "Hart, Nilsson and Raphael, A formal basis for the heuristic determination of minimum cost paths, "
           "1968",
       .guarantee = {.complete = false,
                     .optimal = true,
                     .sentence = "the least cost where its states fit in memory; else it gives up"},
       .configure = with_pursuit_options(multi_goal_a_star)});
  add_pursuit_planner({.name = "lrta_star",
                       .sentence = "Follows the target, looking one cell ahead and learning.",
                       .paper = "Korf, Real-time heuristic search, 1990",
                       .guarantee = {.complete = false,
                                     .optimal = false,
                                     .sentence = "none; it never catches a target that keeps going away"},
                       .configure = with_pursuit_options(lrta_star)});
  add_pursuit_planner({.name = "rtaa_star",
                       .sentence = "Follows the target with a small A* each second and learns from it.",
                       .paper = "Koenig and Likhachev, Real-time adaptive A*, 2006",
                       .guarantee = {.complete = false,
                                     .optimal = false,
                                     .sentence = "none; it never catches a target that keeps going away"},
                       .configure = with_pursuit_options(rtaa_star)});
}

/// A method that has nothing to tell before it is done.
template <auto Planner>
Outcome<GuardPlan> at_once(const GuardProblem& problem, const FiringMap& firing_map,
                           const GuardOptions& options, const Budget& budget, const DraftObserver&) {
  return Planner(problem, firing_map, options, budget);
}

Outcome<GuardPlan> circles(const GuardProblem& problem, const FiringMap& firing_map,
                           const GuardOptions& options, const Budget& budget) {
  return shrinking_circles(problem, firing_map, options, budget);
}

void add_guard_planners() {
  add_guard_planner(
      {"shrinking_circles",
       "For each target the first place found on circles that shrink around it; groups of targets as listed, "
       "each in its best order.",
       "the method of the reference report, from its description", at_once<circles>});
  add_guard_planner({"circles_in_order", "The places of shrinking_circles in the best order of all targets.",
                     "shrinking_circles with the tour solver", at_once<circles_in_order>});
  add_guard_planner(
      {"source_target_table",
       "A table of places and the targets hit from there, looked up; always the nearest place next.",
       "the abstract of the reference report, from its description", at_once<source_target_table>});
  add_guard_planner(
      {"best_tour_by_headings",
       "The plan of best_tour; on the move, its lower bound counts turns and halts as well.",
       "Held and Karp, A dynamic programming approach to sequencing problems, 1962, with headings; "
       "research/guard/heading_bound.hpp",
       plan_with_heading_bound});
}

}  // namespace

void add_research() {
  add_pursuit_planners();
  add_guard_planners();
#ifdef OUTRIDER_WITH_OMPL
  add_sampling_planners();
#endif
}

std::vector<Job> research_jobs() {
  std::vector<Job> all = jobs();
  *std::ranges::find(all, "guard", &Job::name) = guard_job_with_pddl();
  return all;
}

}  // namespace outrider
