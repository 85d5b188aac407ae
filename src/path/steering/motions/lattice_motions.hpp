// The motions of a state lattice, generated from straight lines and arcs. In cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "steering/steering_query.hpp"

namespace outrider {

/// A motion from the centre of the cell (0, 0).
struct LatticeMotion {
  std::vector<PathPiece> pieces;  ///< an arc and a straight piece, or one of them
  Cell shift;                     ///< of the cell
  std::uint32_t heading = 0;      ///< after it
  bool backward = false;
  double cost = 0.0;                  ///< without a cusp
  Cell low, high;                     ///< corners of the box of the cells that it touches
  std::vector<std::int32_t> touched;  ///< those cells, as differences of GridMap::index()
};

/// The parameters that determine the motions.
struct LatticeForm {
  std::uint32_t headings = 16;
  std::uint32_t turns = 2;
  double radius = 0.0;
  bool reverse = false;
  double backward = 1.0;
  std::vector<Vec2> outline;  ///< as in SteeringQuery
  std::uint32_t stride = 0;   ///< of the grid
  friend bool operator==(const LatticeForm&, const LatticeForm&) = default;
};

class LatticeMotions {
 public:
  static constexpr double most_radius = 200.0;

  /// Makes the motions, unless they are those of the form already.
  void make(const LatticeForm& form);

  [[nodiscard]] std::uint32_t headings() const { return form_.headings; }
  [[nodiscard]] double heading_rad(std::uint32_t heading) const;
  [[nodiscard]] std::uint32_t nearest_heading(double heading_rad) const;
  [[nodiscard]] const std::vector<LatticeMotion>& from(std::uint32_t heading) const { return from_[heading]; }
  /// Returns true if the robot touches no blocked cell on the motion from the centre of that cell.
  [[nodiscard]] static bool clear(const GridMap& ground, const LatticeMotion& motion, Cell at);

 private:
  void add_forwards(std::uint32_t heading);
  void add_turns(std::uint32_t heading, std::uint32_t to);
  void add(std::uint32_t heading, std::uint32_t to, Cell shift, std::vector<PathPiece> pieces);
  void add_backwards();
  void set_touched(LatticeMotion& motion, double heading_rad) const;

  LatticeForm form_;
  std::vector<Cell> ahead_;  ///< by heading: the next centre ahead
  std::vector<std::vector<LatticeMotion>> from_;
};

}  // namespace outrider
