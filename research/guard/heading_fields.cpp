#include "research/guard/heading_fields.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "outrider/motion/profile.hpp"

namespace outrider {
namespace {

constexpr int rim = ConeFields::rim;
constexpr int margin = 3 * rim;  // round the yard: the tiles that overlap it, and what their windows need

/// Lowers `count` values to value(0), value(1), ...; true if one was lowered.
template <class Value>
bool lower(Units* values, int count, const Value& value) {
  int changed = 0;
  for (int i = 0; i < count; ++i) {
    const Units least = std::min(values[i], static_cast<Units>(value(i)));
    changed |= values[i] ^ least;
    values[i] = least;
  }
  return changed != 0;
}

/// Lowers the values of a row of tiles to those one step ahead and the time to get there; true if one was
/// lowered. For a step within the row, the tiles ahead come first.
bool drive_row(Units* row, std::ptrdiff_t step, const Units* across, int count) {
  const Units* ahead = row + step;
  if (std::abs(step) > 1) return lower(row, count, [&](int i) { return ahead[i] + across[i]; });
  bool lowered = false;
  for (int k = 0; k < count; ++k) {
    const int i = step > 0 ? count - 1 - k : k;
    const auto time = static_cast<Units>(ahead[i] + across[i]);
    lowered |= time < row[i];
    row[i] = std::min(row[i], time);
  }
  return lowered;
}

GridFrame refined(const GridFrame& frame, int fine) {
  GridFrame finer;
  finer.resolution_m = frame.resolution_m / fine;
  finer.width = frame.width * fine + 2 * margin;
  finer.height = frame.height * fine + 2 * margin;
  finer.origin = frame.origin - margin * finer.resolution_m * Vec2{1.0, 1.0};
  return finer;
}

/// For each cell of the refined grid: 0 where holds(cell of `frame`), else `never_units`.
template <class Holds>
std::vector<Units> refined_mask(const GridFrame& frame, const GridFrame& finer, int fine,
                                const Holds& holds) {
  std::vector<Units> mask(finer.size(), never_units);
  for (int y = 0; y < frame.height * fine; ++y) {
    for (int x = 0; x < frame.width * fine; ++x) {
      if (holds(frame.index({x / fine, y / fine}))) mask[finer.index({x + margin, y + margin})] = 0;
    }
  }
  return mask;
}

/// Notes for each row of a window, and of the rim around it, if something in the row has changed.
class Rows {
 public:
  Rows(const GridWindow& window, bool value) : rows_(at(window.rows + rim), value ? 1 : 0) {}

  [[nodiscard]] bool operator[](int row) const { return rows_[at(row)] != 0; }
  void set(int row) { rows_[at(row)] = 1; }
  [[nodiscard]] bool any() const { return std::find(rows_.begin(), rows_.end(), 1) != rows_.end(); }

 private:
  /// The first row of the rim is -rim.
  static std::size_t at(int row) { return static_cast<std::size_t>(row) + rim; }

  std::vector<std::uint8_t> rows_;
};

}  // namespace

ConeFields::ConeFields(const GridWindow& window, std::size_t cones, Units value)
    : window_(window), stride_(window.columns + 2 * rim) {
  values_.assign(at(cones, -rim) - static_cast<std::size_t>(rim), never_units);
  for (std::size_t cone = 0; cone < cones; ++cone) {
    for (int y = 0; y < window.rows; ++y) std::fill_n(row(cone, y), window.columns, value);
  }
}

HeadingFields::HeadingFields(const GuardProblem& problem, const FiringMap& firing_map, int fine)
    : cones_(heading_cones()),
      coarse_(firing_map.frame),
      frame_(refined(firing_map.frame, fine)),
      fine_(fine) {
  const RobotModel& robot = problem.robot;
  unit_s_ = frame_.resolution_m / heading_scale() / robot.speed_mps;
  halt_ = units((std::numbers::sqrt2 - 0.5) * robot.speed_mps / robot.acceleration_mps2);
  shuffle_ = units(std::sqrt(8.0) * frame_.resolution_m / robot.speed_mps);
  // A point of a cell of the firing map may be free if the centre is clear of all but half the diagonal.
  const double least = robot.radius_m - std::sqrt(0.5) * coarse_.resolution_m - 1e-6;
  wall_ = refined_mask(coarse_, frame_, fine,
                       [&](std::size_t cell) { return firing_map.clearance_m[cell] >= least; });
  for (const HeadingCone& cone : cones_) {
    first_turn_.push_back(units(duration(cone.angle_to(problem.start.heading_rad), robot.turning())));
    for (const HeadingCone& other : cones_) {
      turn_.push_back(units(duration(cone.angle_to(other), robot.turning())));
    }
    across_p_.push_back(crossing(cone.p));
    across_q_.push_back(crossing(cone.q));
  }
  const Cell start = frame_.cell_at(problem.start.position);
  start_ = {std::clamp(start.x, margin, frame_.width - margin - 1),
            std::clamp(start.y, margin, frame_.height - margin - 1)};
}

/// A time from below.
Units HeadingFields::units(double time_s) const {
  return static_cast<Units>(std::min<double>(never_units, std::max(0.0, time_s / unit_s_ - 1e-9)));
}

/// Returns for each tile the time to the next one across a side, or `never_units` where no point of the side
/// may be free.
std::vector<Units> HeadingFields::crossing(const TileExit& exit) const {
  std::vector<Units> across(frame_.size(), never_units);
  for (int y = rim; y < frame_.height - rim; ++y) {
    for (int x = rim; x < frame_.width - rim; ++x) {
      const bool open = std::any_of(exit.cells.begin(), exit.cells.end(), [&](Cell cell) {
        return wall_[frame_.index({x + cell.x, y + cell.y})] == 0;
      });
      if (open) across[frame_.index({x, y})] = exit.weight;
    }
  }
  return across;
}

bool HeadingFields::useful() const {
  Units most = 0;
  for (const HeadingCone& cone : cones_) {
    for (const TileOverlap& overlap : cone.overlaps) most = std::max(most, overlap.most);
  }
  return halt_ > most;
}

GridWindow HeadingFields::around(const GridWindow& cells) const {
  if (cells.empty()) return {};
  return {{cells.low.x * fine_ + margin - rim, cells.low.y * fine_ + margin - rim},
          cells.columns * fine_ + 2 * rim,
          cells.rows * fine_ + 2 * rim};
}

double HeadingFields::size(const GridWindow& window) const {
  return 2.0 * static_cast<double>(cones_.size()) * window.columns * window.rows;
}

HeadingValues HeadingFields::constant(const GridWindow& window, Units value) const {
  const ConeFields fields(window, cones_.size(), value);
  return {fields, fields};
}

std::vector<Units> HeadingFields::mask(const FiringRegion& region) const {
  return refined_mask(coarse_, frame_, fine_,
                      [&](std::size_t cell) { return region.pitch[cell] != FiringRegion::no_shot; });
}

/// Finds for each cell of a row the least value at rest of the cells around it and of itself; `never_units`
/// in a wall.
void HeadingFields::nearby(const ConeFields& resting, std::size_t cone, int row,
                           std::vector<Units>& least) const {
  const int columns = resting.window().columns;
  const Units* here = resting.row(cone, row);
  const Units* below = here + resting.offset({0, -1});
  const Units* above = here + resting.offset({0, 1});
  const Units* wall = this->row(wall_, resting.window(), row);
  const auto count = static_cast<std::size_t>(columns);
  least.resize(count + 2);  // first the least of three rows, from one column before
  for (int i = -1; i <= columns; ++i) {
    least[static_cast<std::size_t>(i) + 1] = std::min({here[i], below[i], above[i]});
  }
  for (std::size_t i = 0; i < count; ++i) {
    least[i] = std::max(std::min({least[i], least[i + 1], least[i + 2]}), wall[i]);
  }
}

void HeadingFields::hit(const std::vector<Units>& mask, const HeadingValues& after,
                        HeadingValues& values) const {
  const GridWindow& from = after.moving.window();
  const GridWindow& to = values.moving.window();
  const Cell low{std::max(from.low.x, to.low.x), std::max(from.low.y, to.low.y)};
  const int columns = std::min(from.low.x + from.columns, to.low.x + to.columns) - low.x;
  const int end = std::min(from.low.y + from.rows, to.low.y + to.rows);
  std::vector<Units> rest, tile(static_cast<std::size_t>(std::max(0, columns)));
  for (std::size_t c = 0; c < cones_.size(); ++c) {
    for (int y = low.y; y < end; ++y) {
      const Units* region = mask.data() + frame_.index({low.x, y});
      nearby(after.resting, c, y - from.low.y, rest);
      const Units* near = rest.data() + (low.x - from.low.x);
      lower(values.resting.row(c, y - to.low.y) + (low.x - to.low.x), columns,
            [&](int i) { return std::max(near[i], region[i]); });
      std::fill(tile.begin(), tile.end(), never_units);
      for (const TileOverlap& overlap : cones_[c].overlaps) {
        const Units* there = region + std::ptrdiff_t{frame_.width} * overlap.cell.y + overlap.cell.x;
        lower(tile.data(), columns, [&](int i) { return there[i]; });
      }
      const Units* then = after.moving.row(c, y - from.low.y) + (low.x - from.low.x);
      lower(values.moving.row(c, y - to.low.y) + (low.x - to.low.x), columns,
            [&](int i) { return std::max(then[i], tile[static_cast<std::size_t>(i)]); });
    }
  }
}

/// Lowers values by drives, halts and turns in turn, where something has changed.
class HeadingFields::Settling {
 public:
  Settling(const HeadingFields& fields, HeadingValues& values)
      : fields_(fields),
        cones_(fields.cones_),
        moving_(values.moving),
        resting_(values.resting),
        window_(moving_.window()),
        columns_(window_.columns),
        rows_(window_.rows),
        arrived_(window_, fields.cones_.size(), never_units) {}

  void run() {
    std::vector<Rows> moved(cones_.size(), Rows(window_, true));
    bool at_first = true;
    for (bool again = true; again; at_first = false) {
      std::vector<Rows> changed(cones_.size(), Rows(window_, false));
      for (std::size_t c = 0; c < cones_.size(); ++c) {
        drive(c, moved[c]);
        Rows rested(window_, at_first);
        depart(c, moved[c], rested);
        shuffle(c, rested);
        turn(c, rested, changed);
      }
      again = false;
      for (std::size_t c = 0; c < cones_.size(); ++c) {
        moved[c] = arrive(c, changed[c]);
        again |= moved[c].any();
      }
    }
  }

 private:
  /// Straight drives. Rows are taken in the order in which the cone leads to them, the farthest first.
  void drive(std::size_t c, Rows& moved) {
    const TileExit& p = cones_[c].p;
    const TileExit& q = cones_[c].q;
    const bool up = p.step.y + q.step.y > 0;
    for (int k = 0; k < rows_; ++k) {
      const int y = up ? rows_ - 1 - k : k;
      if (!moved[y] && !moved[y + p.step.y] && !moved[y + q.step.y]) continue;
      const auto along = [&](const TileExit& exit, const std::vector<Units>& across) {
        return drive_row(moving_.row(c, y), moving_.offset(exit.step), row_of(across, y), columns_);
      };
      const bool p_within = p.step.y == 0;  // a step within the row comes last
      const bool one = p_within ? along(q, fields_.across_q_[c]) : along(p, fields_.across_p_[c]);
      const bool other = p_within ? along(p, fields_.across_p_[c]) : along(q, fields_.across_q_[c]);
      if (one || other) moved.set(y);
    }
  }

  /// From rest, a straight drive begins.
  void depart(std::size_t c, const Rows& moved, Rows& rested) {
    for (int y = 0; y < rows_; ++y) {
      const Units* wall = row_of(fields_.wall_, y);
      for (const TileOverlap& overlap : cones_[c].overlaps) {
        if (!moved[y - overlap.cell.y]) continue;
        const Units* tile = moving_.row(c, y) - moving_.offset(overlap.cell);
        const auto time = static_cast<Units>(fields_.halt_ - overlap.most);
        const bool lowered = lower(resting_.row(c, y), columns_, [&](int i) {
          return std::max(static_cast<Units>(tile[i] + time), wall[i]);
        });
        if (lowered) rested.set(y);
      }
    }
  }

  /// Short drives from cell to neighbouring cell, until they lower nothing more.
  void shuffle(std::size_t c, Rows& rested) {
    Rows active = rested;
    while (active.any()) {
      Rows lowered(window_, false);
      for (int y = 0; y < rows_; ++y) {
        if (!active[y - 1] && !active[y] && !active[y + 1] && !lowered[y - 1]) continue;
        fields_.nearby(resting_, c, y, near_);
        if (!lower(resting_.row(c, y), columns_, [&](int i) { return near(i) + fields_.shuffle_; })) continue;
        rested.set(y);
        lowered.set(y);
      }
      active = lowered;
    }
  }

  /// At the end of a drive of any cone, a turn to the cone of the next one.
  void turn(std::size_t c, const Rows& rested, std::vector<Rows>& changed) {
    for (int y = 0; y < rows_; ++y) {
      if (!rested[y - 1] && !rested[y] && !rested[y + 1]) continue;
      fields_.nearby(resting_, c, y, near_);
      for (std::size_t before = 0; before < cones_.size(); ++before) {
        const Units time = fields_.turn_[before * cones_.size() + c];
        if (lower(arrived_.row(before, y), columns_, [&](int i) { return near(i) + time; })) {
          changed[before].set(y);
        }
      }
    }
  }

  /// A straight drive ends; returns the rows that were lowered.
  Rows arrive(std::size_t c, const Rows& changed) {
    Rows moved(window_, false);
    for (int y = 0; y < rows_; ++y) {
      for (const TileOverlap& overlap : cones_[c].overlaps) {
        if (!changed[y + overlap.cell.y]) continue;
        const Units* end = arrived_.row(c, y) + arrived_.offset(overlap.cell);
        if (lower(moving_.row(c, y), columns_, [&](int i) { return end[i] + overlap.least; })) moved.set(y);
      }
    }
    return moved;
  }

  [[nodiscard]] const Units* row_of(const std::vector<Units>& field, int y) const {
    return fields_.row(field, window_, y);
  }
  [[nodiscard]] Units near(int column) const { return near_[static_cast<std::size_t>(column)]; }

  const HeadingFields& fields_;
  const std::vector<HeadingCone>& cones_;
  ConeFields& moving_;
  ConeFields& resting_;
  GridWindow window_;
  int columns_ = 0, rows_ = 0;
  ConeFields arrived_;  // by cell, of a robot at rest whose last straight drive had a heading of the cone
  std::vector<Units> near_;
};

void HeadingFields::settle(HeadingValues& values) const { Settling(*this, values).run(); }

Units HeadingFields::at_start(const HeadingValues& values) const {
  const GridWindow& window = values.resting.window();
  const Cell at{start_.x - window.low.x, start_.y - window.low.y};
  if (at.x < 0 || at.y < 0 || at.x >= window.columns || at.y >= window.rows) return never_units;
  Units least = never_units;
  std::vector<Units> near;
  for (std::size_t c = 0; c < cones_.size(); ++c) {
    nearby(values.resting, c, at.y, near);
    least = std::min(least, static_cast<Units>(near[static_cast<std::size_t>(at.x)] + first_turn_[c]));
  }
  return least;
}

}  // namespace outrider
