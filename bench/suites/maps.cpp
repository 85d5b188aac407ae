// Drives on known maps, around things, people and closed doors that the maps lack, judged by the truth
// (known_maps.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "goal_drive.hpp"
#include "known_maps.hpp"
#include "outrider/core/parallel.hpp"
#include "outrider/core/rng.hpp"
#include "rows.hpp"

namespace outrider::bench {
namespace {

constexpr double within_m = 0.2;
constexpr double false_m = 0.4;                                // from the goal, beyond which a claim is false
constexpr double longest_first_s = 300.0, longest_part = 5.0;  // of the least time

/// The end of a drive, by the truth.
enum class End { done, false_done, contact, no_way, wrong_reason, maybe, lost, late };
constexpr std::string_view end_names[] = {"done",         "false done", "contact", "no way",
                                          "wrong reason", "maybe",      "lost",    "late"};

struct MapDrive {
  MapCase what;
  GoalRun run;
  End end = End::late;
  double bound_s = 0.0;
};

struct DrivenMap {
  std::string map;
  std::int64_t goals = 0;
  std::int64_t count[std::size(end_names)] = {};
  std::int64_t walked_into = 0;
  double time_ratio = 0.0;  ///< median of those that are done from a known start
  std::int64_t unknown = 0, located = 0;
  double located_m = 0.0;  ///< median
  std::vector<std::string> failed;
};

std::int64_t count_of(const DrivenMap& row, End end) { return row.count[static_cast<std::size_t>(end)]; }

nlohmann::ordered_json row_json(const DrivenMap& row) {
  return {{"map", row.map},
          {"goals", row.goals},
          {"done", count_of(row, End::done)},
          {"no_way", count_of(row, End::no_way)},
          {"maybe", count_of(row, End::maybe)},
          {"wrong_reason", count_of(row, End::wrong_reason)},
          {"lost", count_of(row, End::lost)},
          {"late", count_of(row, End::late)},
          {"contacts", count_of(row, End::contact)},
          {"false_done", count_of(row, End::false_done)},
          {"walked_into", row.walked_into},
          {"time_ratio", row.time_ratio},
          {"start_unknown", row.unknown},
          {"located", row.located},
          {"located_m", row.located_m},
          {"failed", row.failed}};
}

std::string table_text(const std::vector<DrivenMap>& rows) {
  std::string text = fmt::format(
      "{:28} goals done no way maybe wrong lost late contact false walked in "
      "time/bound located   m\n",
      "map");
  for (const DrivenMap& row : rows) {
    text +=
        fmt::format("{:28} {:5} {:4} {:6} {:5} {:5} {:4} {:4} {:7} {:5} {:9} {:10.2f} {:3}/{:<3} {:5.1f}\n",
                    row.map, row.goals, count_of(row, End::done), count_of(row, End::no_way),
                    count_of(row, End::maybe), count_of(row, End::wrong_reason), count_of(row, End::lost),
                    count_of(row, End::late), count_of(row, End::contact), count_of(row, End::false_done),
                    row.walked_into, row.time_ratio, row.located, row.unknown, row.located_m);
  }
  return text;
}

/// A robot of the size of a small delivery robot, at 0.8 m/s.
NavigatorSetup small_robot(const BenchMap& map) {
  NavigatorSetup setup;
  setup.robot.speed_mps = 0.8;
  setup.robot.acceleration_mps2 = 1.5;
  setup.robot.turn_rate_radps = 1.5;
  setup.footprint = Footprint({{{-0.14, -0.1}, {0.14, -0.1}, {0.14, 0.1}, {-0.14, 0.1}}, 0.0});
  setup.robot.radius_m = setup.footprint.outer_m();
  setup.known = KnownMap{map.occupancy};
  return setup;
}

End judged(const MapCase& what, const GoalRun& run) {
  if (run.touched) return End::contact;
  if (run.claims) return run.done ? End::done : End::false_done;
  if (run.lost) return End::lost;
  if (run.why.empty()) return End::late;
  if (what.surely_none) return End::no_way;
  return what.surely_a_way ? End::wrong_reason : End::maybe;
}

MapDrive drive(const BenchMap& map, MapCase what, std::uint64_t number) {
  const NavigatorSetup setup = small_robot(map);
  ExplorerSimParams devices;
  devices.laser.rate_hz = 10.0;
  devices.laser.most_m = 8.0;
  devices.footprint = setup.footprint;
  devices.faults.walk_ins.people = what.people;
  devices.faults.walk_ins.people_mps = 0.5;
  MapDrive made;
  made.what = std::move(what);
  made.bound_s = made.what.way_m / setup.robot.speed_mps;
  GoalDrive drive{made.what.world, made.what.start, made.what.goal, setup, devices};
  drive.aimed_m = within_m;
  drive.reached_m = false_m;
  drive.limit_s = longest_first_s + longest_part * made.bound_s;
  drive.set_off_m = 0.0;
  drive.start_unknown = made.what.start_unknown;
  made.run = run(drive, Rng(number).child(map.name).child("drive").bits());
  made.end = judged(made.what, made.run);
  return made;
}

DrivenMap row_of(const BenchMap& map, const std::vector<std::optional<MapDrive>>& drives) {
  DrivenMap row;
  row.map = map.name;
  std::vector<double> ratios, located_m;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (!drives[i]) continue;
    const MapDrive& one = *drives[i];
    ++row.goals;
    ++row.count[static_cast<std::size_t>(one.end)];
    row.walked_into += one.run.walked_into;
    if (one.end == End::done && !one.what.start_unknown) ratios.push_back(one.run.time_s / one.bound_s);
    row.unknown += one.what.start_unknown;
    if (one.what.start_unknown && one.run.located_m >= 0.0) {
      ++row.located;
      located_m.push_back(one.run.located_m);
    }
    if (one.end == End::done || one.end == End::no_way) continue;
    row.failed.push_back(fmt::format("goal {}: {}{}{}", i + 1, end_names[static_cast<std::size_t>(one.end)],
                                     one.run.why.empty() ? "" : ": ", one.run.why));
  }
  row.time_ratio = quantile(ratios, 0.5);
  row.located_m = quantile(located_m, 0.5);
  return row;
}

}  // namespace

Outcome<BenchResult> measure_maps(const MapsRequest& request, const BenchObserver& observer) {
  auto maps = known_maps(request.files, request.data);
  if (!maps) return pass_on(maps);
  if (!request.maps.empty())
    std::erase_if(*maps,
                  [&](const BenchMap& map) { return std::ranges::count(request.maps, map.name) == 0; });
  if (maps->empty()) return bad_input("none of the maps has such a name", "--maps");
  begin_steps(observer, maps->size());
  BenchResult result;
  std::vector<DrivenMap> rows;
  for (const BenchMap& map : *maps) {
    next_step(observer, map.name);
    std::vector<std::optional<MapDrive>> drives(static_cast<std::size_t>(request.goals));
    const Footprint footprint = small_robot(map).footprint;
    parallel_for(drives.size(), [&](std::size_t i) {
      if (auto what = draw_case(map, footprint, i + 1)) drives[i] = drive(map, std::move(*what), i + 1);
    });
    rows.push_back(row_of(map, drives));
  }
  return result_of(rows);
}

}  // namespace outrider::bench
