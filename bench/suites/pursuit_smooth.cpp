#include "pursuit_smooth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "outrider/pursuit/anytime.hpp"
#include "outrider/pursuit/check.hpp"
#include "rows.hpp"
#include "support/layer_programme.hpp"
#include "support/smooth_pursuit.hpp"

namespace outrider::bench {
namespace {

using testing::SmoothPursuit;
using testing::Walk;

struct BetterCatch {
  std::uint64_t expansions = 0;
  std::uint64_t cost = 0;
  std::uint64_t lower_bound = 0;
};

struct SmoothRow {
  std::string map;
  double programme_s = std::numeric_limits<double>::infinity();
  double proof_s = std::numeric_limits<double>::infinity();
  std::vector<BetterCatch> catches;
  std::string mismatch;
};

/// Maps on which the sweep is taken at once come first, and then those on which the bounds decide.
std::vector<SmoothPursuit> smooth_maps() {
  std::vector<SmoothPursuit> maps;
  for (const auto& [side, seconds] : {std::pair(500, 800), {1000, 1500}, {1500, 1800}})
    maps.push_back({side, seconds, 1, 100, Walk::wander, 1});
  for (const auto& [side, seconds] : {std::pair(500, 1500), {800, 6000}, {1000, 3000}, {1500, 4000}}) {
    maps.push_back({side, seconds, 1, 100, Walk::wander, 2});
    maps.push_back({side, seconds, 40, 100, Walk::round, 3});
    maps.push_back({side, seconds, 40, 100, Walk::late, 4});
  }
  return maps;
}

std::string name_of(const SmoothPursuit& map) {
  const std::string_view walk = map.walk == Walk::wander  ? "wander"
                                : map.walk == Walk::round ? "round"
                                                          : "late";
  return fmt::format("{} {}, {} s", walk, map.side, map.seconds);
}

void measure_search(SmoothRow& row, const PursuitProblem& problem, const BenchObserver& observer) {
  const double begin_s = observer.processor_s();
  AnytimePursuit search(problem);
  row.catches.clear();
  while (!search.proven() && search.improve(Budget{})) {
    const auto& best = search.best();
    if (best && (row.catches.empty() || best->cost < row.catches.back().cost))
      row.catches.push_back({search.counters().expansions, best->cost, search.lower_bound()});
  }
  row.proof_s = std::min(row.proof_s, observer.processor_s() - begin_s);
  if (!search.best()) return;
  if (const auto good = check(*search.best(), problem); !good) row.mismatch = to_string(good.error());
}

/// Measures both twice, in turn, and keeps the shorter times.
SmoothRow measure_smooth(const SmoothPursuit& map, const BenchObserver& observer) {
  const PursuitProblem problem = smooth_pursuit(map);
  SmoothRow row;
  row.map = name_of(map);
  std::optional<std::uint64_t> least;
  for (int turn = 0; turn < 2; ++turn) {
    const double begin_s = observer.processor_s();
    testing::LayerProgramme programme(problem);
    least = programme.least_cost();
    row.programme_s = std::min(row.programme_s, observer.processor_s() - begin_s);
    measure_search(row, problem, observer);
  }
  if (row.catches.empty() || row.catches.back().cost != least) {
    row.mismatch = "the programme has another cost";
  } else if (row.proof_s > 1.1 * row.programme_s + 0.02) {
    row.mismatch = "the programme is faster";
  }
  return row;
}

nlohmann::ordered_json row_json(const SmoothRow& row) {
  nlohmann::ordered_json catches = nlohmann::ordered_json::array();
  for (const BetterCatch& better : row.catches) {
    catches.push_back(
        {{"expansions", better.expansions}, {"cost", better.cost}, {"lower_bound", better.lower_bound}});
  }
  return {{"map", row.map},         {"programme_s", row.programme_s},
          {"proof_s", row.proof_s}, {"ratio_to_programme", row.proof_s / row.programme_s},
          {"catches", catches},     {"mismatch", row.mismatch}};
}

std::string table_text(const std::vector<SmoothRow>& rows) {
  std::string text =
      fmt::format("  {:<22} {:>12} {:>9} {:>6} {:>10} {:>10} {:>8} {:>12}\n", "map", "programme ms",
                  "proof ms", "ratio", "first", "least", "catches", "expansions");
  for (const SmoothRow& row : rows) {
    if (row.catches.empty()) continue;
    text += fmt::format("  {:<22} {:>12.1f} {:>9.1f} {:>6.2f} {:>10} {:>10} {:>8} {:>12}\n", row.map,
                        1e3 * row.programme_s, 1e3 * row.proof_s, row.proof_s / row.programme_s,
                        row.catches.front().cost, row.catches.back().cost, row.catches.size(),
                        row.catches.back().expansions);
  }
  return text;
}

}  // namespace

Outcome<BenchResult> measure_smooth_pursuit(const BenchObserver& observer) {
  const std::vector<SmoothPursuit> maps = smooth_maps();
  begin_steps(observer, maps.size());
  std::vector<SmoothRow> rows;
  for (const SmoothPursuit& map : maps) {
    next_step(observer, name_of(map));
    rows.push_back(measure_smooth(map, observer));
  }
  BenchResult result = result_of(rows);
  for (const SmoothRow& row : rows) {
    if (row.mismatch.empty()) continue;
    result.right = false;
    result.complaints.push_back(fmt::format("{}: {}", row.map, row.mismatch));
  }
  return result;
}

}  // namespace outrider::bench
