// The motions of hybrid A*: arcs to either side and straight pieces, forwards and backwards, as far as it
// takes to leave a cell. Prepared for each heading when it is first asked for. In cells.
#pragma once

#include <span>
#include <vector>

#include "outline_sweep.hpp"
#include "outrider/motion/turning_path.hpp"
#include "steering/steering_query.hpp"

namespace outrider {

/// A motion from one heading.
struct HybridMotion {
  TurningPiece piece;
  Vec2 shift;             ///< of the planned point
  std::uint32_t heading;  ///< after it
  double cost;            ///< without a cusp
  std::uint32_t first_part;
  std::uint32_t parts;  ///< number of parts of the border of its sweep
  PathPiece way;        ///< from the origin
  double heading_rad;   ///< before it
};

class HybridMotions {
 public:
  static constexpr std::uint32_t most = 6;  ///< motions from a heading

  /// Forgets all. Heading 0 is `base_rad`, of `headings`; a motion is at least `least_length` long.
  void begin(const SteeringQuery& query, double base_rad, std::uint32_t headings, double least_length);

  [[nodiscard]] double heading_rad(std::uint32_t heading) const { return base_rad_ + heading * step_rad_; }
  /// Headings apart by so many are joined by arcs.
  [[nodiscard]] std::uint32_t turn() const { return turn_; }
  std::span<const HybridMotion> from(std::uint32_t heading);
  /// Returns true if the robot touches no blocked cell on a motion from p.
  [[nodiscard]] bool clear(const HybridMotion& motion, Vec2 p) const;

 private:
  void add(std::uint32_t heading, const TurningPiece& piece);

  const SteeringQuery* query_ = nullptr;
  double base_rad_ = 0.0;
  double step_rad_ = 0.0;
  std::uint32_t headings_ = 0;
  std::uint32_t turn_ = 1;
  std::vector<std::uint32_t> first_;  ///< of the motions of a heading; `none` where they are not prepared
  std::vector<HybridMotion> motions_;
  std::vector<MonotonePart> parts_;
};

}  // namespace outrider
