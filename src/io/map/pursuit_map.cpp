#include "outrider/io/map/pursuit_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

constexpr int longest_map_side = 100'000;
constexpr std::size_t most_cells = 100'000'000;
/// Up to this number of cells, the length of the text is not checked first, so a fault can name the short
/// row.
constexpr std::size_t small_size = 1'000'000;
constexpr std::size_t most_steps = 10'000'000;
constexpr std::uint32_t most_cost = 1'000'000'000;

Status expect(TextLines& lines, std::string_view letter) {
  lines.next();
  if (trimmed(lines.line) == letter) return {};
  return bad_input(
      fmt::format("'{}' is not valid; this line is '{}', and a map has N, C, R, T and M in this order",
                  excerpt(lines.line), letter),
      lines.where());
}

/// Parses an integer in any notation: 25, 25.0, 2.5e1.
std::optional<std::uint32_t> whole(std::string_view text, std::uint32_t low) {
  const auto value = number<double>(trimmed(text));
  if (!value || *value < low || *value > most_cost || *value != std::floor(*value)) return std::nullopt;
  return static_cast<std::uint32_t>(*value);
}

/// Parses "x,y", two integers from 1.
std::optional<Cell> pair_of(std::string_view line) {
  const auto parts = parts_between(line, ',');
  const auto x = whole(parts.front(), 1), y = whole(parts.back(), 1);
  if (parts.size() != 2 || !x || !y) return std::nullopt;
  return Cell{static_cast<int>(*x), static_cast<int>(*y)};
}

Outcome<GridFrame> take_size(TextLines& lines) {
  if (auto letter = expect(lines, "N"); !letter) return pass_on(letter);
  lines.next();
  const auto size = pair_of(lines.line);
  if (!size || size->x > longest_map_side || size->y > longest_map_side) {
    return bad_input(fmt::format("'{}' is no size; expected width,height, whole numbers from 1 to {}",
                                 excerpt(lines.line), longest_map_side),
                     lines.where());
  }
  const GridFrame frame{{0.0, 0.0}, 1.0, size->x, size->y};
  if (frame.size() > most_cells) {
    return bad_input(fmt::format("{} x {} cells are more than {}, the most that is read", frame.width,
                                 frame.height, most_cells),
                     lines.where());
  }
  const std::size_t shortest = 2 * frame.size() - 1;  // a digit and a comma or a line end per cell
  if (frame.size() > small_size && shortest > lines.rest.size()) {
    return bad_input(
        fmt::format("{} x {} costs do not fit in the rest of the file; it is cut short or the size is wrong",
                    frame.width, frame.height),
        lines.where());
  }
  return frame;
}

Outcome<std::uint32_t> take_threshold(TextLines& lines) {
  if (auto letter = expect(lines, "C"); !letter) return pass_on(letter);
  lines.next();
  const auto threshold = whole(lines.line, 0);
  if (threshold) return *threshold;
  return bad_input(fmt::format("'{}' is no threshold; expected a whole number from 0 to {}",
                               excerpt(lines.line), most_cost),
                   lines.where());
}

Outcome<Cell> cell_of(const TextLines& lines, const GridFrame& frame, std::string_view whose) {
  const auto cell = pair_of(lines.line);
  if (cell && cell->x <= frame.width && cell->y <= frame.height) return Cell{cell->x - 1, cell->y - 1};
  return bad_input(fmt::format("'{}' {}; expected x,y, whole numbers from 1,1 to {},{}", excerpt(lines.line),
                               cell ? fmt::format("puts the {} off the map", whose) : "is no cell",
                               frame.width, frame.height),
                   lines.where());
}

Outcome<Cell> take_robot(TextLines& lines, const GridFrame& frame) {
  if (auto letter = expect(lines, "R"); !letter) return pass_on(letter);
  lines.next();
  return cell_of(lines, frame, "robot");
}

/// Reads the cells of the target and the line M.
Outcome<std::vector<Cell>> take_target(TextLines& lines, const GridFrame& frame) {
  if (auto letter = expect(lines, "T"); !letter) return pass_on(letter);
  std::vector<Cell> target;
  for (;;) {
    const bool more = lines.next();
    if (trimmed(lines.line) == "M") break;
    if (!more) return bad_input("the file ends before the line M and the costs", lines.where());
    if (target.size() == most_steps) {
      return bad_input(fmt::format("the target has more than {} cells; cut its trajectory short", most_steps),
                       lines.where());
    }
    auto cell = cell_of(lines, frame, "target");
    if (!cell) return pass_on(cell);
    target.push_back(*cell);
  }
  if (!target.empty()) return target;
  return bad_input("the target has no cells; write at least one between the lines T and M", lines.where());
}

/// Reads row x of the file, which is column x of the grid, from the lowest cell up.
Status take_row(const TextLines& lines, int x, CostGrid& costs) {
  std::string_view rest = lines.line;
  for (int y = 0; y < costs.frame.height; ++y) {
    const std::size_t comma = rest.find(',');
    const std::string_view word = rest.substr(0, comma);
    const auto value = whole(word, 0);
    if (!value) {
      return bad_input(
          fmt::format("'{}' is no cost (value {} of this row); expected a whole number from 0 to {}",
                      excerpt(trimmed(word)), y + 1, most_cost),
          lines.where());
    }
    costs[{x, y}] = *value;
    if ((y + 1 == costs.frame.height) != (comma == std::string_view::npos)) {
      return bad_input(fmt::format("row {} of the costs has {} values; the size says {}", x + 1,
                                   std::ranges::count(lines.line, ',') + 1, costs.frame.height),
                       lines.where());
    }
    rest.remove_prefix(std::min(comma, rest.size() - 1) + 1);
  }
  return {};
}

Status take_costs(TextLines& lines, CostGrid& costs) {
  for (int x = 0; x < costs.frame.width; ++x) {
    if (!lines.next()) {
      return bad_input(
          fmt::format("the file ends after {} rows of costs; the size says {}", x, costs.frame.width),
          lines.where());
    }
    if (auto row = take_row(lines, x, costs); !row) return row;
  }
  while (lines.next()) {
    if (trimmed(lines.line).empty()) continue;
    return bad_input(fmt::format("a row of costs too many; the size says {}", costs.frame.width),
                     lines.where());
  }
  return {};
}

}  // namespace

Outcome<PursuitProblem> pursuit_map_from_text(std::string_view text, const std::string& name) {
  TextLines lines{text, name};
  auto frame = take_size(lines);
  if (!frame) return pass_on(frame);
  auto threshold = take_threshold(lines);
  if (!threshold) return pass_on(threshold);
  auto robot = take_robot(lines, *frame);
  if (!robot) return pass_on(robot);
  auto target = take_target(lines, *frame);
  if (!target) return pass_on(target);
  if (frame->size() > small_size && 2 * frame->size() > lines.rest.size() + 1) {
    return bad_input(
        fmt::format("the file ends before its {} x {} costs; it is cut short", frame->width, frame->height),
        lines.where());
  }
  auto costs = std::make_shared<CostGrid>(*frame);
  if (auto taken = take_costs(lines, *costs); !taken) return pass_on(taken);
  return PursuitProblem{std::move(costs), *threshold, *robot, std::move(*target)};
}

Outcome<PursuitProblem> load_pursuit_map(const std::string& path) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  return pursuit_map_from_text(*text, path);
}

}  // namespace outrider
