#include "lattice_motions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "outline_sweep.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

constexpr Vec2 centre{0.5, 0.5};
constexpr double rounding = 1e-9;

Vec2 vector_of(Cell c) { return {double(c.x), double(c.y)}; }

/// Returns the directions from a centre to others, by angle from +x: 8, 16 or 32.
std::vector<Cell> directions(std::uint32_t headings) {
  const int reach = headings == 8 ? 1 : headings == 16 ? 2 : 3;
  std::vector<Cell> all;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      if (std::gcd(x, y) == 1) all.push_back({x, y});
    }
  }
  const auto angle = [](Cell c) {
    const double turn = heading_of(vector_of(c));
    return turn < 0.0 ? turn + 2.0 * pi : turn;
  };
  std::ranges::sort(all, {}, angle);
  return all;
}

/// A turn that ends at a centre: straight, an arc that touches both lines, straight.
struct Turn {
  Cell shift;
  double before = 0.0;
  double after = 0.0;
  double radius = 0.0;
  double length = 0.0;
};

/// Returns the turn from one direction to another that ends there, if it is not tighter than the radius.
std::optional<Turn> turn_to(Cell shift, Vec2 from, Vec2 to, double least_radius) {
  // shift = s from + t to: the lines of both directions meet s ahead of the start and t before the end.
  const double across = cross(from, to);
  const double s = cross(vector_of(shift), to) / across, t = cross(from, vector_of(shift)) / across;
  const double angle = std::abs(std::atan2(across, dot(from, to))), tangent = std::min(s, t);
  if (!(tangent > rounding)) return std::nullopt;
  const double radius = tangent / std::tan(0.5 * angle);
  if (radius < least_radius * (1.0 - rounding)) return std::nullopt;
  return Turn{shift, s - tangent, t - tangent, radius, s + t - 2.0 * tangent + radius * angle};
}

}  // namespace

double LatticeMotions::heading_rad(std::uint32_t heading) const {
  return heading_of(vector_of(ahead_[heading]));
}

std::uint32_t LatticeMotions::nearest_heading(double heading_rad_asked) const {
  std::uint32_t best = 0;
  const auto off = [&](std::uint32_t heading) {
    return std::abs(wrap_angle(heading_rad(heading) - heading_rad_asked));
  };
  for (std::uint32_t heading = 1; heading < headings(); ++heading) {
    if (off(heading) < off(best)) best = heading;
  }
  return best;
}

void LatticeMotions::make(const LatticeForm& form) {
  if (form == form_ && !from_.empty()) return;
  form_ = form;
  ahead_ = directions(form.headings);
  from_.assign(form.headings, {});
  for (std::uint32_t heading = 0; heading < form.headings; ++heading) add_forwards(heading);
  if (form.reverse) add_backwards();
}

void LatticeMotions::add_forwards(std::uint32_t heading) {
  const Cell ahead = ahead_[heading];
  add(heading, heading, ahead, {{centre, centre + vector_of(ahead), {}, 0.0}});
  for (std::uint32_t step = 1; step <= form_.headings / 4; ++step) {
    add_turns(heading, (heading + step) % form_.headings);
    add_turns(heading, (heading + form_.headings - step) % form_.headings);
  }
}

void LatticeMotions::add_turns(std::uint32_t heading, std::uint32_t to) {
  const Vec2 out = direction(heading_rad(heading)), in = direction(heading_rad(to));
  const double angle = std::abs(std::atan2(cross(out, in), dot(out, in)));
  // A turn of the least radius from any centre has a longer form that ends at one within a few cells.
  const int reach = static_cast<int>(std::ceil(2.0 * form_.radius * std::tan(0.5 * angle))) + 4;
  std::vector<Turn> turns;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const auto turn = turn_to({x, y}, out, in, form_.radius);
      if (!turn) continue;
      const Cell a = ahead_[heading], b = ahead_[to];
      const bool longer_form = turn_to({x - a.x, y - a.y}, out, in, form_.radius).has_value() ||
                               turn_to({x - b.x, y - b.y}, out, in, form_.radius).has_value();
      if (!longer_form) turns.push_back(*turn);
    }
  }
  std::ranges::stable_sort(turns, {}, &Turn::length);
  turns.resize(std::min<std::size_t>(turns.size(), form_.turns));
  for (const Turn& turn : turns) {
    std::vector<PathPiece> pieces;
    Vec2 at = centre;
    if (turn.before > rounding) pieces.push_back({at, at + turn.before * out, {}, 0.0});
    at = at + turn.before * out;
    const double side = cross(out, in) > 0.0 ? 1.0 : -1.0;
    const Vec2 middle = at + side * turn.radius * perpendicular(out);
    const Vec2 end = centre + vector_of(turn.shift) - turn.after * in;
    pieces.push_back({at, end, middle, side * angle});
    if (turn.after > rounding) pieces.push_back({end, centre + vector_of(turn.shift), {}, 0.0});
    add(heading, to, turn.shift, std::move(pieces));
  }
}

void LatticeMotions::add(std::uint32_t heading, std::uint32_t to, Cell shift, std::vector<PathPiece> pieces) {
  LatticeMotion motion{std::move(pieces), shift, to, false, 0.0, {}, {}, {}};
  for (const PathPiece& piece : motion.pieces) motion.cost += length_of(piece);
  set_touched(motion, heading_rad(heading));
  from_[heading].push_back(std::move(motion));
}

void LatticeMotions::add_backwards() {
  std::vector<std::vector<LatticeMotion>> backwards(form_.headings);
  for (std::uint32_t heading = 0; heading < form_.headings; ++heading) {
    for (const LatticeMotion& motion : from_[heading]) {
      LatticeMotion back = motion;
      back.pieces.clear();
      for (auto piece = motion.pieces.rbegin(); piece != motion.pieces.rend(); ++piece) {
        PathPiece turned = reversed(*piece);
        for (Vec2* p : {&turned.from, &turned.to, &turned.centre}) *p = *p - vector_of(motion.shift);
        turned.backward = true;
        back.pieces.push_back(turned);
      }
      back.shift = {-motion.shift.x, -motion.shift.y};
      back.heading = heading;
      back.backward = true;
      back.cost = form_.backward * motion.cost;
      set_touched(back, heading_rad(motion.heading));
      backwards[motion.heading].push_back(std::move(back));
    }
  }
  for (std::uint32_t heading = 0; heading < form_.headings; ++heading) {
    std::ranges::move(backwards[heading], std::back_inserter(from_[heading]));
  }
}

void LatticeMotions::set_touched(LatticeMotion& motion, double heading) const {
  std::vector<Cell> cells;
  for (const PathPiece& piece : motion.pieces) {
    for_each_section({form_.outline, piece, heading}, [&](const OutlineSweep& section) {
      add_touched_cells(section, cells);
      return true;
    });
    heading += piece.turn_rad;
  }
  motion.low = motion.high = {};
  motion.touched.clear();
  for (const Cell c : cells) {
    motion.low = {std::min(motion.low.x, c.x), std::min(motion.low.y, c.y)};
    motion.high = {std::max(motion.high.x, c.x), std::max(motion.high.y, c.y)};
    motion.touched.push_back(c.y * static_cast<std::int32_t>(form_.stride) + c.x);
  }
  std::ranges::sort(motion.touched);
  motion.touched.erase(std::unique(motion.touched.begin(), motion.touched.end()), motion.touched.end());
}

bool LatticeMotions::clear(const GridMap& ground, const LatticeMotion& motion, Cell at) {
  if (!ground.frame.contains({at.x + motion.low.x, at.y + motion.low.y})) return false;
  if (!ground.frame.contains({at.x + motion.high.x, at.y + motion.high.y})) return false;
  const std::uint8_t* mark = ground.marks.data() + ground.index(at);
  return std::ranges::none_of(motion.touched,
                              [&](std::int32_t cell) { return (mark[cell] & GridMap::blocked_bit) != 0; });
}

}  // namespace outrider
