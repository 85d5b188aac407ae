#include "outrider/navigate/live_map.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "beams.hpp"

namespace outrider {
namespace {

constexpr int weight_of_reading = 2;
constexpr int weight_of_lone = 1;
constexpr int sure_weight = 6;
constexpr double lone_s = 0.5;  // for which a lone reading waits for a second one
constexpr int most_weight = 8;
constexpr double newest_part = 0.3;   // of a reading in the mean of its mark
constexpr double beyond_cells = 1.5;  // a beam that ends so far behind a mark has passed it
constexpr double never_s = -1e9;      // when a wall was seen that was not seen yet
constexpr std::size_t most_behind = 20'000;
constexpr double one_thing_m = 0.15;  // by which the ranges of two beams that see one thing differ at most
constexpr double edge_m = 0.05;       // what is seen so near to an edge of the allowed ground is the edge
constexpr double inside_m = 0.02;     // of the rim of the robot, by which marks may be off
constexpr double stood_s = 1.0;       // what has stood in a cell so long does not move

GridFrame window(const LiveMapOptions& options, Vec2 middle) {
  const Vec2 reach{options.reach_m, options.reach_m};
  return covering({middle - reach, middle + reach}, options.resolution_m);
}

}  // namespace

std::vector<Option> describe(LiveMapOptions& options) {
  return {
      {"resolution", "m", 0.01, 0.5, "side of a cell of the live map", &options.resolution_m},
      {"reach", "m", 1.0, 30.0, "half the side of the live map, which moves with the robot",
       &options.reach_m},
      {"forget", "s", 0.1, 1e6, "time after which what is out of sight is forgotten", &options.forget_s},
      {"touch", "s", 0.1, 1e6, "time after which what was touched is forgotten", &options.touch_s},
      {"remember", "s", 0.0, 1e6, "time for which ways on a known map go around what was seen far from here",
       &options.remember_s},
  };
}

LiveMap::LiveMap(const LiveMapOptions& options, Vec2 middle)
    : options_(options), cells_(window(options, middle)) {}

std::vector<Vec2> LiveMap::places() const {
  std::vector<Vec2> places;
  places.reserve(marks_.size());
  for (const Mark& mark : marks_) {
    if (mark.stands()) places.push_back(mark.place);
  }
  std::ranges::copy_if(edges_, std::back_inserter(places),
                       [&](Vec2 place) { return frame().contains(frame().cell_at(place)); });
  return places;
}

std::vector<Vec2> LiveMap::close_places() const {
  std::vector<Vec2> places = surfaces_;
  for (const Mark& mark : marks_) {
    const bool known_better = distance(mark.place, looked_from_) < looked_m_;
    if (mark.stands() && !known_better) places.push_back(mark.place);
  }
  return places;
}

void LiveMap::look_close(std::vector<Vec2> surfaces, Vec2 from, double reach_m) {
  looked_m_ = surfaces.empty() ? 0.0 : reach_m;
  looked_from_ = from;
  surfaces_ = std::move(surfaces);
}

void LiveMap::limit(const AllowedGround& ground) {
  allowed_ = ground;
  edges_ = ground.edge_points(0.5 * options_.resolution_m);
  ++changes_;
}

void LiveMap::set_moving(const std::vector<RoundedPolygon>& disks) {
  for (Mark& mark : marks_) {
    const bool fresh = !mark.mapped && !mark.touched && mark.seen_s - mark.first_s < stood_s;
    mark.moving = fresh && std::ranges::any_of(disks, [&](const RoundedPolygon& disk) {
                    return signed_distance(mark.place, disk) <= 0.0;
                  });
  }
}

void LiveMap::know(Walls walls) {
  erase_marks([](const Mark& mark) { return mark.mapped; });
  walls_ = std::move(walls);
  mark_walls(nullptr);
}

/// Marks the walls in the window, but for those in the frame that it had before.
void LiveMap::mark_walls(const GridFrame* known) {
  if (walls_ == nullptr) return;
  for (const Vec2 place : *walls_) {
    const Cell cell = frame().cell_at(place);
    if (!cells_.contains(cell) || cells_[cell] != 0) continue;
    if (known != nullptr && known->contains(known->cell_at(place))) continue;
    marks_.push_back({place, never_s, never_s, most_weight, false, true, false, false, true});
    cells_[cell] = static_cast<std::uint32_t>(marks_.size());
    ++changes_;
  }
}

void LiveMap::leave_behind(const Mark& mark) {
  if (mark.weight < most_weight || mark.mapped || mark.touched) return;
  if (behind_.size() == most_behind) behind_.erase(behind_.begin(), behind_.begin() + most_behind / 2);
  behind_.push_back(mark);
}

template <class Gone>
void LiveMap::erase_marks(Gone gone) {
  std::size_t kept = 0;
  for (const Mark& mark : marks_) {
    const Cell cell = cells_.frame.cell_at(mark.place);
    const bool inside = cells_.contains(cell);
    if (!inside || gone(mark)) {
      if (inside) cells_[cell] = 0;
      if (!inside) leave_behind(mark);
      changes_ += mark.lone ? 0 : 1;
      continue;
    }
    marks_[kept++] = mark;
    cells_[cell] = static_cast<std::uint32_t>(kept);
  }
  marks_.resize(kept);
}

/// Moves the window by so much, in whole cells.
void LiveMap::move_window(Vec2 off) {
  const double cell_m = options_.resolution_m;
  cells_.frame.origin =
      frame().origin + cell_m * Vec2{std::round(off.x / cell_m), std::round(off.y / cell_m)};
}

void LiveMap::follow(Vec2 robot) {
  const Vec2 middle = 0.5 * (frame().bounds().low + frame().bounds().high);
  const Vec2 off = robot - middle;
  if (std::max(std::abs(off.x), std::abs(off.y)) < 0.25 * options_.reach_m) return;
  const GridFrame before = frame();
  move_window(off);
  std::ranges::fill(cells_.cells, 0U);
  erase_marks([](const Mark&) { return false; });
  mark_walls(&before);
}

void LiveMap::correct(const Pose2& correction) {
  const Vec2 middle = 0.5 * (frame().bounds().low + frame().bounds().high);
  move_window(correction * middle - middle);
  const std::vector<Mark> before = std::exchange(marks_, {});
  std::ranges::fill(cells_.cells, 0U);
  for (const Mark& known : before) {
    const Vec2 place = known.mapped ? known.place : correction * known.place;
    const Cell cell = frame().cell_at(place);
    if (!cells_.contains(cell) || cells_[cell] != 0) continue;
    marks_.push_back(known);
    marks_.back().place = place;
    cells_[cell] = static_cast<std::uint32_t>(marks_.size());
  }
  ++changes_;
}

void LiveMap::mark(Vec2 place, double time_s, int weight, bool touched) {
  const Cell cell = frame().cell_at(place);
  if (!cells_.contains(cell)) return;
  std::uint32_t& number = cells_[cell];
  if (number == 0) {
    const bool mapped = !touched && take_wall_beside(cell);
    marks_.push_back(
        {place, time_s, mapped ? never_s : time_s, mapped ? most_weight : weight, touched, mapped});
    marks_.back().sure = marks_.back().weight >= sure_weight;
    number = static_cast<std::uint32_t>(marks_.size());
    ++changes_;
    return;
  }
  Mark& known = marks_[number - 1];
  if (known.seen_s == never_s) known.place = place;
  // The mean of places in one cell is in that cell.
  if (!known.touched) known.place = (1.0 - newest_part) * known.place + newest_part * place;
  known.weight = std::min(known.weight + weight, most_weight);
  known.seen_s = time_s;
  known.touched |= touched;
  known.sure |= known.weight >= sure_weight;
  confirm(known);
}

/// Notes a reading that no other of its scan confirms; a lone one of a scan before it may.
void LiveMap::mark_lone(Vec2 place, double time_s) {
  const Cell cell = frame().cell_at(place);
  if (!cells_.contains(cell)) return;
  bool is_confirmed = cells_[cell] != 0 && !marks_[cells_[cell] - 1].lone;
  for_each_beside(cell, [&](Mark& beside) {
    if (!beside.lone || beside.seen_s >= time_s) return;
    is_confirmed = true;
    confirm(beside);
  });
  if (is_confirmed) {
    mark(place, time_s, weight_of_reading, false);
    return;
  }
  if (cells_[cell] != 0) return;
  marks_.push_back({place, time_s, time_s, weight_of_lone, false, false, false, true});
  cells_[cell] = static_cast<std::uint32_t>(marks_.size());
}

void LiveMap::confirm(Mark& mark) {
  changes_ += mark.lone ? 1 : 0;
  mark.lone = false;
}

/// Calls visit(mark) for the marks in a cell and in those beside it.
template <class Visit>
void LiveMap::for_each_beside(Cell cell, Visit visit) {
  for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
    for (int x = cell.x - 1; x <= cell.x + 1; ++x) {
      if (cells_.contains({x, y}) && cells_[{x, y}] != 0) visit(marks_[cells_[{x, y}] - 1]);
    }
  }
}

/// Returns true if walls beside a cell have not been seen yet: what is seen there are they. They go at the
/// end of the scan.
bool LiveMap::take_wall_beside(Cell cell) {
  bool any = false;
  for_each_beside(cell, [&](Mark& beside) {
    if (!beside.mapped || beside.seen_s != never_s) return;
    beside.weight = 0;
    any = true;
  });
  return any;
}

void LiveMap::clear_seen_through(const LaserScan& scan, const Pose2& world_T_laser) {
  const double beyond_m = beyond_cells * options_.resolution_m;
  for (Mark& mark : marks_) {
    const Vec2 local = world_T_laser.to_local(mark.place);
    const double bearing_rad = heading_of(local);
    if (looks_at(scan, bearing_rad)) mark.looked_s = scan.time_s;
    if (mark.touched) continue;
    const double away_m = norm(local);
    if (away_m < scan.least_m || away_m + beyond_m > scan.most_m) continue;
    if (passes(scan, bearing_rad, away_m + beyond_m)) --mark.weight;
  }
  erase_marks([](const Mark& mark) { return mark.weight <= 0; });
}

void LiveMap::note(const LaserScan& scan, const Pose2& world_T_laser) {
  if (!check(scan) || !finite(world_T_laser)) return;
  clear_seen_through(scan, world_T_laser);
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double range_m = range_of(scan, beam);
    if (range_m < 0.0 || !std::isfinite(range_m)) continue;
    const double bearing_rad = scan.first_rad + static_cast<double>(beam) * scan.step_rad;
    const Vec2 place = world_T_laser * (range_m * direction(bearing_rad));
    if (allowed_ && (!allowed_->contains(place) || allowed_->to_edge_m(place) < edge_m)) continue;
    if (has_neighbour(scan, beam, one_thing_m))
      mark(place, scan.time_s, weight_of_reading, false);
    else
      mark_lone(place, scan.time_s);
  }
  erase_marks([](const Mark& mark) { return mark.weight <= 0; });
}

void LiveMap::note_touch(Vec2 place, double time_s) {
  if (finite(place)) mark(place, time_s, most_weight, true);
}

void LiveMap::keep_open(const Footprint& footprint, const Pose2& pose) {
  erase_marks([&](const Mark& mark) {
    return !mark.touched && distance(mark.place, pose.position) < footprint.outer_m() &&
           footprint.gap_m(pose.to_local(mark.place)) < -inside_m;
  });
}

void LiveMap::forget(double time_s) {
  erase_marks([&](const Mark& mark) {
    const double seen_for_s = mark.lone ? lone_s : options_.forget_s;
    if (mark.mapped || time_s - mark.seen_s <= (mark.touched ? options_.touch_s : seen_for_s)) return false;
    leave_behind(mark);
    return true;
  });
  std::size_t old = 0;
  while (old < behind_.size() && time_s - behind_[old].seen_s > options_.remember_s) ++old;
  behind_.erase(behind_.begin(), behind_.begin() + static_cast<std::ptrdiff_t>(old));
}

void LiveMap::forget_but(double time_s, double lately_s) {
  erase_marks([&](const Mark& mark) {
    return !mark.mapped && time_s - mark.seen_s > lately_s && time_s - mark.looked_s <= lately_s;
  });
}

}  // namespace outrider
