#include "outrider/io/log/calibration_runs.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "outrider/core/units.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

constexpr std::array<std::string_view, 7> columns = {"ahead_mps", "left_mps", "turn_dps",   "time_s",
                                                     "x_m",       "y_m",      "heading_deg"};
constexpr std::size_t most_runs = 100'000;
constexpr double largest = 1e6;

/// Returns the index of the column for each field of a line.
Outcome<std::vector<std::size_t>> order_of(std::string_view head, const std::string& where) {
  std::vector<std::size_t> order;
  std::array<bool, columns.size()> seen{};
  for (const std::string_view field : parts_between(head, ',')) {
    const auto found = std::ranges::find(columns, field);
    if (found == columns.end()) {
      return bad_input(
          fmt::format("'{}' is no column; the head is {}", excerpt(field), fmt::join(columns, ",")), where);
    }
    const auto column = static_cast<std::size_t>(found - columns.begin());
    if (seen[column]) return bad_input(fmt::format("the column '{}' is given twice", *found), where);
    seen[column] = true;
    order.push_back(column);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!seen[i]) return bad_input(fmt::format("the column '{}' is missing", columns[i]), where);
  }
  return order;
}

Outcome<CalibrationRun> run_from(std::string_view line, const std::vector<std::size_t>& order,
                                 const std::string& where) {
  const auto fields = parts_between(line, ',');
  if (fields.size() != order.size()) {
    return bad_input(fmt::format("{} values for {} columns", fields.size(), order.size()), where);
  }
  std::array<double, columns.size()> v{};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto value = number<double>(fields[i]);
    if (!value || std::abs(*value) > largest) {
      return bad_input(fmt::format("'{}' is not valid for {}; expected a number from -1e6 to 1e6",
                                   excerpt(fields[i]), columns[order[i]]),
                       where);
    }
    v[order[i]] = *value;
  }
  return CalibrationRun{{v[0], v[1], radians(v[2])}, v[3], {{v[4], v[5]}, radians(v[6])}, where};
}

}  // namespace

Outcome<std::vector<CalibrationRun>> calibration_runs_from_text(std::string_view text,
                                                                const std::string& name) {
  std::vector<CalibrationRun> runs;
  std::vector<std::size_t> order;
  TextLines lines{text, name};
  while (lines.next_filled()) {
    const std::string where = lines.where();
    if (order.empty()) {
      auto found = order_of(lines.line, where);
      if (!found) return pass_on(found);
      order = std::move(*found);
      continue;
    }
    if (runs.size() == most_runs) {
      return bad_input(fmt::format("more than {} runs are not taken", most_runs), where);
    }
    auto run = run_from(lines.line, order, where);
    if (!run) return pass_on(run);
    runs.push_back(std::move(*run));
  }
  if (runs.empty())
    return bad_input("there are no runs in it; a head and a line for each run are needed", name);
  return runs;
}

Outcome<std::vector<CalibrationRun>> load_calibration_runs(const std::string& path) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  return calibration_runs_from_text(*text, path);
}

std::string calibration_runs_text(const std::vector<CalibrationRun>& runs) {
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (const CalibrationRun& run : runs) {
    const Twist2& u = run.command;
    text += fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6f},{:.6f},{:.6f}\n", u.ahead_mps, u.left_mps,
                        degrees(u.turn_radps), run.time_s, run.start_T_end.position.x,
                        run.start_T_end.position.y, degrees(run.start_T_end.heading_rad));
  }
  return text;
}

}  // namespace outrider
