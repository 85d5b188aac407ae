#include <algorithm>
#include <cmath>

#include "coverage_units.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

using namespace cover;

constexpr std::size_t most_stops = 240;  // of the tour, where there are fewer units than that
constexpr std::size_t most_proven = 40;  // units whose order is proven; sweeps take no more goals
constexpr double slack_part = 1e-3;      // of the stride: more than all rounding and chords

/// The widest slab, a little less than a stride, and how much farther than half of it the core keeps from the
/// border of the standing room, so that lanes are free in spite of rounding.
struct Strides {
  double slab_m;
  double slack_m;
  explicit Strides(const CoverProblem& problem)
      : slab_m((1.0 - 4.0 * slack_part) * problem.stride_m()), slack_m(slack_part * problem.stride_m()) {}
};

/// The points of the standing room whose distance from a lap along its border is at least `depth_m`.
Region core_of(const CoverProblem& problem, const CoverField& field, double depth_m) {
  const Strides strides(problem);
  const Region deep =
      shrunk(field.area, problem.radius_m() + depth_m + strides.slack_m, 0.25 * strides.slack_m);
  Region core;
  for (const RingedPolygon& polygon : deep) {
    if (contains(field.standing, polygon.outer.front())) core.push_back(polygon);
  }
  return core;
}

/// Laps of a ground that belong to the part where the robot starts.
std::vector<Lap> laps_within(const PolygonGround& ground, const Region& standing, double arc_m) {
  std::vector<Lap> laps = laps_of(ground);
  std::erase_if(laps, [&](const Lap& lap) {
    const Vec2 p = lap.front().from;
    return std::none_of(standing.begin(), standing.end(), [&](const RingedPolygon& part) {
      return contains(part, p) || distance_to_border(part, p) <= 2.0 * arc_m;
    });
  });
  return laps;
}

/// Headings of the longest edges of the field, and across them, each once.
std::vector<double> sweep_headings(const CoverField& field, std::int64_t count) {
  std::vector<std::pair<double, double>> edges;  // minus the length, heading in [0, pi/2)
  const auto add_edges = [&](const std::vector<Vec2>& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
      const double heading = std::fmod(heading_of(edge) + 2.0 * pi, 0.5 * pi);
      edges.emplace_back(-norm(edge), heading);
    }
  };
  add_edges(field.ground->boundary);
  for (const auto& obstacle : field.ground->obstacles) add_edges(obstacle);
  std::stable_sort(edges.begin(), edges.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> headings;
  for (const auto& [length, heading] : edges) {
    if (static_cast<std::int64_t>(headings.size()) >= count) break;
    const bool known = std::any_of(headings.begin(), headings.end(), [&, h = heading](double other) {
      return std::abs(std::remainder(h - other, 0.5 * pi)) < radians(2.0);
    });
    if (known) continue;
    headings.push_back(heading);
    headings.push_back(heading + 0.5 * pi);
  }
  return headings;
}

/// Time of getting from one lane to the next.
double change_time_s(const CoverProblem& problem) {
  return 2.0 * (duration(0.5 * pi, problem.pace.turning()) + problem.pace.pause_s) +
         duration(problem.stride_m(), problem.pace.straight());
}

/// Time of the lanes and of getting from one to the next.
double sweep_time_s(const std::vector<SweepCell>& cells, const CoverProblem& problem) {
  const double change = change_time_s(problem);
  double time = 0.0;
  for (const SweepCell& cell : cells) {
    for (const Segment& lane : cell.lanes) {
      time += change + duration(distance(lane.a, lane.b), problem.pace.straight());
    }
  }
  return time;
}

/// Cells of each connected part of the region in the heading that takes the least time, and for each cell
/// other headings of its own that cover it in one back-and-forth, best first. Fewer once the token is raised.
using CellChoices = std::vector<std::vector<SweepCell>>;

CellChoices cells_of(const Region& core, const CoverProblem& problem, const std::vector<double>& headings,
                     const std::stop_token& stop) {
  const Strides strides(problem);
  const double change_m = problem.pace.speed_mps * change_time_s(problem);
  const auto cut = [&](const Region& region, double heading) {
    return sweep_cells(region, heading, strides.slab_m, strides.slack_m, change_m);
  };
  std::vector<SweepCell> best;
  for (const RingedPolygon& part : core) {
    std::vector<SweepCell> least;
    for (const double heading : headings) {
      if (stop.stop_requested()) return {};
      auto cells = cut({part}, heading);
      if (least.empty() || sweep_time_s(cells, problem) < sweep_time_s(least, problem))
        least = std::move(cells);
    }
    std::move(least.begin(), least.end(), std::back_inserter(best));
  }
  CellChoices choices;
  for (const SweepCell& cell : best) {
    std::vector<SweepCell> choice{cell};
    for (const double heading : headings) {
      if (stop.stop_requested()) return choices;
      auto other = cut(cell.area, heading);
      if (other.size() == 1) choice.push_back(std::move(other.front()));
    }
    std::stable_sort(choice.begin(), choice.end(), [&](const SweepCell& a, const SweepCell& b) {
      return sweep_time_s({a}, problem) < sweep_time_s({b}, problem);
    });
    choices.push_back(std::move(choice));
  }
  return choices;
}

/// Removes the smallest cells, as long as their area together is at most `most_m2`. Returns that area, m2.
double leave_uncovered(CellChoices& cells, double most_m2) {
  std::stable_sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) {
    return area_of(a.front().area) > area_of(b.front().area);
  });
  double removed = 0.0;
  while (!cells.empty() && removed + area_of(cells.back().front().area) <= most_m2) {
    removed += area_of(cells.back().front().area);
    cells.pop_back();
  }
  return removed;
}

/// The laps and the cells of a field.
struct FieldWork {
  std::vector<Lap> laps;
  CellChoices cells;
};

Outcome<std::vector<CoverageUnit>> units_of(const std::vector<FieldWork>& works, std::size_t each,
                                            TransitPlanner& transit) {
  std::vector<CoverageUnit> units;
  for (const FieldWork& work : works) {
    for (const Lap& lap : work.laps) units.push_back(lap_unit(lap, each / 2));
  }
  for (const FieldWork& work : works) {
    for (const auto& choice : work.cells) {
      CoverageUnit unit;
      for (const SweepCell& cell : choice) {
        if (!unit.empty() && (unit.size() + 4 > each || unit.size() > 4)) break;
        auto ways = cell_unit(cell, transit);
        if (!ways) return pass_on(ways);
        unit.insert(unit.end(), ways->begin(), ways->end());
      }
      units.push_back(std::move(unit));
    }
  }
  return units;
}

/// Orders laps and cells into one track.
Outcome<CoverPlan> assembled(CoverageArea ground, std::vector<FieldWork> works, const CoverProblem& problem,
                             const CoverOptions& options, const Budget& budget) {
  if (budget.stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled while it planned lanes");
  CoverPlan plan;
  for (std::size_t i = 0; i < works.size(); ++i) {
    plan.uncovered_m2 += leave_uncovered(works[i].cells, problem.uncovered * area_of(ground.fields[i].reach));
    plan.laps += works[i].laps.size();
    plan.cells += works[i].cells.size();
  }
  TransitPlanner transit(ground, budget);
  const std::size_t each = most_stops / std::max<std::size_t>(1, plan.laps + plan.cells);
  auto units = units_of(works, each, transit);
  if (!units) return pass_on(units);
  TourOptions tour = options.order;
  if (units->size() > most_proven) tour.gap = 1.0;
  auto order = ordered(*units, problem.start, problem.pace, tour, budget, transit);
  if (!order) return pass_on(order);
  plan.track = std::move(order->track);
  plan.roles = std::move(order->roles);
  plan.begins = std::move(order->begins);
  plan.order_bound_s = order->bound_s;
  plan.lanes = static_cast<std::size_t>(std::count(plan.roles.begin(), plan.roles.end(), PieceRole::lane));
  plan.sums = sums_of(plan.track.start.heading_rad, plan.track.pieces, problem.pace);
  plan.ground = std::move(ground);
  return plan;
}

FieldWork sweep(const CoverField& field, double arc_m, const CoverProblem& problem,
                const CoverOptions& options, const std::stop_token& stop) {
  const Region core = core_of(problem, field, 0.5 * Strides(problem).slab_m);
  return {laps_within(*field.ground, field.standing, arc_m),
          cells_of(core, problem, sweep_headings(field, options.directions), stop)};
}

Outcome<CoverPlan> boustrophedon(const CoverProblem& problem, const CoverOptions& options,
                                 const Budget& budget) {
  auto ground = cover_ground(problem);
  if (!ground) return pass_on(ground);
  std::vector<FieldWork> works;
  for (const CoverField& field : ground->fields)
    works.push_back(sweep(field, ground->arc_m, problem, options, budget.stop));
  auto plan = assembled(std::move(*ground), std::move(works), problem, options, budget);
  if (plan) plan->method = "boustrophedon";
  return plan;
}

/// Laps along the border and inwards, each a stride from the one before.
Outcome<std::vector<Lap>> spiral_laps(const CoverProblem& problem, const CoverField& field, double arc_m,
                                      const std::stop_token& stop) {
  std::vector<Lap> all = laps_within(*field.ground, field.standing, arc_m);
  for (int k = 1;; ++k) {
    const double radius = problem.radius_m() + k * problem.stride_m();
    if (radius > most_polygon_radius_m || stop.stop_requested()) return all;
    auto inner = PolygonGround::of(field.ground->boundary, field.ground->obstacles, radius);
    if (!inner) return pass_on(inner);
    const auto laps = laps_within(*inner, field.standing, 0.0);
    if (laps.empty()) return all;
    all.insert(all.end(), laps.begin(), laps.end());
  }
}

Outcome<FieldWork> laps_inwards(const CoverField& field, double arc_m, const CoverProblem& problem,
                                const CoverOptions& options, const std::stop_token& stop) {
  auto laps = spiral_laps(problem, field, arc_m, stop);
  if (!laps) return pass_on(laps);
  // What the laps surely leave, deep enough inside for lanes: where they meet at sharp corners and ends.
  Region core = core_of(problem, field, problem.sure_radius_m() - 2.0 * Strides(problem).slack_m);
  for (const Lap& lap : *laps) {
    if (stop.stop_requested()) break;  // assembled() says so
    const auto points = points_along(lap.front().from, lap, radians(2.0));
    core = without(core, coverage_of(points, problem.sure_radius_m(), core, stop).covered);
  }
  return FieldWork{std::move(*laps),
                   cells_of(core, problem, sweep_headings(field, options.directions), stop)};
}

Outcome<CoverPlan> spiral(const CoverProblem& problem, const CoverOptions& options, const Budget& budget) {
  auto ground = cover_ground(problem);
  if (!ground) return pass_on(ground);
  std::vector<FieldWork> works;
  for (const CoverField& field : ground->fields) {
    auto work = laps_inwards(field, ground->arc_m, problem, options, budget.stop);
    if (!work) return pass_on(work);
    works.push_back(std::move(*work));
  }
  auto plan = assembled(std::move(*ground), std::move(works), problem, options, budget);
  if (plan) plan->method = "spiral";
  return plan;
}

Outcome<CoverPlan> quickest(const CoverProblem& problem, const CoverOptions& options, const Budget& budget) {
  auto best = boustrophedon(problem, options, budget);
  if (!best) return best;
  auto other = spiral(problem, options, budget);
  if (other && other->sums.time_s < best->sums.time_s) return other;
  return best;
}

}  // namespace

std::vector<Option> describe(CoverOptions& options) {
  std::vector<Option> all{{"directions", "", 1.0, 64.0,
                           "sweep directions to try: along the longest edges and across them",
                           &options.directions}};
  for (Option& option : describe(options.order)) all.push_back(std::move(option));
  return all;
}

const std::vector<CoverMethod>& cover_methods() {
  static const std::vector<CoverMethod> rows = {
      {"boustrophedon", "a lap along every wall and obstacle, then back and forth in each cell between them",
       "Choset and Pignon, Coverage path planning: the boustrophedon cellular decomposition (1998)",
       boustrophedon},
      {"spiral", "laps inwards, a stride from one to the next; what they leave is swept",
       "Held, On the computational geometry of pocket machining (1991)", spiral},
      {"quickest", "the one of the others that takes less time", "", quickest},
  };
  return rows;
}

Outcome<CoverMethod> find_cover_method(std::string_view name) {
  return find_row(cover_methods(), "method", name, "method");
}

}  // namespace outrider
