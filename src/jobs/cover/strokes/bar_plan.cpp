#include "strokes/bar_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "ground/tool_coverage.hpp"
#include "outrider/core/units.hpp"
#include "strokes/bar_strokes.hpp"
#include "strokes/field_work.hpp"

namespace outrider::cover {
namespace {

constexpr double sliver_part = 4e-3;    // of the width: narrower than twice that is left
constexpr double worth_part = 0.01;     // of the square of the width, that a stroke has to add
constexpr std::size_t most_units = 40;  // whose order is proven

/// The edges of the area with the solid on the right, the longest first.
std::vector<Segment> longest_edges(const Region& area) {
  std::vector<Segment> edges = edges_of(area);
  std::ranges::stable_sort(edges, std::greater{}, [](Segment s) { return distance(s.a, s.b); });
  return edges;
}

/// Gathers units until nothing is left that is worth one.
class BarUnits {
 public:
  BarUnits(const CoverProblem& problem, const CoverOptions& options, const CoverField& field,
           const BarRoom& room, TransitPlanner& transit, const Budget& budget)
      : problem_(problem),
        field_(field),
        room_(room),
        transit_(transit),
        stop_(budget.stop),
        edges_(longest_edges(field.area)),
        headings_(sweep_headings(field, options.directions)),
        turn_(wall_turn(room.bar())),
        rest_(field.reach) {}

  /// Strokes along the edges, that many strides inside; with the wall on the left if `other_way` says so.
  void add_edges(bool other_way, int deep) {
    const double width_m = room_.bar().width_m;
    const double beside_m = std::max(0.5 * width_m + turn_.gap_m, problem_.body_radius_m()) + room_.slack_m();
    const double off_m = beside_m + deep * problem_.stride_m();
    const double away_m = (problem_.radius_m() - beside_m) / std::sin(turn_.angle_rad) + 1e-3 * width_m;
    for (const Segment& edge : edges_) {
      if (stop_.stop_requested()) return;
      const Vec2 off = off_m * perpendicular(direction(heading_of(edge.b - edge.a)));
      BarLine line{edge.a + off, edge.b + off, width_m, turn_.angle_rad, away_m};
      if (other_way) {
        std::swap(line.from, line.to);
        line.away_rad = -line.away_rad;
      }
      auto stroke = bar_stroke(line, room_, PieceRole::lap);
      if (!stroke) continue;
      const Region covered = covered_by(*stroke);
      if (area_of(common(rest_, covered)) < worth_part * width_m * width_m) continue;
      rest_ = without(rest_, covered);
      units.push_back({std::move(*stroke)});
      ++laps;
    }
  }

  /// Lanes over what is left.
  Status add_cells() {
    const double sliver_m = sliver_part * room_.bar().width_m;
    const Region wide = opened(rest_, sliver_m, 0.1 * sliver_m);
    CellChoices choices = cells_of(wide, problem_, headings_, stop_);
    const double spent_m2 = area_of(rest_) - area_of(wide);
    leave_uncovered(choices, std::max(0.0, 0.5 * problem_.uncovered * area_of(field_.reach) - spent_m2));
    for (const auto& choice : choices) {
      auto unit = cell_of(choice.front());
      if (!unit) return pass_on(unit);
      if (unit->empty()) continue;
      rest_ = without(rest_, covered_by(unit->front()));
      units.push_back(std::move(*unit));
      ++cells;
    }
    return {};
  }

  [[nodiscard]] double left_m2() const {
    const double sliver_m = sliver_part * room_.bar().width_m;
    return area_of(opened(rest_, sliver_m, 0.1 * sliver_m));
  }

  std::vector<CoverageUnit> units;
  std::size_t laps = 0;
  std::size_t cells = 0;

 private:
  [[nodiscard]] Region covered_by(const Traversal& way) const {
    const PathPiece& first = way.pieces.front();
    return coverage_along({first.from, heading_in(first)}, way.pieces, problem_, field_.area, true, stop_)
        .covered;
  }

  /// Back and forth over the lanes of the cell that have strokes, from either end of the first and of the
  /// last.
  Outcome<CoverageUnit> cell_of(const SweepCell& cell) {
    CoverageUnit unit;
    for (const bool last_first : {false, true}) {
      std::vector<Segment> lanes = cell.lanes;
      if (last_first) std::reverse(lanes.begin(), lanes.end());
      for (const bool from_b : {false, true}) {
        auto way = back_and_forth(lanes, from_b);
        if (!way) return pass_on(way);
        if (!way->pieces.empty()) unit.push_back(std::move(*way));
      }
      if (lanes.size() == 1) break;
    }
    return unit;
  }

  Outcome<Traversal> back_and_forth(const std::vector<Segment>& lanes, bool from_b) {
    Traversal all;
    bool back = from_b;
    for (const Segment& lane : lanes) {
      BarLine line{back ? lane.b : lane.a, back ? lane.a : lane.b};
      auto stroke = bar_stroke(line, room_, PieceRole::lane);
      if (!stroke) continue;
      if (!all.pieces.empty()) {
        auto move = transit_.way(all.exit(), stroke->entry());
        if (!move) return pass_on(move);
        all.pieces.insert(all.pieces.end(), move->begin(), move->end());
        all.roles.resize(all.pieces.size(), PieceRole::move);
      }
      all.pieces.insert(all.pieces.end(), stroke->pieces.begin(), stroke->pieces.end());
      all.roles.insert(all.roles.end(), stroke->roles.begin(), stroke->roles.end());
      back = !back;
    }
    return all;
  }

  const CoverProblem& problem_;
  const CoverField& field_;
  const BarRoom& room_;
  TransitPlanner& transit_;
  std::stop_token stop_;
  std::vector<Segment> edges_;
  std::vector<double> headings_;
  WallTurn turn_;
  Region rest_;
};

/// Adds strokes until little is left, or nothing adds to them.
Status gather(BarUnits& units, const CoverProblem& problem, const CoverField& field) {
  const auto done = [&] { return units.left_m2() <= 0.5 * problem.uncovered * area_of(field.reach); };
  units.add_edges(false, 0);
  if (auto good = units.add_cells(); !good) return good;
  for (int deep = 0; deep <= 1 && !done(); ++deep) {
    units.add_edges(true, deep);
    if (deep > 0) units.add_edges(false, deep);
    if (auto good = units.add_cells(); !good) return good;
  }
  return {};
}

}  // namespace

Outcome<CoverPlan> bar_plan(const CoverProblem& problem, const CoverOptions& options, const Budget& budget) {
  auto ground = cover_ground(problem);
  if (!ground) return pass_on(ground);
  const CoverField& field = ground->fields.front();
  auto room = BarRoom::of(problem, field);
  if (!room) return pass_on(room);
  TransitPlanner transit(*ground, budget);
  BarUnits units(problem, options, field, *room, transit, budget);
  if (auto good = gather(units, problem, field); !good) return pass_on(good);
  if (budget.stop.stop_requested())
    return fault(FaultCode::cancelled, "it was cancelled while it planned lanes");
  if (units.units.empty()) {
    return bad_input(
        fmt::format("a bar {:g} m wide finds no stroke in the area; give a smaller one", problem.strip_m()),
        "tool.width");
  }
  TourOptions tour = options.order;
  if (units.units.size() > most_units) tour.gap = 1.0;
  auto order = ordered(units.units, problem.start, problem.pace, tour, budget, transit);
  if (!order) return pass_on(order);
  CoverPlan plan;
  plan.method = "boustrophedon";
  plan.track = std::move(order->track);
  plan.roles = std::move(order->roles);
  plan.begins = std::move(order->begins);
  plan.order_bound_s = order->bound_s;
  plan.laps = units.laps;
  plan.cells = units.cells;
  plan.lanes = static_cast<std::size_t>(std::count(plan.roles.begin(), plan.roles.end(), PieceRole::lane));
  plan.sums = sums_of(plan.track.start.heading_rad, plan.track.pieces, problem.pace);
  plan.ground = std::move(*ground);
  return plan;
}

}  // namespace outrider::cover
