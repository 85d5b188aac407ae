#include "research/guard/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/ballistics/sight.hpp"
#include "outrider/tour/solve.hpp"
#include "plan/plan_clock.hpp"

namespace outrider {
namespace {

constexpr double circle_step_m = 0.5;
constexpr int bearings = 24;
constexpr double table_step_m = 0.5;

/// A place and the one target that is hit from there.
struct Post {
  Vec2 place;
  PlannedHit hit;
};

/// The post at a cell, unless no shot at the target from there keeps the margin.
std::optional<Post> post_at(const GuardProblem& problem, const FiringMap& firing_map, std::size_t target,
                            std::size_t cell, double pitch_rad) {
  if (!firing_map.has_shot(target, cell)) return std::nullopt;
  const Vec2 place = firing_map.place(cell);
  auto shot = shot_from(problem, firing_map, target, place, pitch_rad);
  if (!shot) return std::nullopt;
  return Post{place, {target, *shot}};
}

/// The first post found on circles that shrink around a target.
std::optional<Post> first_on_circles(const GuardProblem& problem, const FiringMap& firing_map,
                                     std::size_t t) {
  const Target& target = problem.targets[t];
  for (double radius = longest_range(firing_map.rules, target); radius > 0.0; radius -= circle_step_m) {
    for (int i = 0; i < bearings; ++i) {
      const auto cell = firing_map.cell_of(xy(target.base) + radius * direction(2.0 * pi * i / bearings));
      if (!cell) continue;
      if (auto post = post_at(problem, firing_map, t, *cell, 0.0)) return post;
    }
  }
  return std::nullopt;
}

/// Posts on the circles, by target as listed; what has none joins the unreachable.
std::vector<Post> posts_on_circles(const GuardProblem& problem, const FiringMap& firing_map,
                                   GuardPlan& plan) {
  std::vector<Post> posts;
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    if (firing_map.regions[t].hits == 0) continue;
    if (auto post = first_on_circles(problem, firing_map, t)) {
      posts.push_back(*std::move(post));
    } else {
      plan.unreachable.push_back({t, "none of the places on the circles around it has a shot"});
    }
  }
  return posts;
}

std::vector<Vec2> places_of(const GuardProblem& problem, const std::vector<Post>& posts) {
  std::vector<Vec2> places{problem.start.position};
  for (const Post& post : posts) places.push_back(post.place);
  return places;
}

/// Drives through posts [first, last) of an order, from the place before them; place 0 is the start.
double drive_time(const Routes& routes, const std::vector<std::size_t>& order, std::size_t first,
                  std::size_t last) {
  double time = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    time += routes.between(i == 0 ? 0 : order[i - 1] + 1, order[i] + 1).time_s;
  }
  return time;
}

/// Each group in its best order, found by trying all of them; the groups one after another.
std::vector<std::size_t> order_in_groups(const Routes& routes, std::size_t posts, std::size_t group) {
  std::vector<std::size_t> order(posts);
  for (std::size_t i = 0; i < posts; ++i) order[i] = i;
  for (std::size_t first = 0; first < posts; first += group) {
    const std::size_t last = std::min(first + group, posts);
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(last);
    std::vector<std::size_t> best(begin, end);
    double least = drive_time(routes, order, first, last);
    while (std::next_permutation(begin, end)) {
      const double time = drive_time(routes, order, first, last);
      if (time >= least) continue;
      least = time;
      best.assign(begin, end);
    }
    std::copy(best.begin(), best.end(), begin);
  }
  return order;
}

/// The posts in the best order of all that the tour solver finds.
Outcome<std::vector<std::size_t>> order_by_tour(const GuardProblem& problem, const GuardOptions& options,
                                                const Routes& routes, const std::vector<Post>& posts,
                                                const Budget& budget) {
  TourProblem tour{posts.size(),
                   problem.start.heading_rad,
                   problem.robot.turning(),
                   problem.gun.yaw_rate_radps,
                   problem.gun.pitch_rate_radps,
                   {{}},
                   {}};
  for (std::size_t i = 0; i < posts.size(); ++i) {
    const PlannedShot& shot = posts[i].hit.shot;
    tour.services.push_back(
        {{static_cast<std::uint32_t>(i), shot.gun.yaw_rad, shot.gun.pitch_rad, shot.flight_s}});
  }
  for (std::size_t i = 0; i <= posts.size(); ++i) {
    for (std::size_t j = 0; j <= posts.size(); ++j) tour.drives.push_back(routes.between(i, j));
  }
  TourOptions tour_options;
  tour_options.iterations = options.iterations;
  auto solved = solve(tour, tour_options, budget);
  if (!solved) return pass_on(solved);
  std::vector<std::size_t> order;
  for (const Visit& visit : solved->visits) order.push_back(visit.stop - 1);
  return order;
}

/// The plan that stops at the posts in their order; neighbours at one place are one stop.
Outcome<GuardPlan> plan_of(const GuardProblem& problem, const FiringMap& firing_map, const Budget& budget,
                           std::vector<Post> posts, GuardPlan plan) {
  for (Post& post : posts) {
    if (plan.stops.empty() || plan.stops.back().position != post.place) {
      plan.stops.push_back({post.place, {}, {}});
    }
    plan.stops.back().hits.push_back(std::move(post.hit));
  }
  if (plan.stops.empty()) return plan;
  if (auto ok = finish_plan(problem, firing_map, budget, plan); !ok) return pass_on(ok);
  return plan;
}

std::vector<Post> reordered(std::vector<Post> posts, const std::vector<std::size_t>& order) {
  std::vector<Post> result;
  result.reserve(order.size());
  for (const std::size_t i : order) result.push_back(std::move(posts[i]));
  return result;
}

}  // namespace

Outcome<GuardPlan> shrinking_circles(const GuardProblem& problem, const FiringMap& firing_map,
                                     const GuardOptions& options, const Budget& budget, std::size_t group) {
  GuardPlan plan = begin_plan(problem, firing_map, options);
  auto posts = posts_on_circles(problem, firing_map, plan);
  auto routes = yard_routes(problem, firing_map, places_of(problem, posts), budget);
  if (!routes) return pass_on(routes);
  const auto order = order_in_groups(*routes, posts.size(), group);
  return plan_of(problem, firing_map, budget, reordered(std::move(posts), order), std::move(plan));
}

Outcome<GuardPlan> circles_in_order(const GuardProblem& problem, const FiringMap& firing_map,
                                    const GuardOptions& options, const Budget& budget) {
  GuardPlan plan = begin_plan(problem, firing_map, options);
  auto posts = posts_on_circles(problem, firing_map, plan);
  if (posts.empty()) return plan;
  auto routes = yard_routes(problem, firing_map, places_of(problem, posts), budget);
  if (!routes) return pass_on(routes);
  auto order = order_by_tour(problem, options, *routes, posts, budget);
  if (!order) return pass_on(order);
  return plan_of(problem, firing_map, budget, reordered(std::move(posts), *order), std::move(plan));
}

Outcome<GuardPlan> source_target_table(const GuardProblem& problem, const FiringMap& firing_map,
                                       const GuardOptions& options, const Budget& budget) {
  GuardPlan plan = begin_plan(problem, firing_map, options);
  const int stride = std::max(1, static_cast<int>(std::lround(table_step_m / firing_map.frame.resolution_m)));
  struct ShotChoice {
    std::size_t cell;
    std::size_t target;
  };
  std::vector<ShotChoice> table;  // by cell, then by target
  for (std::size_t cell = 0; cell < firing_map.frame.size(); ++cell) {
    const Cell c = firing_map.frame.cell(cell);
    if (c.x % stride != 0 || c.y % stride != 0) continue;
    for (std::size_t t = 0; t < firing_map.regions.size(); ++t) {
      if (firing_map.has_shot(t, cell)) table.push_back({cell, t});
    }
  }
  std::vector<Post> posts;
  std::vector<std::uint8_t> served(problem.targets.size(), 0);
  Vec2 here = problem.start.position;
  while (!table.empty()) {
    const auto away = [&](const ShotChoice& e) { return distance(here, firing_map.place(e.cell)); };
    const auto next = std::ranges::min_element(table, {}, away);
    const std::size_t t = next->target;
    const double pitch = posts.empty() ? 0.0 : posts.back().hit.shot.gun.pitch_rad;
    auto post = post_at(problem, firing_map, t, next->cell, pitch);
    if (!post) {
      table.erase(next);
      continue;
    }
    here = post->place;
    served[t] = 1;
    posts.push_back(*std::move(post));
    std::erase_if(table, [t](const ShotChoice& e) { return e.target == t; });
  }
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    if (served[t] != 0 || firing_map.regions[t].hits == 0) continue;
    plan.unreachable.push_back({t, "none of the places in the table has a shot at it"});
  }
  return plan_of(problem, firing_map, budget, std::move(posts), std::move(plan));
}

}  // namespace outrider
