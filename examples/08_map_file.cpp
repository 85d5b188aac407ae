// Plans a path on a MovingAI map in five lines with the simplest interface. Any other map file works the same
// way.
#include <fmt/format.h>

#include "outrider/outrider.hpp"

int main() {
  const auto problem = outrider::load_path_problem("scenarios/maps/gallery.map", {3.5, 13.5}, {28.5, 2.5});
  if (!problem) return fmt::print("{}\n", to_string(problem.error())), 2;
  const auto plan = outrider::plan_path(*problem, "theta_star");
  if (!plan) return fmt::print("{}\n", to_string(plan.error())), 1;
  for (const outrider::Vec2 p : plan->waypoints) fmt::print("{:.1f}, {:.1f}\n", p.x, p.y);
}

// Prints:
// 3.5, 13.5
// 7.5, 13.5
// 10.5, 11.5
// 15.5, 9.5
// 16.5, 7.5
// 23.5, 6.5
// 24.5, 4.5
// 26.5, 4.5
// 28.5, 2.5
