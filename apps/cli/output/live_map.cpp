#include "output/live_map.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/world/known_extent.hpp"

namespace outrider::cli {
namespace {

constexpr int dots_across = 2, dots_up = 4;  // in a Braille character
constexpr auto map_period = std::chrono::milliseconds(100);

/// Returns the state of a square of cells: occupied if any cell is, else free if any cell is, else unknown.
Occupancy state_of(const Grid<std::uint8_t>& occupancy, Cell low, int side) {
  Occupancy state = unknown_cell;
  for (int y = low.y; y < low.y + side; ++y) {
    for (int x = low.x; x < low.x + side; ++x) {
      if (!occupancy.contains({x, y})) continue;
      const std::uint8_t cell = occupancy[{x, y}];
      if (cell == occupied_cell) return occupied_cell;
      if (cell == free_cell) state = free_cell;
    }
  }
  return state;
}

std::string utf8(unsigned code) {
  return {static_cast<char>(0xe0U | (code >> 12U)), static_cast<char>(0x80U | ((code >> 6U) & 0x3fU)),
          static_cast<char>(0x80U | (code & 0x3fU))};
}

/// Returns the Braille character whose dots show the squares starting at `top_left`.
std::string braille(const Grid<std::uint8_t>& occupancy, Cell top_left, int side) {
  static constexpr std::array<std::array<unsigned, dots_across>, dots_up> bits = {
      {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
  unsigned dots = 0;
  bool is_free = false;
  for (std::size_t row = 0; row < bits.size(); ++row) {
    for (std::size_t column = 0; column < bits[row].size(); ++column) {
      const Cell low{top_left.x + side * static_cast<int>(column), top_left.y - side * static_cast<int>(row)};
      const Occupancy state = state_of(occupancy, low, side);
      if (state == occupied_cell) dots |= bits[row][column];
      is_free = is_free || state == free_cell;
    }
  }
  const std::string text = dots == 0 ? " " : utf8(0x2800U + dots);
  return is_free ? "\x1b[48;5;238m" + text + "\x1b[0m" : text;
}

}  // namespace

std::string map_lines(const Grid<std::uint8_t>& occupancy, const std::vector<MapSign>& signs, int columns,
                      int rows) {
  const CellExtent part = known_extent(occupancy);
  int side = 1;
  while (part.width() > side * dots_across * columns || part.height() > side * dots_up * rows) {
    ++side;
  }
  const auto sign_at = [&](Cell low, Cell high) -> const MapSign* {
    const MapSign* found = nullptr;  // the last one is on top
    for (const MapSign& sign : signs) {
      const Cell cell = occupancy.frame.cell_at(sign.position);
      if (cell.x >= low.x && cell.y >= low.y && cell.x < high.x && cell.y < high.y) found = &sign;
    }
    return found;
  };
  std::string text;
  for (int row = 0; row < rows; ++row) {
    const int top = part.high.y + 1 - row * dots_up * side;
    for (int column = 0; column < columns && top > part.low.y; ++column) {
      const int left = part.low.x + column * dots_across * side;
      if (left > part.high.x) break;
      const MapSign* const sign = sign_at({left, top - dots_up * side}, {left + dots_across * side, top});
      text += sign != nullptr ? sign->text : braille(occupancy, {left, top - side}, side);
    }
    text += "\x1b[K\n";
  }
  return text;
}

LiveMap::LiveMap() : terminal_(::isatty(STDERR_FILENO) == 1) {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return;
  columns_ = std::clamp<int>(size.ws_col - 1, 20, 200);
  rows_ = std::clamp<int>(size.ws_row - 3, 8, 80);
}

LiveMap::~LiveMap() {
  if (drawn_) fmt::print(stderr, "\n");
}

void LiveMap::append(std::size_t, std::int64_t, std::string_view) {
  if (!terminal_ || std::chrono::steady_clock::now() < next_) return;
  next_ = std::chrono::steady_clock::now() + map_period;
  draw();
}

void LiveMap::finish(const Log& log) {
  log_ = &log;
  if (terminal_) draw();
  log_ = nullptr;
}

void LiveMap::draw() {
  map_.read(*log_);
  const Grid<std::uint8_t>& occupancy = map_.grid();
  if (occupancy.cells.empty()) return;
  std::vector<MapSign> signs;
  const auto& poses = log_->messages<geometry_msgs::PoseStamped>(topic::pose);
  if (!poses.empty()) signs.push_back({pose_of(poses.front().message.pose).position, "\x1b[1;32m⌂\x1b[0m"});
  if (const auto* goal = log_->latest<geometry_msgs::PoseStamped>(topic::goal))
    signs.push_back({pose_of(goal->pose).position, "\x1b[1;35m×\x1b[0m"});
  if (const auto* belief = log_->latest<geometry_msgs::PoseWithCovarianceStamped>(topic::belief))
    signs.push_back({pose_of(belief->pose.pose).position, "\x1b[1;33m●\x1b[0m"});
  const double cell_m2 = occupancy.frame.resolution_m * occupancy.frame.resolution_m;
  const auto free = static_cast<double>(std::ranges::count(occupancy.cells, free_cell));
  const std::string map = map_lines(occupancy, signs, columns_, rows_);
  const auto* decision = log_->latest<outrider_msgs::Decision>(topic::decisions);
  if (drawn_) fmt::print(stderr, "\r\x1b[{}A", rows_);
  fmt::print(stderr, "{}\x1b[K{:.0f} s, {:.0f} m2 free, {} frontiers", map, log_->end_s(), cell_m2 * free,
             decision == nullptr ? 0 : decision->frontiers);
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace outrider::cli
