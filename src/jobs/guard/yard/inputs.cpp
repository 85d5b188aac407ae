#include "outrider/jobs/guard/yard/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/jobs/guard/behaviour/policy.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_places = 100;
constexpr std::size_t most_lines = 1'000'000;
constexpr std::size_t most_ids = 10'000;
constexpr double most = 1e6;  // of a number

/// A list of words name=x,y or, with kinds, name=x,y,kind.
struct PlaceForm {
  std::string_view what;  ///< what there are too many of
  const char* key = "";
  const char* form = "";
  std::vector<std::string_view> kinds = {};
};

struct NamedPlace {
  std::string name;
  Vec2 position;
  std::string_view kind;
};

Outcome<NamedPlace> named_place(std::string_view word, const Box2& bounds, const PlaceForm& form) {
  const std::size_t equals = std::min(word.find('='), word.size());
  const auto parts = parts_between(word.substr(std::min(equals + 1, word.size())), ',');
  const std::string_view kind = form.kinds.empty() ? "" : parts.back();
  const std::size_t numbers = parts.size() - (form.kinds.empty() ? 0 : 1);
  const auto place = numbers == 2 ? numbers_of(std::span(parts).first(2)) : std::nullopt;
  if (!place || equals == 0 || !is_printable(word) ||
      (!form.kinds.empty() && std::ranges::count(form.kinds, kind) == 0))
    return bad_input(fmt::format("'{}' is not valid; expected {}", excerpt(word), form.form), form.key);
  NamedPlace named{std::string(word.substr(0, equals)), {(*place)[0], (*place)[1]}, kind};
  if (bounds.contains(named.position)) return named;
  return bad_input(
      fmt::format("{} at {} is outside the yard, which spans {} to {}; move it in", excerpt(named.name),
                  place_text(named.position.x, named.position.y), place_text(bounds.low.x, bounds.low.y),
                  place_text(bounds.high.x, bounds.high.y)),
      form.key);
}

Outcome<std::vector<NamedPlace>> named_places(std::string_view text, const Box2& bounds,
                                              const PlaceForm& form) {
  std::vector<NamedPlace> places;
  for (const std::string_view word : words(text)) {
    auto place = named_place(word, bounds, form);
    if (!place) return pass_on(place);
    if (std::ranges::find(places, place->name, &NamedPlace::name) != places.end())
      return bad_input(fmt::format("'{}' is given twice; give another name", place->name), form.key);
    places.push_back(std::move(*place));
    if (places.size() > most_places)
      return bad_input(fmt::format("more than {} {}; leave some out", most_places, form.what), form.key);
  }
  return places;
}

/// Returns the index of the thing of that name.
template <class Named>
Outcome<std::size_t> find(std::string_view name, const std::vector<Named>& all, std::string_view what,
                          const std::string& where) {
  const auto found = std::ranges::find(all, name, &Named::name);
  if (found == all.end()) return no_such_row(what, name, names_of(all), where);
  return static_cast<std::size_t>(found - all.begin());
}

Outcome<Intruder> intruder_of(std::string_view line, const std::string& where, const GuardProblem& problem,
                              const std::vector<Entrance>& entrances, const ArrivalOptions& options) {
  std::optional<std::string_view> time, at, by;
  for (const std::string_view word : words(line)) {
    const std::size_t equals = word.find('=');
    const std::string_view key = word.substr(0, equals);
    auto* const value = key == "t" ? &time : key == "at" ? &at : key == "by" ? &by : nullptr;
    if (value == nullptr || equals == std::string_view::npos || *value) {
      return bad_input(
          fmt::format("'{}' is not valid here; a line is t=SECONDS at=TARGET by=ENTRANCE", excerpt(word)),
          where);
    }
    *value = word.substr(equals + 1);
  }
  if (!time || !at || !by)
    return bad_input("something is missing; a line is t=SECONDS at=TARGET by=ENTRANCE", where);
  const auto enters_s = number<double>(*time);
  if (!enters_s || *enters_s < 0.0 || *enters_s > most) {
    return bad_input(fmt::format("t={} is not valid; expected a number from 0 to 1e6 s", excerpt(*time)),
                     where);
  }
  auto place = find(*at, problem.targets, "target", where);
  if (!place) return pass_on(place);
  auto door = find(*by, entrances, "entrance", where);
  if (!door) return pass_on(door);
  Intruder intruder{"", *place, entrances[*door].name, entrances[*door].position, *enters_s, 0.0};
  intruder.settles_s = settling_time(problem, options, intruder);
  return intruder;
}

}  // namespace

Outcome<std::vector<Entrance>> entrances_from_text(std::string_view text, const Box2& bounds) {
  auto places =
      named_places(text, bounds, {"entrances", "arrivals.entrances", "name=x,y in m, such as gate=0,-7"});
  if (!places) return pass_on(places);
  std::vector<Entrance> entrances;
  for (const NamedPlace& place : *places) entrances.push_back({place.name, place.position});
  return entrances;
}

Outcome<std::vector<Station>> stations_from_text(std::string_view text, const Box2& bounds) {
  auto places = named_places(text, bounds,
                             {"stations",
                              "supplies.stations",
                              "name=x,y,water or name=x,y,charge or name=x,y,both in m, such as "
                              "well=2,-3,water",
                              {"water", "charge", "both"}});
  if (!places) return pass_on(places);
  std::vector<Station> stations;
  for (const auto& [name, position, kind] : *places)
    stations.push_back({name, position, kind != "charge", kind != "water"});
  return stations;
}

Outcome<std::vector<Intruder>> arrivals_from_text(std::string_view text, const std::string& name,
                                                  const GuardProblem& problem,
                                                  const std::vector<Entrance>& entrances,
                                                  const ArrivalOptions& options) {
  std::vector<Intruder> intruders;
  for (TextLines lines{text, name}; lines.next_filled();) {
    auto intruder = intruder_of(lines.line, lines.where(), problem, entrances, options);
    if (!intruder) return pass_on(intruder);
    intruders.push_back(std::move(*intruder));
    if (intruders.size() > most_intruders)
      return bad_input(fmt::format("more than {} intruders; shorten the list", most_intruders),
                       lines.where());
  }
  put_in_order(problem, intruders);
  return intruders;
}

Outcome<std::vector<Intruder>> load_arrivals(const GuardProblem& problem, const ArrivalOptions& options,
                                             std::uint64_t seed) {
  if (auto policy = find_replan_policy(options.policy); !policy) return pass_on(policy);
  if (auto objective = find_objective(options.objective); !objective) return pass_on(objective);
  if (auto ok = check_survivors(problem, options); !ok) return pass_on(ok);
  auto entrances = entrances_from_text(options.entrances, problem.world.bounds);
  if (!entrances) return pass_on(entrances);
  if (!options.any()) return std::vector<Intruder>{};
  if (options.list.empty() || entrances->empty()) return draw_arrivals(problem, *entrances, options, seed);
  auto text = read_file(options.list);
  if (!text) return pass_on(text);
  return arrivals_from_text(*text, options.list, problem, *entrances, options);
}

Outcome<std::vector<Track>> sightings_from_text(std::string_view text, const std::string& name) {
  std::vector<Track> tracks;
  std::map<std::string_view, std::size_t> ids;
  for (TextLines lines{text, name}; lines.next_filled();) {
    const auto words = parts_between(lines.line, ',');
    if (lines.number > most_lines)
      return bad_input(fmt::format("more than {} lines; shorten the history", most_lines), lines.where());
    if (lines.number == 1 && trimmed(lines.line) == "t,id,x,y") continue;
    const bool four = words.size() == 4;
    const auto t = four ? numbers_of(std::span(words).first(1), most) : std::nullopt;
    const auto place = four ? numbers_of(std::span(words).last(2), most) : std::nullopt;
    if (!t || !place || words[1].empty() || !is_printable(words[1])) {
      return bad_input(
          fmt::format("'{}' is not valid; a line is t,id,x,y in s and m, such as 12.5,fox,1.2,-3",
                      excerpt(trimmed(lines.line))),
          lines.where());
    }
    const auto [id, is_new] = ids.emplace(words[1], tracks.size());
    if (is_new) tracks.emplace_back();
    if (tracks.size() > most_ids)
      return bad_input(fmt::format("more than {} ids; shorten the history", most_ids), lines.where());
    Track& track = tracks[id->second];
    const double time_s = t->front();
    if (!track.empty() && time_s <= track.back().time_s) {
      return bad_input(fmt::format("t={:g} of {} does not come after {:g}; sort the lines by time", time_s,
                                   excerpt(words[1]), track.back().time_s),
                       lines.where());
    }
    track.push_back({time_s, {(*place)[0], (*place)[1]}});
  }
  return tracks;
}

Outcome<std::vector<double>> preferences_from_text(std::string_view text,
                                                   const std::vector<Target>& targets) {
  std::vector<double> weights(targets.size(), 1.0);
  for (const std::string_view word : words(text)) {
    const std::size_t equals = word.rfind('=');
    const auto weight =
        equals == std::string_view::npos ? std::nullopt : number<double>(word.substr(equals + 1));
    if (!weight || *weight < 0.0 || *weight > most) {
      return bad_input(
          fmt::format("'{}' is not valid; expected place=weight with a weight from 0 to 1e6", excerpt(word)),
          "wander.prefers");
    }
    auto target = find(word.substr(0, equals), targets, "target", "wander.prefers");
    if (!target) return pass_on(target);
    weights[*target] = *weight;
  }
  return weights;
}

Outcome<std::vector<Pose2>> parse_starts(const std::string& text, std::int64_t robots) {
  std::vector<Pose2> starts;
  auto parts = parts_between(text, ';');
  if (parts.back().empty()) parts.pop_back();
  for (const std::string_view part : parts) {
    auto start = parse_pose(std::string(part), "robot_starts");
    if (!start) return pass_on(start);
    starts.push_back({start->position, wrap_angle(start->heading_rad)});
  }
  const auto others = static_cast<std::size_t>(robots - 1);
  if (starts.empty() || starts.size() == others) return starts;
  const std::string remedy =
      others == 0 ? "leave robot_starts out or set robots" : fmt::format("give {} or none", others);
  return bad_input(fmt::format("{} start{} for {} robot{}, of which the first has start; {}", starts.size(),
                               starts.size() == 1 ? "" : "s", robots, robots == 1 ? "" : "s", remedy),
                   "robot_starts");
}

}  // namespace outrider
