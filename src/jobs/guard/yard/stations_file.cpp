#include "outrider/jobs/guard/yard/stations_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_stations = 100;
constexpr const char* key = "supplies.stations";

/// The parts of a word between commas.
std::vector<std::string_view> parts_of(std::string_view word) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t comma = word.find(',');
    parts.push_back(word.substr(0, comma));
    if (comma == std::string_view::npos) return parts;
    word.remove_prefix(comma + 1);
  }
}

Outcome<Station> station_of(std::string_view word, const Box2& bounds) {
  const std::size_t equals = word.find('=');
  const auto parts =
      equals == std::string_view::npos ? std::vector<std::string_view>{} : parts_of(word.substr(equals + 1));
  const bool three = parts.size() == 3;
  const auto x = three ? number<double>(parts[0]) : std::nullopt;
  const auto y = three ? number<double>(parts[1]) : std::nullopt;
  const bool gives = three && (parts[2] == "water" || parts[2] == "charge" || parts[2] == "both");
  if (!x || !y || !gives || equals == 0 || !is_printable(word)) {
    return bad_input(
        fmt::format("'{}' is not valid; expected name=x,y,water or name=x,y,charge or name=x,y,both in m, "
                    "such as well=2,-3,water",
                    excerpt(word)),
        key);
  }
  const std::string name(word.substr(0, equals));
  if (!bounds.contains({*x, *y})) {
    return bad_input(fmt::format("{} at {} is outside the yard, which spans {} to {}; move it in",
                                 excerpt(name), place_text(*x, *y), place_text(bounds.low.x, bounds.low.y),
                                 place_text(bounds.high.x, bounds.high.y)),
                     key);
  }
  return Station{name, {*x, *y}, parts[2] != "charge", parts[2] != "water"};
}

}  // namespace

Outcome<std::vector<Station>> stations_from_text(std::string_view text, const Box2& bounds) {
  std::vector<Station> stations;
  for (const std::string_view word : words(text)) {
    auto station = station_of(word, bounds);
    if (!station) return pass_on(station);
    if (std::ranges::find(stations, station->name, &Station::name) != stations.end()) {
      return bad_input(fmt::format("'{}' is given twice; give another name", station->name), key);
    }
    stations.push_back(std::move(*station));
    if (stations.size() > most_stations) {
      return bad_input(fmt::format("more than {} stations; leave some out", most_stations), key);
    }
  }
  return stations;
}

Status load_stations(GuardProblem& problem) {
  auto stations = stations_from_text(problem.supplies.stations_text, problem.world.bounds);
  if (!stations) return pass_on(stations);
  problem.supplies.stations = std::move(*stations);
  return {};
}

}  // namespace outrider
