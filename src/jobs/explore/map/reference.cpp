#include "outrider/jobs/explore/map/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "outrider/world/clearance.hpp"
#include "outrider/world/nearest_cell.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double most_places = 25e6;
constexpr double most_side = 32768;  // of squared_clearance()
constexpr double nearby_m = 0.5;     // how far the nearest places are sought
constexpr int nearest_tried = 12;
constexpr std::int64_t ray_directions = 720;
constexpr double rescue_m = 2.0;  // how far a better start is sought
constexpr double farthest_error_m = 1.0;
constexpr std::array<Cell, 4> sides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// How many of some places the map has.
struct Share {
  std::size_t places = 0, found = 0;

  void count(bool is_found) {
    ++places;
    found += is_found ? 1 : 0;
  }
  [[nodiscard]] double value() const {
    return places > 0 ? static_cast<double>(found) / static_cast<double>(places) : 1.0;
  }
};

struct Survey {
  const RangeFinder& laser;
  const OpenGround& ground;
  Grid<std::uint8_t>& places;

  [[nodiscard]] Vec2 at(Cell c) const { return places.frame.centre(c); }
  [[nodiscard]] bool is(Cell c, std::uint8_t value) const { return places.contains(c) && places[c] == value; }
};

/// Cells no farther than `radius_m` from one of them, itself left out, the nearest first.
std::vector<Cell> around(double radius_m, double resolution_m) {
  const int most = static_cast<int>(radius_m / resolution_m);
  std::vector<Cell> cells;
  for (int y = -most; y <= most; ++y) {
    for (int x = -most; x <= most; ++x) {
      const int d2 = x * x + y * y;
      if (d2 > 0 && d2 <= most * most) cells.push_back({x, y});
    }
  }
  std::ranges::sort(cells, {}, [](Cell c) { return std::tuple(c.x * c.x + c.y * c.y, c.y, c.x); });
  return cells;
}

/// The lattice of cells through the origin of the world that covers the box.
Outcome<GridFrame> lattice(const Box2& box, double resolution_m) {
  const auto cells = [&](double m) { return std::floor(m / resolution_m); };
  const double width = cells(box.high.x) - cells(box.low.x) + 1.0;
  const double height = cells(box.high.y) - cells(box.low.y) + 1.0;
  if (!(width * height <= most_places && width <= most_side && height <= most_side)) {
    return bad_input(fmt::format("the world of {:.6g} m x {:.6g} m has more than 25 million cells of {:g} m; "
                                 "take a part of it, or larger cells",
                                 box.size().x, box.size().y, resolution_m),
                     "world");
  }
  const Vec2 origin = resolution_m * Vec2{cells(box.low.x), cells(box.low.y)};
  return GridFrame{origin, resolution_m, static_cast<int>(width), static_cast<int>(height)};
}

Status check_start(const OpenGround& ground, Vec2 start, double resolution_m) {
  const double gap_m = ground.gap_m(start);
  if (gap_m >= -1e-9) return {};
  std::string remedy = fmt::format("there is no free place within {:g} m; start it elsewhere", rescue_m);
  const GridFrame frame{{0.0, 0.0}, resolution_m, 0, 0};
  const Cell here = frame.cell_at(start);
  for (const Cell d : around(rescue_m, resolution_m)) {
    const Vec2 place = frame.centre({here.x + d.x, here.y + d.y});
    if (ground.gap_m(place) < 0.0) continue;
    remedy = fmt::format("the nearest place where it fits is {:.4g},{:.4g}", place.x, place.y);
    break;
  }
  return fault(FaultCode::start_blocked,
               fmt::format("at {:g},{:g} the robot reaches {:.3g} m into what stands there; {}", start.x,
                           start.y, -gap_m, remedy),
               "start");
}

/// Refuses a start from which nothing can ever be seen: an exploration from there would have no end.
Status check_sight(const RangeFinder& laser, const Box2& standing, Vec2 start) {
  const double most_m = laser.model().most_m;
  if (standing.empty())
    return bad_input("nothing stands in this world; there is nothing to explore", "world");
  if (standing.grown(most_m).contains(start)) return {};
  return fault(
      FaultCode::start_blocked,
      fmt::format("{} is outside the map, and nothing is within the {:g} m that the laser sees: all that "
                  "stands lies between {} and {}; start it in there",
                  place_text(start.x, start.y), most_m, place_text(standing.low.x, standing.low.y),
                  place_text(standing.high.x, standing.high.y)),
      "start");
}

/// Marks where the robot can be, in the order of the fewest steps, and tells the first place outside the box.
std::optional<Vec2> flood_ground(const Survey& survey, Vec2 start, const Box2& box) {
  std::vector<Cell> open;
  std::optional<Vec2> outside;
  const auto reach = [&](Vec2 from, Cell to) {
    if (!survey.is(to, not_seeable) || !survey.ground.free({from, survey.at(to)})) return;
    survey.places[to] = reachable;
    open.push_back(to);
    if (!outside && !box.contains(survey.at(to))) outside = survey.at(to);
  };
  const Cell here = survey.places.frame.cell_at(start);
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) reach(start, {here.x + x, here.y + y});
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Cell c = open[i];
    for (const Cell d : sides) reach(survey.at(c), {c.x + d.x, c.y + d.y});
  }
  return outside;
}

/// Returns true if one of the nearest reachable places is visible.
bool seen_from_near(const Survey& survey, Cell c, const std::vector<Cell>& offsets) {
  int tried = 0;
  for (const Cell d : offsets) {
    const Cell place{c.x + d.x, c.y + d.y};
    if (!survey.is(place, reachable)) continue;
    if (survey.laser.sees(survey.at(c), survey.at(place))) return true;
    if (++tried == nearest_tried) return false;
  }
  return false;
}

/// Returns true if a reachable place lies along one of the directions, within range. `apart_m` is a
/// lower bound of how far such a place is from any point of a cell, by which a ray may leap.
bool seen_from_afar(const Survey& survey, Cell c, const Grid<float>& apart_m) {
  const GridFrame& frame = survey.places.frame;
  const Vec2 from = survey.at(c);
  const double most_m = survey.laser.model().most_m;
  const std::vector<double> free = survey.laser.ranges({from, 0.0}, ray_directions);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Vec2 along = direction(2.0 * pi * static_cast<double>(i) / static_cast<double>(ray_directions));
    const double end_m = std::min(free[i], most_m);
    for (double t = apart_m[c]; t < end_m;) {
      const Cell at = frame.cell_at(from + t * along);
      if (!survey.places.contains(at)) break;
      if (survey.places[at] == reachable) return true;
      t += std::max(0.5 * frame.resolution_m, static_cast<double>(apart_m[at]));
    }
  }
  return false;
}

/// A lower bound of how far any point of a cell is from the cells that are set, m.
Grid<float> apart_from(const Grid<std::uint8_t>& set) {
  const Grid<std::uint32_t> squared = squared_clearance(set);
  Grid<float> apart_m(set.frame);
  for (std::size_t i = 0; i < squared.cells.size(); ++i) {
    const double cells = std::sqrt(static_cast<double>(squared.cells[i])) - std::sqrt(2.0);
    apart_m.cells[i] = static_cast<float>(std::max(0.0, cells * set.frame.resolution_m));
  }
  return apart_m;
}

/// Marks what can be seen beside where the robot can be. Whatever lies on a line of sight can be seen itself,
/// so only the neighbours of what can be seen are asked.
void flood_sight(const Survey& survey) {
  Grid<std::uint8_t> stands(survey.places.frame);
  for (std::size_t i = 0; i < stands.cells.size(); ++i) stands.cells[i] = survey.places.cells[i] == reachable;
  const Grid<float> apart_m = apart_from(stands);
  const double resolution_m = survey.places.frame.resolution_m;
  const std::vector<Cell> offsets = around(nearby_m, resolution_m);
  Grid<std::uint8_t> visited = stands;
  std::vector<Cell> open;
  for (std::size_t i = 0; i < stands.cells.size(); ++i) {
    if (stands.cells[i] != 0) open.push_back(stands.frame.cell(i));
  }
  while (!open.empty()) {
    const Cell c = open.back();
    open.pop_back();
    for (const Cell d : sides) {
      const Cell next{c.x + d.x, c.y + d.y};
      if (!visited.contains(next) || visited[next] != 0) continue;
      if (apart_m[next] > survey.laser.model().most_m) continue;
      if (!survey.laser.sees(survey.at(c), survey.at(next))) continue;
      visited[next] = 1;
      if (!seen_from_near(survey, next, offsets) && !seen_from_afar(survey, next, apart_m)) continue;
      const bool beside = survey.laser.surface_distance(survey.at(next), resolution_m) < resolution_m;
      survey.places[next] = beside ? beside_surface : only_seeable;
      open.push_back(next);
    }
  }
}

enum Side : std::uint8_t { unsorted = 0, before_gaps = 1, behind_gaps = 2 };

/// Tells the places before all gaps: those with that much room to which steps between such places lead from
/// the one that is nearest to the start. None if there is no such place.
std::vector<Cell> flood_before_gaps(const Survey& survey, Vec2 start, double room_m,
                                    Grid<std::uint8_t>& side) {
  const auto has_room = [&](Cell c) {
    return survey.is(c, reachable) && survey.ground.gap_m(survey.at(c)) >= room_m - 1e-9;
  };
  const auto first = nearest_cell(side.frame, start, rescue_m, has_room);
  if (!first) return {};
  std::vector<Cell> open{*first};
  side[*first] = before_gaps;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Cell c = open[i];
    for (const Cell d : sides) {
      const Cell next{c.x + d.x, c.y + d.y};
      if (!has_room(next) || side[next] != unsorted) continue;
      if (!survey.ground.free({survey.at(c), survey.at(next)})) continue;
      side[next] = before_gaps;
      open.push_back(next);
    }
  }
  return open;
}

/// Marks what lies behind gaps that leave the robot less than that room.
void mark_behind_gaps(const Survey& survey, Vec2 start, double room_m) {
  Grid<std::uint8_t> side(survey.places.frame, unsorted);
  std::vector<Cell> open = flood_before_gaps(survey, start, room_m, side);
  if (open.empty()) return;
  for (std::size_t i = 0; i < side.cells.size(); ++i) {
    const Cell c = side.frame.cell(i);
    if (survey.places[c] < only_seeable || side[c] != unsorted || survey.ground.gap_m(survey.at(c)) < room_m)
      continue;
    side[c] = behind_gaps;
    open.push_back(c);
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Cell c = open[i];
    for (const Cell d : sides) {
      const Cell next{c.x + d.x, c.y + d.y};
      if (!side.contains(next) || side[next] != unsorted || survey.places[next] == not_seeable) continue;
      side[next] = side[c];
      open.push_back(next);
    }
  }
  for (std::size_t i = 0; i < side.cells.size(); ++i) {
    std::uint8_t& place = survey.places.cells[i];
    if (place >= only_seeable && side.cells[i] == behind_gaps) place = behind_gap;
  }
}

void add_up(ExplorationReference& truth) {
  const GridFrame& frame = truth.places.frame;
  const double cell_m2 = frame.resolution_m * frame.resolution_m;
  for (std::size_t i = 0; i < truth.places.cells.size(); ++i) {
    if (truth.places.cells[i] == not_seeable) continue;
    truth.seeable_m2 += cell_m2;
    if (truth.places.cells[i] == reachable) truth.reachable_m2 += cell_m2;
  }
}

}  // namespace

Outcome<ExplorationReference> exploration_reference(const RangeFinder& laser, const OpenGround& ground,
                                                    Vec2 start, double room_m, double resolution_m) {
  if (auto ok = check_start(ground, start, resolution_m); !ok) return pass_on(ok);
  Box2 standing;
  for (const Box2& box : {laser.bounds(), ground.bounds()}) {
    if (box.empty()) continue;
    standing.include(box.low);
    standing.include(box.high);
  }
  if (auto ok = check_sight(laser, standing, start); !ok) return pass_on(ok);
  Box2 whole = standing;
  whole.include(start);
  auto frame = lattice(whole.grown(2.0 * ground.radius_m() + 2.0 * resolution_m), resolution_m);
  if (!frame) return pass_on(frame);
  ExplorationReference truth{Grid<std::uint8_t>(*frame, not_seeable), 0.0, 0.0, standing, false, {}};
  const Survey survey{laser, ground, truth.places};
  const auto outside = flood_ground(survey, start, standing);
  flood_sight(survey);
  add_up(truth);
  mark_behind_gaps(survey, start, room_m);
  truth.leaks = outside.has_value();
  truth.leaks_at = outside.value_or(Vec2{});
  return truth;
}

MapQuality map_quality(const ExplorationReference& truth, const RangeFinder& laser,
                       const Grid<std::uint8_t>& occupancy) {
  MapQuality quality;
  const GridFrame& places = truth.places.frame;
  Share all, before_gaps;
  for (std::size_t i = 0; i < truth.places.cells.size(); ++i) {
    const std::uint8_t place = truth.places.cells[i];
    if (place < behind_gap) continue;
    const Cell cell = occupancy.frame.cell_at(places.centre(places.cell(i)));
    const bool is_found = occupancy.contains(cell) && occupancy[cell] == free_cell;
    all.count(is_found);
    if (place != behind_gap) before_gaps.count(is_found);
  }
  quality.explored_fraction = all.value();
  quality.explored_before_gaps = before_gaps.value();
  const double cell_m2 = occupancy.frame.resolution_m * occupancy.frame.resolution_m;
  const auto near_seeable = [&](Vec2 p) {
    const Cell c = places.cell_at(p);
    for (int y = c.y - 1; y <= c.y + 1; ++y) {
      for (int x = c.x - 1; x <= c.x + 1; ++x) {
        if (truth.places.contains({x, y}) && truth.places[{x, y}] != not_seeable) return true;
      }
    }
    return false;
  };
  std::size_t walls = 0;
  for (std::size_t i = 0; i < occupancy.cells.size(); ++i) {
    const Vec2 centre = occupancy.frame.centre(occupancy.frame.cell(i));
    if (occupancy.cells[i] == free_cell) {
      quality.mapped_free_m2 += cell_m2;
      if (!near_seeable(centre)) quality.wrongly_free_m2 += cell_m2;
    } else if (occupancy.cells[i] == occupied_cell) {
      ++walls;
      quality.map_error_m += laser.surface_distance(centre, farthest_error_m);
    }
  }
  if (walls > 0) quality.map_error_m /= static_cast<double>(walls);
  return quality;
}

}  // namespace outrider
