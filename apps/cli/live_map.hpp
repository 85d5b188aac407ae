// The map as it is found, drawn on the terminal while the robot explores.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "outrider/report/growth.hpp"
#include "outrider/world/grid.hpp"

namespace outrider::cli {

/// A sign on the map.
struct MapSign {
  Vec2 position;
  std::string text;  ///< one character wide, colours included
};

/// The known part of a map in `rows` lines of at most `columns` characters, as large as it goes: a character
/// is 2 x 4 dots of Braille, a dot stands for one or more square blocks of cells and is set where one of them
/// is occupied; ground known to be free is shaded. `occupancy` holds values of Occupancy.
std::string map_lines(const Grid<std::uint8_t>& occupancy, const std::vector<MapSign>& signs, int columns,
                      int rows);

/// Draws over what it drew before, at most ten times a second, with a line of figures below; the last map
/// stays. Silent where standard error is no terminal.
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
