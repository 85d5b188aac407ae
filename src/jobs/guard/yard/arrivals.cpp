#include "outrider/jobs/guard/yard/arrivals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "outrider/core/text.hpp"

namespace outrider {
std::vector<Option> describe(ArrivalOptions& options) {
  return {
      {"count", "", 0, 1000,
       "intruders that enter, at most; 0 and no until: the targets are there from the start", &options.count},
      {"until", "s", 0.0, 1e5, "nobody enters later; 0: no such time", &options.until_s},
      {"rate", "1/s", 1e-6, 1000.0, "intruders a second, on average (a Poisson process)", &options.rate_hz},
      {"entrances", "", 0, 0, "where they come in: name=x,y in m, with blanks between", &options.entrances},
      file_option("list", "file of arrivals, one a line: t= at=TARGET by=ENTRANCE; instead of the process",
                  &options.list),
      {"walk", "m/s", 0.0, 100.0, "their speed from the entrance to their place; 0: they are there at once",
       &options.walk_mps},
      {"leave", "", 0.0, 1.0,
       "probability that one who is hit leaves; else it walks to another target's place", &options.leave},
      {"policy", "", 0, 0, "when to plan anew; a guard policy of 'outrider list'", &options.policy},
      {"group", "", 1, 64, "intruders in a group, of the policy groups", &options.group},
      {"objective", "", 0, 0, "what is made least: time_inside (of all intruders, summed) or makespan",
       &options.objective},
      {"stops", "", 1, 1000, "places that plans choose from", &options.stops},
      {"beam", "", 1, 100000, "unfinished plans that are kept for each number of hits", &options.beam},
  };
}

Outcome<ArrivalObjective> find_objective(const std::string& name) {
  if (name == "time_inside") return ArrivalObjective::time_inside;
  if (name == "makespan") return ArrivalObjective::makespan;
  return bad_input(fmt::format("'{}' is no objective; take time_inside or makespan", excerpt(name)),
                   "arrivals.objective");
}

double settling_time(const GuardProblem& problem, const ArrivalOptions& options, const Intruder& intruder) {
  if (options.walk_mps <= 0.0) return intruder.enters_s;
  const double way_m = distance(intruder.from, xy(problem.targets[intruder.place].base));
  return intruder.enters_s + way_m / options.walk_mps;
}

Outcome<std::vector<Intruder>> draw_arrivals(const GuardProblem& problem,
                                             const std::vector<Entrance>& entrances,
                                             const ArrivalOptions& options, std::uint64_t seed) {
  if (entrances.empty()) {
    return bad_input("missing; give where they come in as name=x,y, such as gate=0,-7", "arrivals.entrances");
  }
  if (problem.targets.empty()) return bad_input("no target, so no place to go to; list one", "targets");
  const Rng arrivals = Rng(seed).child("intruders");
  Rng gaps = arrivals.child("gap");
  Rng doors = arrivals.child("entrance");
  Rng places = arrivals.child("place");
  const auto wanted = options.count > 0 ? static_cast<std::size_t>(options.count) : most_intruders + 1;
  std::vector<Intruder> intruders;
  double time_s = 0.0;
  while (intruders.size() < wanted) {
    time_s += -std::log1p(-gaps.uniform()) / options.rate_hz;
    if (options.until_s > 0.0 && time_s > options.until_s) break;
    const Entrance& door = entrances[doors.below(entrances.size())];
    intruders.push_back({"", places.below(problem.targets.size()), door.name, door.position, time_s, 0.0});
    intruders.back().settles_s = settling_time(problem, options, intruders.back());
  }
  if (intruders.size() > most_intruders) {
    return bad_input(fmt::format("{:g} 1/s until {:g} s brings more than {} intruders; lower one of them",
                                 options.rate_hz, options.until_s, most_intruders),
                     "arrivals.rate");
  }
  put_in_order(problem, intruders);
  return intruders;
}

void put_in_order(const GuardProblem& problem, std::vector<Intruder>& intruders) {
  std::stable_sort(intruders.begin(), intruders.end(),
                   [](const Intruder& a, const Intruder& b) { return a.enters_s < b.enters_s; });
  std::set<std::string> taken;
  for (const Target& target : problem.targets) taken.insert(target.name);
  std::vector<int> visitors(problem.targets.size(), 0);
  for (Intruder& intruder : intruders) {
    int& visits = visitors[intruder.place];
    const std::string& name = problem.targets[intruder.place].name;
    intruder.name = ++visits == 1 ? name : fmt::format("{}_{}", name, visits);
    while (visits > 1 && taken.contains(intruder.name)) intruder.name = fmt::format("{}_{}", name, ++visits);
  }
}

std::vector<Intruder> settled_intruders(const GuardProblem& problem) {
  std::vector<Intruder> intruders;
  for (std::size_t place = 0; place < problem.targets.size(); ++place) {
    intruders.push_back({problem.targets[place].name, place, {}, xy(problem.targets[place].base), 0.0, 0.0});
  }
  return intruders;
}

ArrivalYard arrival_yard(const GuardProblem& problem, const FiringMap& firing_map,
                         std::vector<Intruder> intruders) {
  ArrivalYard watch{problem, firing_map, std::move(intruders)};
  watch.problem.targets.clear();
  watch.firing_map.regions.clear();
  watch.firing_map.no_shots.clear();
  const auto add = [&](std::size_t place, const std::string& name) {
    watch.problem.targets.push_back(problem.targets[place]);
    watch.problem.targets.back().name = name;
    watch.firing_map.regions.push_back(firing_map.regions[place]);
    watch.firing_map.no_shots.push_back(firing_map.no_shots[place]);
  };
  for (const Intruder& intruder : watch.intruders) add(intruder.place, intruder.name);
  for (std::size_t place = 0; place < problem.targets.size(); ++place) {
    add(place, problem.targets[place].name);
  }
  return watch;
}

Status check_survivors(const GuardProblem& problem, const ArrivalOptions& options) {
  constexpr double least_leave = 0.001;
  if (options.leave < least_leave) {
    return bad_input(fmt::format("with {:g} the mission would not end; give a probability from {:g} to 1",
                                 options.leave, least_leave),
                     "arrivals.leave");
  }
  if (options.may_survive() && problem.targets.size() < 2) {
    return bad_input("who does not leave goes to another target's place, and there is none; list two targets",
                     "arrivals.leave");
  }
  return {};
}

}  // namespace outrider
