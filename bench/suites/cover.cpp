// Measures coverage plans of areas of many shapes: proofs, and lengths and times against their lower bounds.
#include <fmt/format.h>

#include <algorithm>

#include "cover_areas.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "rows.hpp"
#include "stopwatch.hpp"

namespace outrider::bench {
namespace {

struct CoverRow {
  std::string kind;
  std::int64_t number = 0;
  std::string method;
  double covered = 0.0;       ///< fraction that is surely covered, of all but the rim
  double area_ratio = 0.0;    ///< length over that of the area at the working width
  double length_ratio = 0.0;  ///< length over the lower bound of any track
  double order_gap = 0.0;     ///< of the time of the order
  double planning_s = 0.0;
  bool complete = true;  ///< no more is left out than may be
  std::string mismatch;
};

CoverRow measure(const CoverKind& kind, std::int64_t number, const CoverProblem& problem) {
  CoverRow row;
  row.kind = kind.name;
  row.number = number;
  const Stopwatch watch;
  const auto plan = find_cover_method("quickest")->plan(problem, {}, {});
  row.planning_s = watch.seconds();
  if (!plan) {
    row.mismatch = to_string(plan.error());
    return row;
  }
  row.method = plan->method;
  const auto proof = prove(*plan, problem);
  if (!proof) {
    row.mismatch = to_string(proof.error());
    return row;
  }
  row.covered = proof->inner_fraction;
  row.area_ratio = plan->sums.length_m * 2.0 * problem.sure_radius_m() / area_of(plan->ground.reach);
  row.length_ratio = plan->sums.length_m / proof->length_bound_m;
  row.order_gap = std::max(0.0, 1.0 - plan->order_bound_s / plan->sums.time_s);
  row.complete = proof->complete;
  // A track that leaves something out may be shorter than every track that covers everything.
  if (row.complete && row.length_ratio < 1.0 - 2.0 * problem.uncovered)
    row.mismatch = "the track is below its lower bound";
  return row;
}

nlohmann::ordered_json row_json(const CoverRow& row) {
  return {{"kind", row.kind},           {"number", row.number},         {"method", row.method},
          {"covered", row.covered},     {"area_ratio", row.area_ratio}, {"length_ratio", row.length_ratio},
          {"order_gap", row.order_gap}, {"planning_s", row.planning_s}, {"mismatch", row.mismatch},
          {"complete", row.complete}};
}

std::string line_of(std::string_view name, const std::vector<CoverRow>& rows) {
  const auto column = [&](double CoverRow::* value) {
    std::vector<double> values;
    for (const CoverRow& row : rows) values.push_back(row.*value);
    return values;
  };
  const auto proven =
      std::ranges::count_if(rows, [](const CoverRow& row) { return row.mismatch.empty() && row.complete; });
  const auto lengths = column(&CoverRow::length_ratio), areas = column(&CoverRow::area_ratio);
  const auto gaps = column(&CoverRow::order_gap);
  return fmt::format(
      "  {:<10} {:>3}/{:<3} {:>9.3f} {:>7.3f} {:>7.3f} {:>7.3f} {:>7.3f} {:>8.1f} {:>7.1f} {:>8.2f}\n", name,
      proven, rows.size(), 100.0 * quantile(column(&CoverRow::covered), 0.0), quantile(areas, 0.5),
      quantile(areas, 1.0), quantile(lengths, 0.5), quantile(lengths, 1.0), 100.0 * quantile(gaps, 0.5),
      100.0 * quantile(gaps, 1.0), quantile(column(&CoverRow::planning_s), 0.5));
}

std::string table_text(const std::vector<CoverRow>& rows) {
  std::string text =
      fmt::format("  {:<10} {:>7} {:>9} {:>15} {:>15} {:>16} {:>8}\n", "area", "proven", "covered %",
                  "/ area med, max", "/ bound med,max", "order gap % m,M", "plan s");
  for (const CoverKind& kind : cover_kinds()) {
    std::vector<CoverRow> of_kind;
    std::ranges::copy_if(rows, std::back_inserter(of_kind),
                         [&](const CoverRow& row) { return row.kind == kind.name; });
    if (!of_kind.empty()) text += line_of(kind.name, of_kind);
  }
  return text + line_of("all", rows);
}

}  // namespace

Outcome<BenchResult> measure_cover(const CoverRequest& request, const BenchObserver& observer) {
  begin_steps(observer, cover_kinds().size() * static_cast<std::size_t>(request.each));
  std::vector<CoverRow> rows;
  for (const CoverKind& kind : cover_kinds()) {
    for (std::int64_t number = 1; number <= request.each; ++number) {
      next_step(observer, fmt::format("{} {}", kind.name, number));
      Rng rng(static_cast<std::uint64_t>(number));
      CoverProblem problem = kind.draw(rng);
      problem.turning_radius_m = request.turning_radius_m;
      problem.reverse = request.reverse;
      if (problem.curves() && problem.transfers) continue;
      rows.push_back(measure(kind, number, problem));
    }
  }
  BenchResult result = result_of(rows);
  for (const CoverRow& row : rows) {
    if (row.mismatch.empty()) continue;
    result.right = false;
    result.complaints.push_back(fmt::format("{} {}: {}", row.kind, row.number, row.mismatch));
  }
  return result;
}

}  // namespace outrider::bench
