#include "outrider/pursuit/miss.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <limits>

#include "field.hpp"

namespace outrider {
namespace {

constexpr int no_way = std::numeric_limits<int>::max();

/// Returns the least number of steps from the robot to each cell, row by row without a border.
std::vector<int> steps_to_cells(const PursuitProblem& problem, const PursuitField& field) {
  const GridFrame& frame = problem.costs->frame;
  std::vector<int> steps(frame.size(), no_way);
  CellSet open = field.free;
  std::vector<CellIndex> reached{field.start};
  open.remove(field.start);
  steps[frame.index(problem.start)] = 0;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const int next = steps[frame.index(field.cell(reached[k]))] + 1;
    for_neighbours(open, reached[k], field.stride, [&](CellIndex n) {
      open.remove(n);
      steps[frame.index(field.cell(n))] = next;
      reached.push_back(n);
    });
  }
  return steps;
}

/// Replaces each of `count` values, `step` apart in memory, by the least value at most `radius` positions
/// away.
void spread_least(int* values, int count, std::size_t step, int radius) {
  std::deque<std::pair<int, int>> falling;  // (place, value): candidates, the least in front
  for (int i = 0; i < count + radius; ++i) {
    if (i < count) {
      const int value = values[static_cast<std::size_t>(i) * step];
      while (!falling.empty() && falling.back().second >= value) falling.pop_back();
      falling.emplace_back(i, value);
    }
    const int centre = i - radius;
    if (centre < 0) continue;
    while (falling.front().first < centre - radius) falling.pop_front();
    values[static_cast<std::size_t>(centre) * step] = falling.front().second;
  }
}

/// Returns the first second from 1 on in which the robot can be within `radius` cells of the target; -1 if
/// there is none.
int first_within(const PursuitProblem& problem, std::vector<int> steps, int radius) {
  const GridFrame& frame = problem.costs->frame;
  const auto width = static_cast<std::size_t>(frame.width);
  for (int y = 0; y < frame.height; ++y) spread_least(&steps[frame.index({0, y})], frame.width, 1, radius);
  for (int x = 0; x < frame.width; ++x)
    spread_least(&steps[frame.index({x, 0})], frame.height, width, radius);
  for (int s = problem.start_s + 1; s <= problem.last_s(); ++s) {
    if (steps[frame.index(problem.target[static_cast<std::size_t>(s)])] <= s - problem.start_s) return s;
  }
  return -1;
}

void measure_in_seconds(Miss& miss, const PursuitProblem& problem, const std::vector<int>& steps) {
  for (int s = problem.start_s + 1; s <= problem.last_s(); ++s) {
    const Cell cell = problem.target[static_cast<std::size_t>(s)];
    const int needed = steps[problem.costs->frame.index(cell)];
    if (needed == no_way) continue;
    const int late = needed - (s - problem.start_s);
    if (miss.late_by_s && *miss.late_by_s <= late) continue;
    miss.late_by_s = late;
    miss.late_at = cell;
    miss.late_for_s = s;
  }
}

void measure_in_cells(Miss& miss, const PursuitProblem& problem, const std::vector<int>& steps) {
  const GridFrame& frame = problem.costs->frame;
  int low = 0, high = std::max(frame.width, frame.height) - 1;  // within `low` never, within `high` once
  miss.short_at_s = problem.start_s + 1;
  while (high - low > 1) {
    const int radius = low + (high - low) / 2;
    const int second = first_within(problem, steps, radius);
    (second < 0 ? low : high) = radius;
    if (second >= 0) miss.short_at_s = second;
  }
  miss.short_by_cells = high;
}

MissReason reason_of(const Miss& miss, const PursuitProblem& problem) {
  if (problem.last_s() <= problem.start_s) return MissReason::too_few_seconds;
  if (miss.late_by_s) return MissReason::too_late;
  const auto first = problem.target.begin() + problem.start_s + 1;
  const bool walls = std::all_of(first, problem.target.end(), [&](Cell c) { return problem.wall(c); });
  return walls ? MissReason::always_on_walls : MissReason::cut_off;
}

std::string sentence_of(const Miss& miss, const PursuitProblem& problem) {
  const int seconds = problem.last_s() - problem.start_s;
  const std::string nearest =
      fmt::format("the robot comes no nearer than {} cell{} to it, at second {}", miss.short_by_cells,
                  miss.short_by_cells == 1 ? "" : "s", miss.short_at_s);
  switch (miss.reason) {
    case MissReason::too_few_seconds:
      return fmt::format(
          "the target cannot be caught: it is gone after second {}, and only seconds from {} on count",
          problem.last_s(), problem.start_s + 1);
    case MissReason::always_on_walls:
      return fmt::format(
          "the target cannot be caught: it is on walls in all of its {} seconds that count; {}", seconds,
          nearest);
    case MissReason::cut_off:
      return fmt::format(
          "the target cannot be caught: walls part the robot from every free cell that it visits; {}",
          nearest);
    case MissReason::too_late: break;
  }
  return fmt::format(
      "the target cannot be caught: the robot is at least {} s late, in cell {} where the target is at "
      "second {}; {}",
      *miss.late_by_s, cell_text(miss.late_at), miss.late_for_s, nearest);
}

}  // namespace

std::string_view to_string(MissReason reason) {
  switch (reason) {
    case MissReason::too_few_seconds: return "too_few_seconds";
    case MissReason::always_on_walls: return "always_on_walls";
    case MissReason::cut_off: return "cut_off";
    case MissReason::too_late: break;
  }
  return "too_late";
}

std::optional<Miss> why_no_catch(const PursuitProblem& problem) {
  const PursuitField field(problem);
  const std::vector<int> steps = steps_to_cells(problem, field);
  Miss miss;
  measure_in_seconds(miss, problem, steps);
  if (miss.late_by_s && *miss.late_by_s <= 0) return std::nullopt;
  miss.reason = reason_of(miss, problem);
  if (miss.reason != MissReason::too_few_seconds) measure_in_cells(miss, problem, steps);
  miss.sentence = sentence_of(miss, problem);
  return miss;
}

}  // namespace outrider
