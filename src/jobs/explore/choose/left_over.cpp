#include "outrider/jobs/explore/choose/left_over.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include "map/narrow.hpp"
#include "map/rays.hpp"
#include "map/sight.hpp"

namespace outrider {
namespace {

constexpr int most_tries = 3;
/// Noise may draw each wall beside a gap up to a cell and a half too near, and the middle of the gap is up to
/// half a cell from the centre of a cell.
constexpr double map_error_cells = 2.0;

constexpr std::array<std::string_view, 6> reasons = {"too narrow", "touched there",  "no way leads there",
                                                     "failed",     "looked in vain", "not tried yet"};

/// Counts unknown cells in sight of frontiers, each once.
class Area {
 public:
  Area(const Grid<std::uint8_t>& known, double range_m)
      : known_(known),
        counted_(known.cells.size(), 0),
        fan_(RayFan::of(static_cast<int>(range_m / known.frame.resolution_m), gain_rays)) {}

  /// Returns the area in sight of a cell, and the part of it that has not been counted before.
  std::pair<double, double> count(std::uint32_t from) {
    std::vector<std::uint32_t> cells;
    const Cell origin = known_.frame.cell(from);
    for (const std::vector<Cell>& ray : fan_.rays) {
      for (const Cell offset : ray) {
        const Cell at{origin.x + offset.x, origin.y + offset.y};
        if (!known_.contains(at) || known_[at] == occupied_cell) break;
        if (known_[at] == unknown_cell) cells.push_back(static_cast<std::uint32_t>(known_.frame.index(at)));
      }
    }
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    std::size_t added = 0;
    for (const std::uint32_t cell : cells) added += std::exchange(counted_[cell], 1) == 0 ? 1 : 0;
    const double cell_m2 = known_.frame.resolution_m * known_.frame.resolution_m;
    return {cell_m2 * static_cast<double>(cells.size()), cell_m2 * static_cast<double>(added)};
  }

 private:
  const Grid<std::uint8_t>& known_;
  std::vector<std::uint8_t> counted_;
  RayFan fan_;
};

/// Returns a narrow place on the way, one that was measured if there is one; null if there is none.
const NarrowPlace* find_near(const std::vector<NarrowPlace>& places, const std::vector<Vec2>& way) {
  const NarrowPlace* found = nullptr;
  for (const NarrowPlace& one : places) {
    const auto is_near = [&](Vec2 point) { return distance(one.place, point) <= same_place_m; };
    if ((found == nullptr || (one.measured && !found->measured)) && std::ranges::any_of(way, is_near))
      found = &one;
  }
  return found;
}

/// Judges one frontier after another.
class Judge {
 public:
  Judge(const ExploreState& state, const ExploreOptions& options, const std::vector<NarrowPlace>& narrow)
      : state_(state),
        options_(options),
        narrow_(narrow),
        free_(widest_ways(ground_, state.pose.position, false, 0.0)),
        past_touches_(widest_ways(ground_, state.pose.position, true, 0.0)),
        area_(ground_.known(), state.range_m) {}

  void judge(const Frontier& frontier, const RefusedFrontier* refused, LeftOvers& found) {
    if (refused != nullptr && refused->kind == Refusal::small) return;
    const std::uint32_t cell = past_touches_.roomiest(frontier.cells);
    if (past_touches_.room_m[cell] == 0.0F || !is_opening(frontier)) return;
    const auto [in_sight_m2, new_m2] = area_.count(cell);
    if (in_sight_m2 < options_.least_left_m2) return;
    LeftOver left{frontier.id, frontier.centroid, LeftReason::not_tried, 0.0, frontier.centroid, new_m2, {}};
    explain(frontier, refused, left, found);
    found.places.push_back(std::move(left));
  }

  /// The ways to try, the roomiest first.
  void sort(LeftOvers& found) {
    std::ranges::stable_sort(found.worth_a_try, std::greater<>(), [&](const NarrowWay& way) {
      return free_.room_m[free_.roomiest(state_.map.frontiers().at(way.frontier).cells)];
    });
  }

 private:
  /// Returns true if the frontier is no mere gap in a wall.
  [[nodiscard]] bool is_opening(const Frontier& frontier) const {
    return std::ranges::any_of(frontier.cells, [&](std::uint32_t cell) {
      return ground_.clearance_m(ground_.frame().cell(cell)) >= 0.5 * options_.least_opening_m - 1e-6;
    });
  }

  void explain(const Frontier& frontier, const RefusedFrontier* refused, LeftOver& left, LeftOvers& found) {
    if (refused == nullptr) {
      set_reason(left, LeftReason::not_tried, "the robot did not come to go there");
    } else if (refused->kind == Refusal::given_up &&  // seen in vain through a gap, the gap is the reason
               free_.room_m[free_.roomiest(frontier.cells)] == WidestWays::drivable) {
      set_reason(left, LeftReason::not_seen, refused->reason);
    } else if (refused->kind == Refusal::banned) {
      set_reason(left, LeftReason::failed, refused->reason);
    } else {
      explain_way(frontier, *refused, left, found);
    }
  }

  /// No way that is wide enough leads there.
  void explain_way(const Frontier& frontier, const RefusedFrontier& refused, LeftOver& left,
                   LeftOvers& found) {
    const std::uint32_t there = free_.roomiest(frontier.cells);
    const std::uint32_t past_there = past_touches_.roomiest(frontier.cells);
    const float room_m = free_.room_m[there], past_m = past_touches_.room_m[past_there];
    if (room_m == WidestWays::drivable) {
      set_reason(left, LeftReason::no_way, refused.reason);
      return;
    }
    if (past_m >= static_cast<float>(state_.robot.radius_m) && room_m < past_m)
      set_reason(left, LeftReason::touched,
                 "the robot touched something on the way that its laser does not see");
    if (room_m > 0.0F) {
      explain_narrow(frontier, there, room_m, left, found);
    } else if (left.reason != LeftReason::touched) {
      explain_narrow(frontier, past_there, 0.0F, left, found);
    }
  }

  /// The way there is narrow, or was found to be so.
  void explain_narrow(const Frontier& frontier, std::uint32_t there, float room_m, LeftOver& left,
                      LeftOvers& found) {
    const WidestWays& ways = room_m > 0.0F ? free_ : past_touches_;
    const std::vector<std::uint32_t> cells = ways.way_to(there);
    std::vector<Vec2> points;
    for (const std::uint32_t cell : cells)
      points.push_back(ground_.frame().centre(ground_.frame().cell(cell)));
    const Bottleneck bottleneck = bottleneck_of(ground_, cells);
    const NarrowPlace* tried = find_near(narrow_, points);
    const double error_m = map_error_cells * ground_.frame().resolution_m;
    const bool known = tried != nullptr && (tried->measured || tried->tries >= most_tries);
    const bool may_fit = room_m + error_m >= state_.robot.radius_m && !known;
    if (may_fit) found.worth_a_try.push_back({frontier.id, points, bottleneck.place});
    if (left.reason == LeftReason::touched) return;
    left.narrowest = bottleneck.place;
    left.width_m = bottleneck.width_m;
    if (tried != nullptr && tried->measured) {
      left.narrowest = tried->place;
      left.width_m = tried->width_m;
    }
    if (may_fit && tried == nullptr) {
      set_reason(left, LeftReason::not_tried,
                 fmt::format("the way there is {:.2f} m wide on the map at ({:.2f}, {:.2f}), and not tried",
                             left.width_m, left.narrowest.x, left.narrowest.y));
    } else {
      set_reason(left, LeftReason::narrow,
                 fmt::format("too narrow: {:.3f} m wide at ({:.2f}, {:.2f}) where the robot wants {:.3f} m",
                             left.width_m, left.narrowest.x, left.narrowest.y,
                             wanted_width_m(state_.robot, options_)));
    }
  }

  static void set_reason(LeftOver& left, LeftReason reason, std::string sentence) {
    left.reason = reason;
    left.sentence = std::move(sentence);
  }

  const ExploreState& state_;
  const ExploreOptions& options_;
  const std::vector<NarrowPlace>& narrow_;
  const TraversabilityGrid& ground_ = state_.map.ground();
  WidestWays free_;
  WidestWays past_touches_;
  Area area_;
};

}  // namespace

std::string_view to_string(LeftReason reason) { return reasons[static_cast<std::size_t>(reason)]; }

double LeftOvers::area_m2() const {
  double sum = 0.0;
  for (const LeftOver& one : places) sum += one.area_m2;
  return sum;
}

std::string LeftOvers::sentence(double wanted_m) const {
  if (places.empty()) return "nothing is left over";
  std::string because;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    const auto reason = static_cast<LeftReason>(i);
    const auto count = std::ranges::count(places, reason, &LeftOver::reason);
    if (count == 0) continue;
    double widest_m = 0.0;
    for (const LeftOver& one : places)
      if (one.reason == reason) widest_m = std::max(widest_m, one.width_m);
    because += fmt::format(
        "{}{} ({} place{}{})", because.empty() ? "" : "; ", reasons[i], count, count == 1 ? "" : "s",
        reason == LeftReason::narrow
            ? fmt::format(", at most {:.3f} m wide where the robot wants {:.3f} m", widest_m, wanted_m)
            : std::string());
  }
  return fmt::format("left over: up to {:.1f} m2, because: {}", area_m2(), because);
}

std::string LeftOvers::behind_gaps(double wanted_m) const {
  double widest_m = 0.0;
  std::vector<Vec2> gaps;
  for (const LeftOver& one : places) {
    widest_m = std::max(widest_m, one.width_m);
    const auto is_same = [&](Vec2 gap) { return distance(gap, one.narrowest) <= same_place_m; };
    if (std::ranges::none_of(gaps, is_same)) gaps.push_back(one.narrowest);
  }
  return fmt::format(
      "up to {:.1f} m2 lie behind {} gap{} too narrow for the robot, at most {:.3f} m wide where it wants "
      "{:.3f} m",
      area_m2(), gaps.size(), gaps.size() == 1 ? "" : "s", widest_m, wanted_m);
}

LeftOvers take_behind_gaps(LeftOvers& left, const std::vector<NarrowPlace>& narrow) {
  LeftOvers behind;
  const auto is_behind = [&](const LeftOver& one) {
    const NarrowPlace* tried = find_near(narrow, {one.narrowest});
    return one.reason == LeftReason::narrow && (tried == nullptr || tried->measured);
  };
  std::ranges::copy_if(left.places, std::back_inserter(behind.places), is_behind);
  std::erase_if(left.places, is_behind);
  return behind;
}

double wanted_width_m(const RobotModel& robot, const ExploreOptions& options) {
  return 2.0 * (robot.radius_m + options.gap_margin_m);
}

LeftOvers left_over(const ExploreState& state, const ExploreOptions& options,
                    const std::vector<RefusedFrontier>& refused, bool others,
                    const std::vector<NarrowPlace>& narrow) {
  LeftOvers found;
  if (state.map.frontiers().empty()) return found;
  Judge judge(state, options, narrow);
  for (const auto& [id, frontier] : state.map.frontiers()) {
    const auto reason = std::ranges::find(refused, id, &RefusedFrontier::frontier);
    if (reason == refused.end() && !others) continue;
    judge.judge(frontier, reason == refused.end() ? nullptr : &*reason, found);
  }
  judge.sort(found);
  return found;
}

}  // namespace outrider
