// Drives among things and people that move, with each rule of motion (hall_worlds.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "goal_drive.hpp"
#include "hall_worlds.hpp"
#include "outrider/core/parallel.hpp"
#include "outrider/core/rng.hpp"
#include "rows.hpp"

namespace outrider::bench {
namespace {

constexpr double longest_s = 120.0;

/// A drive, and the same through the world without anybody.
struct HallRun {
  GoalRun met;
  double empty_s = 0.0;
};

/// The runs of one rule in worlds of one kind.
struct HallRow {
  std::string walkers, rule;
  std::int64_t runs = 0, done = 0, contacts = 0, walked_into = 0, gave_up = 0, late = 0;
  double time_ratio = 0.0;          ///< median
  double worst_time_ratio = 0.0;    ///< at most so in nine of ten runs
  std::vector<std::string> failed;  ///< world and seed
};

nlohmann::ordered_json row_json(const HallRow& row) {
  return {{"walkers", row.walkers},
          {"rule", row.rule},
          {"runs", row.runs},
          {"success", static_cast<double>(row.done) / static_cast<double>(row.runs)},
          {"contacts", row.contacts},
          {"walked_into", row.walked_into},
          {"gave_up", row.gave_up},
          {"late", row.late},
          {"time_ratio", row.time_ratio},
          {"time_ratio_90", row.worst_time_ratio},
          {"failed", row.failed}};
}

std::string table_text(const std::vector<HallRow>& rows) {
  std::string text =
      "walkers      rule      runs  success  contacts  walked into  gave up  late  time/empty  90 %\n";
  for (const HallRow& row : rows) {
    text += fmt::format("{:12} {:9} {:4}  {:5.1f} %  {:8}  {:11}  {:7}  {:4}  {:10.2f}  {:4.2f}\n",
                        row.walkers, row.rule, row.runs,
                        100.0 * static_cast<double>(row.done) / static_cast<double>(row.runs), row.contacts,
                        row.walked_into, row.gave_up, row.late, row.time_ratio, row.worst_time_ratio);
  }
  return text;
}

HallRun drive(const HallWorld& hall, const std::string& rule, std::uint64_t seed) {
  NavigatorSetup setup = jackal(rule);
  setup.robot.speed_mps = hall.speed_mps;
  ExplorerSimParams devices = jackal_devices(setup);
  GoalDrive drive{hall.world, hall.start, hall.goal, setup, devices};
  drive.limit_s = longest_s;
  drive.aimed_m = 0.3;
  drive.reached_m = 1.0;
  HallRun made;
  made.empty_s = run(drive, seed).time_s;
  devices.faults.walk_ins = hall.walkers;
  made.met = run(drive, seed);
  return made;
}

HallRow row_of(const HallKind& kind, const std::string& rule, const std::vector<HallRun>& runs) {
  HallRow row;
  row.walkers = kind.name;
  row.rule = rule;
  row.runs = static_cast<std::int64_t>(runs.size());
  std::vector<double> ratios;
  for (const HallRun& run : runs) {
    row.done += run.met.done;
    row.contacts += run.met.touched;
    row.walked_into += run.met.walked_into;
    const bool gave_up = !run.met.done && !run.met.touched && !run.met.why.empty();
    row.gave_up += gave_up;
    row.late += !run.met.done && !run.met.touched && !gave_up;
    if (run.met.done) ratios.push_back(run.met.time_s / run.empty_s);
  }
  row.time_ratio = quantile(ratios, 0.5);
  row.worst_time_ratio = quantile(ratios, 0.9);
  return row;
}

/// Returns the numbers of the worlds of a kind that were asked for.
Outcome<std::vector<std::int64_t>> hall_numbers(const HallKind& kind, const std::vector<std::string>& asked) {
  std::vector<std::int64_t> numbers;
  for (std::int64_t number = 1; asked.empty() && number <= kind.worlds; ++number) numbers.push_back(number);
  for (const std::string& text : asked) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 1 || number > kind.worlds)
      return bad_input(
          fmt::format("'{}' is no world of {}; expected numbers from 1 to {}", text, kind.name, kind.worlds),
          "--worlds");
    numbers.push_back(number);
  }
  return numbers;
}

HallRow measure_hall(const HallKind& kind, const std::vector<std::int64_t>& numbers, const std::string& rule,
                     std::int64_t most_seeds) {
  std::vector<HallWorld> worlds;
  for (const std::int64_t number : numbers) worlds.push_back(kind.draw(number));
  const auto seeds = static_cast<std::size_t>(most_seeds);
  std::vector<HallRun> runs(worlds.size() * seeds);
  parallel_for(runs.size(), [&](std::size_t i) {
    const auto number = static_cast<std::uint64_t>(numbers[i / seeds]);
    runs[i] = drive(worlds[i / seeds], rule, Rng(i % seeds + 1).child(number).bits());
  });
  HallRow row = row_of(kind, rule, runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const GoalRun& met = runs[i].met;
    if (met.done) continue;
    row.failed.push_back(fmt::format("world {} seed {}: {}", numbers[i / seeds], i % seeds + 1,
                                     met.touched       ? "contact"
                                     : met.why.empty() ? "late"
                                                       : met.why));
  }
  return row;
}

}  // namespace

Outcome<BenchResult> measure_halls(const HallsRequest& request, const BenchObserver& observer) {
  if (auto ok = check_rules(request.rules); !ok) return pass_on(ok);
  std::vector<std::pair<HallKind, std::vector<std::int64_t>>> asked;
  for (const std::string& walkers : request.walkers) {
    auto kind = find_row(hall_kinds(), "kind of walkers", walkers, "--walkers");
    if (!kind) return pass_on(kind);
    auto numbers = hall_numbers(*kind, request.worlds);
    if (!numbers) return pass_on(numbers);
    asked.emplace_back(*kind, std::move(*numbers));
  }
  begin_steps(observer, asked.size() * request.rules.size());
  std::vector<HallRow> rows;
  for (const auto& [kind, numbers] : asked) {
    for (const std::string& rule : request.rules) {
      next_step(observer, fmt::format("{} {}", kind.name, rule));
      rows.push_back(measure_hall(kind, numbers, rule, request.seeds));
    }
  }
  return result_of(rows);
}

}  // namespace outrider::bench
