// Draws the growing map on the terminal while the robot explores.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "outrider/job/log_map.hpp"
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
class LiveMap final : public LogSink {
 public:
  LiveMap();
  ~LiveMap() override;
  LiveMap(const LiveMap&) = delete;
  LiveMap& operator=(const LiveMap&) = delete;

  void begin(const Log& log) override { log_ = &log; }
  void add_channel(const Channel&) override {}
  void append(std::size_t channel, std::int64_t time_ns, std::string_view data) override;
  /// Draws the map a last time.
  void finish(const Log& log);

 private:
  void draw();

  bool terminal_;
  bool drawn_ = false;
  int columns_ = 80;
  int rows_ = 24;
  const Log* log_ = nullptr;
  LogMap map_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace outrider::cli
