// Draws the growing map on the terminal while the robot explores.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "outrider/report/growth.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::cli {

/// Marks a position on the map.
struct MapSign {
  Vec2 position;
  std::string text;  ///< one character wide, colours included
};

/// Returns the known part of a map in `rows` lines of at most `columns` characters, as large as possible. A
/// character has 2 x 4 Braille dots. Each dot stands for a square block of one or more cells and is set if
/// any of them is occupied. Cells known to be free are shaded. `occupancy` holds values of Occupancy.
std::string map_lines(const Grid<std::uint8_t>& occupancy, const std::vector<MapSign>& signs, int columns,
                      int rows);

/// Redraws the map in place, at most ten times a second, with a line of figures below; the last map stays.
/// Draws nothing if standard error is not a terminal.
class LiveMap final : public RunObserver {
 public:
  LiveMap();
  ~LiveMap() override;
  LiveMap(const LiveMap&) = delete;
  LiveMap& operator=(const LiveMap&) = delete;

  bool wants() override;
  void see(const Report& so_far) override;

 private:
  void draw(const Report& report, const ReportExplore& explore);

  bool terminal_;
  bool drawn_ = false;
  int columns_ = 80;
  int rows_ = 24;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace outrider::cli
