#include "outrider/jobs/guard/yard/arrivals_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/jobs/guard/behaviour/policy.hpp"
#include "outrider/jobs/guard/behaviour/survivors.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_entrances = 100;
constexpr double latest_s = 1e6;
constexpr const char* entrances_key = "arrivals.entrances";

Outcome<Entrance> entrance_of(std::string_view word, const Box2& bounds) {
  const std::size_t equals = word.find('=');
  const std::size_t comma = word.find(',', std::min(equals, word.size()));
  const auto x = comma == std::string_view::npos
                     ? std::nullopt
                     : number<double>(word.substr(equals + 1, comma - equals - 1));
  const auto y = comma == std::string_view::npos ? std::nullopt : number<double>(word.substr(comma + 1));
  if (!x || !y || equals == 0 || !is_printable(word)) {
    return bad_input(
        fmt::format("'{}' is not valid; expected name=x,y in m, such as gate=0,-7", excerpt(word)),
        entrances_key);
  }
  const std::string name(word.substr(0, equals));
  if (!bounds.contains({*x, *y})) {
    return bad_input(fmt::format("{} at {} is outside the yard, which spans {} to {}; move it in",
                                 excerpt(name), place_text(*x, *y), place_text(bounds.low.x, bounds.low.y),
                                 place_text(bounds.high.x, bounds.high.y)),
                     entrances_key);
  }
  return Entrance{name, {*x, *y}};
}

/// The index of the thing of that name; the fault lists what is near.
template <class Named>
Outcome<std::size_t> find(std::string_view name, const std::vector<Named>& all, std::string_view what,
                          const std::string& where) {
  std::vector<std::string> known;
  for (const Named& one : all) known.push_back(one.name);
  const auto found = std::find(known.begin(), known.end(), name);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  const std::string nearest = nearest_name(name.substr(0, 64), known);
  return bad_input(
      fmt::format("there is no {} '{}'{}", what, excerpt(name),
                  nearest.empty() ? "; list it first" : fmt::format("; did you mean '{}'?", nearest)),
      where);
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
  if (!time || !at || !by) {
    return bad_input("something is missing; a line is t=SECONDS at=TARGET by=ENTRANCE", where);
  }
  const auto enters = number<double>(*time);
  if (!enters || *enters < 0.0 || *enters > latest_s) {
    return bad_input(fmt::format("t={} is not valid; expected a number from 0 to 1e6 s", excerpt(*time)),
                     where);
  }
  auto place = find(*at, problem.targets, "target", where);
  if (!place) return pass_on(place);
  auto door = find(*by, entrances, "entrance", where);
  if (!door) return pass_on(door);
  Intruder intruder{"", *place, entrances[*door].name, entrances[*door].position, *enters, 0.0};
  intruder.settles_s = settling_time(problem, options, intruder);
  return intruder;
}

}  // namespace

Outcome<std::vector<Entrance>> entrances_from_text(std::string_view text, const Box2& bounds) {
  std::vector<Entrance> entrances;
  for (const std::string_view word : words(text)) {
    auto entrance = entrance_of(word, bounds);
    if (!entrance) return pass_on(entrance);
    const bool taken = std::any_of(entrances.begin(), entrances.end(),
                                   [&](const Entrance& e) { return e.name == entrance->name; });
    if (taken) {
      return bad_input(fmt::format("'{}' is given twice; give another name", entrance->name), entrances_key);
    }
    entrances.push_back(std::move(*entrance));
    if (entrances.size() > most_entrances) {
      return bad_input(fmt::format("more than {} entrances; leave some out", most_entrances), entrances_key);
    }
  }
  return entrances;
}

Outcome<std::vector<Intruder>> arrivals_from_text(std::string_view text, const std::string& name,
                                                  const GuardProblem& problem,
                                                  const std::vector<Entrance>& entrances,
                                                  const ArrivalOptions& options) {
  std::vector<Intruder> intruders;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    std::string_view line = take_line(text);
    line = line.substr(0, line.find('#'));
    if (words(line).empty()) continue;
    const std::string where = fmt::format("{}:{}", name, line_number);
    auto intruder = intruder_of(line, where, problem, entrances, options);
    if (!intruder) return pass_on(intruder);
    intruders.push_back(std::move(*intruder));
    if (intruders.size() > most_intruders) {
      return bad_input(fmt::format("more than {} intruders; shorten the list", most_intruders), where);
    }
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
  if (options.list.empty()) return draw_arrivals(problem, *entrances, options, seed);
  auto text = read_file(options.list);
  if (!text) return pass_on(text);
  return arrivals_from_text(*text, options.list, problem, *entrances, options);
}

}  // namespace outrider
