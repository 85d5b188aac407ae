#include <algorithm>
#include <cmath>

#include "ground/coverage_units.hpp"
#include "outrider/core/units.hpp"
#include "strokes/bar_plan.hpp"
#include "strokes/field_work.hpp"
#include "strokes/lap_sections.hpp"
#include "strokes/turning_plan.hpp"

namespace outrider {
namespace {

using namespace cover;

constexpr std::size_t most_stops = 240;  // of the tour, where there are fewer units than that
constexpr double far_strides = 1.5;      // between ends of neighbouring lanes, worth cutting laps
constexpr std::size_t most_proven = 40;  // units whose order is proven; sweeps take no more goals

/// The laps and the cells of a field.
struct FieldWork {
  std::vector<Lap> laps;
  CellChoices cells;
  std::vector<Lap> sections = {};  ///< parts of laps that are driven apart
};

/// The ways to drive a section of a lap, which is open.
CoverageUnit section_unit(const Lap& section) {
  CoverageUnit unit;
  for (const Lap& way : {section, turned_round(section)})
    unit.push_back({way, std::vector<PieceRole>(way.size(), PieceRole::lap)});
  return unit;
}

Outcome<std::vector<CoverageUnit>> units_of(const std::vector<FieldWork>& works, std::size_t each,
                                            TransitPlanner& transit) {
  std::vector<CoverageUnit> units;
  for (const FieldWork& work : works) {
    for (const Lap& lap : work.laps) units.push_back(lap_unit(lap, each / 2));
    for (const Lap& section : work.sections) units.push_back(section_unit(section));
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

/// Returns the works with their laps cut into sections, where lanes of tapers end.
std::vector<FieldWork> sectioned(const std::vector<FieldWork>& works, const CoverProblem& problem,
                                 const std::stop_token& stop) {
  std::vector<FieldWork> cut;
  for (const FieldWork& work : works) {
    std::vector<SweepCell> cells;
    for (const auto& choice : work.cells) cells.push_back(choice.front());
    cut.push_back({{}, work.cells, {}});
    for (const Lap& lap : work.laps) {
      const auto sections =
          lap_sections(lap, cells, far_strides * problem.stride_m(), 1.5 * problem.stride_m(), stop);
      auto& into = sections.size() > 1 ? cut.back().sections : cut.back().laps;
      into.insert(into.end(), sections.begin(), sections.end());
    }
  }
  return cut;
}

/// Orders laps and cells into one track.
Outcome<CoverPlan> plan_works_once(CoverageArea ground, std::vector<FieldWork> works,
                                   const CoverProblem& problem, const CoverOptions& options,
                                   const Budget& budget) {
  if (budget.stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled while it planned lanes");
  CoverPlan plan;
  for (std::size_t i = 0; i < works.size(); ++i) {
    plan.uncovered_m2 += leave_uncovered(works[i].cells, problem.uncovered * area_of(ground.fields[i].reach));
    plan.laps += works[i].laps.size() + works[i].sections.size();
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

bool is_cancelled(const Outcome<CoverPlan>& plan) {
  return !plan && plan.error().code == FaultCode::cancelled;
}

/// Orders whole laps and cells, or sections of laps and cells, whichever takes less time.
Outcome<CoverPlan> plan_works(CoverageArea ground, std::vector<FieldWork> works, const CoverProblem& problem,
                              const CoverOptions& options, const Budget& budget) {
  std::vector<FieldWork> cut = sectioned(works, problem, budget.stop);
  std::size_t units = 0, sections = 0;
  for (const FieldWork& work : cut) {
    sections += work.sections.size();
    units += work.laps.size() + work.sections.size() + work.cells.size();
  }
  auto whole = plan_works_once(ground, std::move(works), problem, options, budget);
  if (!whole || sections == 0 || units > most_proven) return whole;
  auto other = plan_works_once(std::move(ground), std::move(cut), problem, options, budget);
  return is_cancelled(other) || (other && other->sums.time_s < whole->sums.time_s) ? std::move(other)
                                                                                   : std::move(whole);
}

FieldWork sweep(const CoverField& field, double arc_m, const CoverProblem& problem,
                const CoverOptions& options, const std::stop_token& stop) {
  const Region core = core_of(problem, field, 0.5 * Strides(problem).slab_m);
  return {laps_within(*field.ground, field.standing, arc_m),
          cells_of(core, problem, sweep_headings(field, options.directions), stop),
          {}};
}

Outcome<CoverPlan> named(Outcome<CoverPlan> plan, const char* method) {
  if (plan) plan->method = method;
  return plan;
}

Outcome<CoverPlan> boustrophedon(const CoverProblem& problem, const CoverOptions& options,
                                 const Budget& budget) {
  if (problem.curves()) return turning_plan(problem, options, budget, TurningMethod::lanes);
  if (problem.bar()) return bar_plan(problem, options, budget);
  auto ground = cover_ground(problem);
  if (!ground) return pass_on(ground);
  std::vector<FieldWork> works;
  for (const CoverField& field : ground->fields)
    works.push_back(sweep(field, ground->arc_m, problem, options, budget.stop));
  return named(plan_works(std::move(*ground), std::move(works), problem, options, budget), "boustrophedon");
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
  // The core is the area that the laps surely leave uncovered, deep enough inside for lanes. It lies where
  // they meet at sharp corners and ends.
  Region core = core_of(problem, field, problem.sure_radius_m() - 2.0 * Strides(problem).slack_m);
  for (const Lap& lap : *laps) {
    if (stop.stop_requested()) break;  // plan_works() says so
    const auto points = points_along(lap.front().from, lap, radians(2.0));
    core = without(core, coverage_of(points, problem.sure_radius_m(), core, stop).covered);
  }
  return FieldWork{
      std::move(*laps), cells_of(core, problem, sweep_headings(field, options.directions), stop), {}};
}

Outcome<CoverPlan> spiral(const CoverProblem& problem, const CoverOptions& options, const Budget& budget) {
  if (problem.curves()) return turning_plan(problem, options, budget, TurningMethod::laps);
  if (problem.bar()) {
    return bad_input(
        "a spiral is planned for robots that cover with their disk; take 'boustrophedon' for a bar",
        "method");
  }
  auto ground = cover_ground(problem);
  if (!ground) return pass_on(ground);
  std::vector<FieldWork> works;
  for (const CoverField& field : ground->fields) {
    auto work = laps_inwards(field, ground->arc_m, problem, options, budget.stop);
    if (!work) return pass_on(work);
    works.push_back(std::move(*work));
  }
  return named(plan_works(std::move(*ground), std::move(works), problem, options, budget), "spiral");
}

Outcome<CoverPlan> quickest(const CoverProblem& problem, const CoverOptions& options, const Budget& budget) {
  if (problem.curves()) return turning_plan(problem, options, budget, TurningMethod::both);
  if (problem.bar()) return bar_plan(problem, options, budget);
  auto best = boustrophedon(problem, options, budget);
  if (!best) return best;
  auto other = spiral(problem, options, budget);
  if (is_cancelled(other) || (other && other->sums.time_s < best->sums.time_s)) return other;
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
