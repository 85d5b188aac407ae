#include "hybrid_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "turning_pieces.hpp"

namespace outrider {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void HybridMotions::begin(const SteeringQuery& query, double base_rad, std::uint32_t headings,
                          double least_length) {
  query_ = &query;
  base_rad_ = base_rad;
  headings_ = headings;
  step_rad_ = 2.0 * pi / headings;
  const double steps = std::ceil(least_length / (query.radius * step_rad_));
  turn_ = static_cast<std::uint32_t>(std::clamp(steps, 1.0, std::max(1.0, headings / 4.0)));
  first_.assign(headings, none);
  motions_.clear();
  parts_.clear();
}

void HybridMotions::add(std::uint32_t heading, const TurningPiece& piece) {
  const Pose2 origin{{}, heading_rad(heading)};
  const PathPiece way = piece_of(origin, piece, query_->radius);
  const bool left = piece.side * piece.length_m > 0.0;
  const std::uint32_t turned = piece.side == 0 ? 0 : left ? turn_ : headings_ - turn_;
  HybridMotion motion{piece,
                      way.to,
                      (heading + turned) % headings_,
                      query_->price_of(piece.length_m),
                      static_cast<std::uint32_t>(parts_.size()),
                      0,
                      way,
                      origin.heading_rad};
  add_border_parts({query_->outline, way, origin.heading_rad}, parts_);
  motion.parts = static_cast<std::uint32_t>(parts_.size()) - motion.first_part;
  motions_.push_back(motion);
}

std::span<const HybridMotion> HybridMotions::from(std::uint32_t heading) {
  const std::uint32_t count = query_->reverse ? most : most / 2;
  if (first_[heading] == none) {
    first_[heading] = static_cast<std::uint32_t>(motions_.size());
    const double length = query_->radius * turn_ * step_rad_;
    for (const double ahead : {1.0, -1.0}) {
      if (ahead < 0.0 && !query_->reverse) continue;
      for (const int side : {0, 1, -1}) add(heading, {side, ahead * length});
    }
  }
  return {motions_.data() + first_[heading], count};
}

bool HybridMotions::clear(const HybridMotion& motion, Vec2 p) const {
  if (query_->room->is_wide(p, std::abs(motion.piece.length_m))) return true;
  if (query_->room->is_blocked(p + motion.shift)) return false;
  return clear_of_cells(*query_->ground, {query_->outline, motion.way, motion.heading_rad},
                        std::span(parts_).subspan(motion.first_part, motion.parts), p);
}

}  // namespace outrider
