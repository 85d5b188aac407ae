#include "axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"

namespace outrider {
namespace {

constexpr std::size_t bins = 8;
constexpr std::size_t most_values = 40;
constexpr std::uint8_t nowhere = 255;

Axis grid_axis(const Sweep& sweep, std::size_t index) {
  const Varied& varied = sweep.varied[index];
  std::uint64_t stride = sweep.sides();  // runs until its value changes
  for (std::size_t i = index + 1; i < sweep.varied.size(); ++i) {
    if (!sweep.varied[i].is_random()) stride *= sweep.varied[i].grid.size();
  }
  Axis axis{.key = varied.key, .labels = {}, .place_of = std::vector<std::uint8_t>(sweep.total)};
  for (const std::string& value : varied.grid) axis.labels.push_back(printable(value));
  for (std::uint64_t run = 0; run < sweep.total; ++run) {
    axis.place_of[run] = static_cast<std::uint8_t>(run / stride % varied.grid.size());
  }
  return axis;
}

/// Puts numbers into bins of equal width, or of equal ratio.
Axis number_axis(const Varied& varied, const Column& column) {
  const bool log = varied.parts.front().kind == Distribution::Kind::log_uniform;
  const auto scaled = [&](double value) { return log ? std::log(value) : value; };
  double low = INFINITY, high = -INFINITY;
  for (const double value : column.values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  Axis axis{
      .key = varied.key, .labels = {}, .place_of = std::vector<std::uint8_t>(column.values.size(), nowhere)};
  const double begin = scaled(low), width = (scaled(high) - begin) / static_cast<double>(bins);
  if (!(width > 0.0)) return axis;
  for (std::size_t i = 0; i < bins; ++i) {
    const double middle = begin + (static_cast<double>(i) + 0.5) * width;
    axis.labels.push_back(fmt::format("{:.3g}", log ? std::exp(middle) : middle));
  }
  for (std::size_t run = 0; run < column.values.size(); ++run) {
    const double place = (scaled(column.values[run]) - begin) / width;
    if (std::isfinite(place)) {
      axis.place_of[run] = static_cast<std::uint8_t>(std::clamp(place, 0.0, static_cast<double>(bins) - 1.0));
    }
  }
  return axis;
}

}  // namespace

std::vector<std::string> shown_keys(const Sweep& sweep, std::size_t most) {
  std::vector<std::string> keys;
  for (const Varied& varied : sweep.varied) {
    const bool grid = !varied.is_random() && varied.grid.size() > 1 && varied.grid.size() <= most_values;
    if ((grid || varied.is_random_number()) && keys.size() < most) keys.push_back(varied.key);
  }
  return keys;
}

Axis axis_of(const Sweep& sweep, const Column& column) {
  std::size_t index = 0;
  while (sweep.varied[index].key != column.name) ++index;
  const Varied& varied = sweep.varied[index];
  return varied.is_random() ? number_axis(varied, column) : grid_axis(sweep, index);
}

}  // namespace outrider
