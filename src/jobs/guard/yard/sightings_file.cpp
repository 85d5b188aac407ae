#include "outrider/jobs/guard/yard/sightings_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "outrider/core/options.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_lines = 1'000'000;
constexpr std::size_t most_ids = 10'000;
constexpr double most = 1e6;
constexpr const char* prefers_key = "wander.prefers";

/// The four fields of a line; nothing when there are not four.
std::optional<std::array<std::string_view, 4>> fields(std::string_view line) {
  std::array<std::string_view, 4> result;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i == 3)) return std::nullopt;
    result[i] = trimmed(line.substr(0, comma));
    if (i < 3) line.remove_prefix(comma + 1);
  }
  return result;
}

std::optional<double> bounded(std::string_view text) {
  const auto value = number<double>(text);
  return value && std::abs(*value) <= most ? value : std::nullopt;
}

}  // namespace

Outcome<std::vector<Track>> sightings_from_text(std::string_view text, const std::string& name) {
  std::vector<Track> tracks;
  std::map<std::string, std::size_t, std::less<>> ids;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    std::string_view line = take_line(text);
    line = trimmed(line.substr(0, line.find('#')));
    const std::string where = fmt::format("{}:{}", name, line_number);
    if (line_number > most_lines) {
      return bad_input(fmt::format("more than {} lines; shorten the history", most_lines), where);
    }
    if (line.empty() || (line_number == 1 && line == "t,id,x,y")) continue;
    const auto words = fields(line);
    const auto t = words ? bounded((*words)[0]) : std::nullopt;
    const auto x = words ? bounded((*words)[2]) : std::nullopt;
    const auto y = words ? bounded((*words)[3]) : std::nullopt;
    if (!t || !x || !y || (*words)[1].empty() || !is_printable((*words)[1])) {
      return bad_input(
          fmt::format("'{}' is not valid; a line is t,id,x,y in s and m, such as 12.5,fox,1.2,-3",
                      excerpt(line)),
          where);
    }
    const auto found = ids.emplace(std::string((*words)[1]), tracks.size());
    if (found.second) tracks.emplace_back();
    if (tracks.size() > most_ids) {
      return bad_input(fmt::format("more than {} ids; shorten the history", most_ids), where);
    }
    Track& track = tracks[found.first->second];
    if (!track.empty() && *t <= track.back().time_s) {
      return bad_input(fmt::format("t={:g} of {} does not come after {:g}; sort the lines by time", *t,
                                   excerpt((*words)[1]), track.back().time_s),
                       where);
    }
    track.push_back({*t, {*x, *y}});
  }
  return tracks;
}

Outcome<std::vector<double>> preferences_from_text(std::string_view text,
                                                   const std::vector<Target>& targets) {
  std::vector<double> weights(targets.size(), 1.0);
  std::vector<std::string> known;
  for (const Target& target : targets) known.push_back(target.name);
  for (const std::string_view word : words(text)) {
    const std::size_t equals = word.rfind('=');
    const auto weight =
        equals == std::string_view::npos ? std::nullopt : number<double>(word.substr(equals + 1));
    if (!weight || *weight < 0.0 || *weight > most) {
      return bad_input(
          fmt::format("'{}' is not valid; expected place=weight with a weight from 0 to 1e6", excerpt(word)),
          prefers_key);
    }
    const std::string_view place = word.substr(0, equals);
    bool found = false;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (targets[i].name != place) continue;
      weights[i] = *weight;
      found = true;
    }
    if (found) continue;
    const std::string nearest = nearest_name(place.substr(0, 64), known);
    return bad_input(fmt::format("there is no target '{}'{}", excerpt(place),
                                 nearest.empty() ? "; name one of the targets"
                                                 : fmt::format("; did you mean '{}'?", nearest)),
                     prefers_key);
  }
  return weights;
}

}  // namespace outrider
