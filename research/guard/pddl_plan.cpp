#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "outrider/io/files/text.hpp"
#include "research/guard/pddl.hpp"
#include "research/guard/pddl_names.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_actions = 100'000;
constexpr double latest_plan_s = 1e9;
constexpr const char* form = "a line is TIME: (ACTION WORDS) [DURATION], with times in s";

using Index = std::map<std::string, std::size_t, std::less<>>;

Index index_of(const std::vector<std::string>& names) {
  Index index;
  for (std::size_t i = 0; i < names.size(); ++i) index[names[i]] = i;
  return index;
}

std::string phrase_of(const TemporalProblem& problem, const PddlNames& names, const TemporalAction& action) {
  switch (action.verb) {
    case TemporalVerb::drive:
      return fmt::format("(drive {} {})", names.poses[action.pose], names.poses[action.object]);
    case TemporalVerb::shoot:
      return fmt::format("(shoot {} {} {})", names.poses[action.pose], names.targets[action.object],
                         pddl_name(action.way));
    case TemporalVerb::rest: return fmt::format("(rest {})", pddl_name(action.way));
    default:
      return fmt::format("({} {} {})", pddl_fill(problem.supplies.stations[action.object].store),
                         names.stations[action.object], names.poses[action.pose]);
  }
}

/// A line in its three parts; nothing when it has another form.
struct Parts {
  double start_s = 0.0;
  double duration_s = 0.0;
  std::string_view phrase;  ///< between the parentheses
};

std::optional<double> time_of(std::string_view text) {
  const auto time = number<double>(trimmed(text));
  return time && *time >= 0.0 && *time <= latest_plan_s ? time : std::nullopt;
}

std::optional<Parts> parts_of(std::string_view line) {
  constexpr std::size_t none = std::string_view::npos;
  const std::size_t colon = line.find(':');
  const std::size_t open = line.find('(');
  const std::size_t close = line.find(')');
  const std::size_t bracket = line.find('[');
  if (colon == none || open == none || close == none || bracket == none) return std::nullopt;
  if (colon > open || open > close || close > bracket || !line.ends_with(']')) return std::nullopt;
  if (!trimmed(line.substr(colon + 1, open - colon - 1)).empty()) return std::nullopt;
  if (!trimmed(line.substr(close + 1, bracket - close - 1)).empty()) return std::nullopt;
  const auto start = time_of(line.substr(0, colon));
  const auto duration = time_of(line.substr(bracket + 1, line.size() - bracket - 2));
  if (!start || !duration) return std::nullopt;
  return Parts{*start, *duration, line.substr(open + 1, close - open - 1)};
}

/// Reads the words of actions of one problem.
class Reader {
 public:
  explicit Reader(const TemporalProblem& problem)
      : problem_(problem),
        names_(problem),
        poses_(index_of(names_.poses)),
        targets_(index_of(names_.targets)),
        fillers_(index_of(names_.stations)) {}

  Outcome<TemporalAction> action_of(const Parts& parts, const std::string& where) const {
    const auto said = words(parts.phrase);
    TemporalAction action{parts.start_s, parts.duration_s};
    const std::string_view verb = said.empty() ? std::string_view{} : said.front();
    if (verb == "drive" && said.size() == 3) {
      return both(action, find(poses_, said[1], action.pose), find(poses_, said[2], action.object), said,
                  where);
    }
    if (verb == "shoot" && said.size() == 4 && take_way(said[3], action)) {
      action.verb = TemporalVerb::shoot;
      return both(action, find(poses_, said[1], action.pose), find(targets_, said[2], action.object), said,
                  where);
    }
    if (verb == "rest" && said.size() == 2 && take_way(said[1], action)) {
      action.verb = TemporalVerb::rest;
      return action;
    }
    if ((verb == "fill-water" || verb == "fill-charge") && said.size() == 3) {
      action.verb = TemporalVerb::fill;
      const bool station = find(fillers_, said[1], action.object);
      const bool gives = station && verb == pddl_fill(problem_.supplies.stations[action.object].store);
      return both(action, find(poses_, said[2], action.pose), gives, {said[0], said[2], said[1]}, where);
    }
    return bad_input(
        fmt::format("'({})' is no action here; take (drive POSE POSE), (shoot POSE TARGET WAY), (rest WAY), "
                    "(fill-water FILLER POSE) or (fill-charge FILLER POSE), WAY being direct, plus or minus",
                    excerpt(parts.phrase)),
        where);
  }
  [[nodiscard]] std::string phrase(const TemporalAction& action) const {
    return phrase_of(problem_, names_, action);
  }

 private:
  static bool find(const Index& index, std::string_view name, std::size_t& found) {
    const auto entry = index.find(name);
    if (entry == index.end()) return false;
    found = entry->second;
    return true;
  }
  static bool take_way(std::string_view word, TemporalAction& action) {
    for (const WayRound way : {WayRound::direct, WayRound::plus, WayRound::minus}) {
      if (word != pddl_name(way)) continue;
      action.way = way;
      return true;
    }
    return false;
  }
  static Outcome<TemporalAction> both(const TemporalAction& action, bool first, bool second,
                                      const std::vector<std::string_view>& said, const std::string& where) {
    if (first && second) return action;
    return bad_input(
        fmt::format("'{}' is no name that ({} ...) takes there; take one of the objects of the problem",
                    excerpt(first ? said[2] : said[1]), said[0]),
        where);
  }

  const TemporalProblem& problem_;
  PddlNames names_;
  Index poses_;
  Index targets_;
  Index fillers_;
};

}  // namespace

std::string pddl_plan(const TemporalProblem& problem, const std::vector<TemporalAction>& actions) {
  const PddlNames names(problem);
  std::string text;
  double makespan = 0.0;
  for (const TemporalAction& action : actions) {
    text += fmt::format("{:.12f}: {} [{:.12f}]\n", action.start_s, phrase_of(problem, names, action),
                        action.duration_s);
    makespan = std::max(makespan, action.start_s + action.duration_s);
  }
  return fmt::format("; {} actions, makespan {:.9f} s\n", actions.size(), makespan) + text;
}

Outcome<PddlPlan> pddl_plan_from_text(std::string_view text, const std::string& name,
                                      const TemporalProblem& problem) {
  const Reader reader(problem);
  PddlPlan plan;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const std::string_view whole = take_line(text);
    const std::string line = lower(whole.substr(0, whole.find(';')));
    const std::string_view said = trimmed(line);
    if (said.empty()) continue;
    const std::string where = fmt::format("{}:{}", name, line_number);
    const auto parts = parts_of(said);
    if (!parts) return bad_input(fmt::format("'{}' is not valid; {}", excerpt(said), form), where);
    auto action = reader.action_of(*parts, where);
    if (!action) return pass_on(action);
    if (plan.actions.size() == most_actions) {
      return bad_input(fmt::format("more than {} actions; shorten the plan", most_actions), where);
    }
    plan.actions.push_back(*action);
    plan.lines.push_back(line_number);
    plan.phrases.push_back(reader.phrase(*action));
  }
  return plan;
}

}  // namespace outrider
