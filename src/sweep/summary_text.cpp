#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "outrider/core/text.hpp"
#include "outrider/report/run_json.hpp"
#include "outrider/sweep/summary.hpp"

namespace outrider {
namespace {

using Json = nlohmann::ordered_json;
using Lines = std::vector<std::vector<std::string>>;

constexpr std::size_t most_metrics_shown = 30;
constexpr std::size_t most_points_shown = 40;
constexpr std::size_t most_reasons_shown = 10;
constexpr std::size_t most_reason_bytes = 90;

std::string number_text(double value) { return std::isfinite(value) ? fmt::format("{:.5g}", value) : "?"; }

std::string interval_text(const ConfidenceInterval& interval) {
  return fmt::format("{} to {}", number_text(interval.low), number_text(interval.high));
}

std::string percent_text(const Rate& rate) {
  if (rate.count == 0) return "?";
  return fmt::format("{:.1f} % ({:.1f} to {:.1f})",
                     100.0 * static_cast<double>(rate.hits) / static_cast<double>(rate.count),
                     100.0 * rate.interval.low, 100.0 * rate.interval.high);
}

std::string values_text(const RunsSummary& runs) {
  std::string text;
  for (const auto& [key, value] : runs.values) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, printable(value));
  }
  return text;
}

/// Returns the lines as columns: the first to the left, the others to the right.
std::string aligned(const Lines& lines) {
  std::vector<std::size_t> widths;
  for (const auto& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : lines) {
    text += fmt::format("  {:<{}}", line[0], widths[0]);
    for (std::size_t i = 1; i < line.size(); ++i) text += fmt::format("  {:>{}}", line[i], widths[i]);
    text += '\n';
  }
  return text;
}

std::string metrics_text(const RunsSummary& runs) {
  Lines lines = {{"metric", "runs", "mean", "95 % interval", "5 %", "median", "95 % interval", "95 %"}};
  for (const MetricSummary& metric : runs.metrics) {
    if (metric.count == 0 || lines.size() > most_metrics_shown) continue;
    lines.push_back({metric.name, fmt::format("{}", metric.count), number_text(metric.mean),
                     interval_text(metric.mean_interval), number_text(metric.quantiles[0].value),
                     number_text(metric.quantiles[2].value), interval_text(metric.quantiles[2].interval),
                     number_text(metric.quantiles[4].value)});
  }
  return lines.size() > 1 ? fmt::format("\n{}", aligned(lines)) : std::string();
}

std::string runs_text(const RunsSummary& runs) {
  std::string text =
      fmt::format("{} runs{}{}: {} done\n", runs.done.count, runs.values.empty() ? "" : " with ",
                  values_text(runs), percent_text(runs.done));
  for (const auto& [status, count] : runs.statuses) text += fmt::format("  {:>8} {}\n", count, status);
  return text + metrics_text(runs);
}

std::string points_text(const SweepSummary& summary) {
  Lines lines = {{"point", "runs", "done"}};
  for (const RunsSummary& runs : summary.points) {
    if (lines.size() <= most_points_shown) {
      lines.push_back({values_text(runs), fmt::format("{}", runs.done.count), percent_text(runs.done)});
    }
  }
  return summary.points.empty() ? std::string() : fmt::format("\n{}", aligned(lines));
}

std::string reasons_text(const SweepSummary& summary) {
  std::string text = summary.reasons.empty() ? "" : "\nWhy runs are not done\n";
  for (std::size_t i = 0; i < std::min(summary.reasons.size(), most_reasons_shown); ++i) {
    const ReasonSummary& one = summary.reasons[i];
    text += fmt::format("  {:>8} {}{}{}; run {} is one\n", one.rate.hits, one.status,
                        one.reason.empty() ? "" : ": ", excerpt(one.reason, most_reason_bytes), one.example);
  }
  return text;
}

std::string paired_text(const SweepSummary& summary) {
  const PairedDone& done = summary.paired_done;
  std::string text = fmt::format(
      "\nOf the pairs with the same seed, {} are done on both sides, {} on side a only, {} on side b only, "
      "{} "
      "on neither: p = {:.3g} (McNemar)\n\n",
      done.both, done.only_a, done.only_b, done.neither, done.mcnemar_p);
  Lines lines = {{"b - a", "pairs", "less", "equal", "more", "median", "95 % interval", "p (Wilcoxon)"}};
  for (const PairedSummary& one : summary.paired) {
    if (one.pairs == 0 || lines.size() > most_metrics_shown) continue;
    lines.push_back({one.name, fmt::format("{}", one.pairs), fmt::format("{}", one.less),
                     fmt::format("{}", one.equal), fmt::format("{}", one.more),
                     number_text(one.median_difference), interval_text(one.interval),
                     fmt::format("{:.3g}", one.wilcoxon_p)});
  }
  return text + aligned(lines);
}

Json interval_json(const ConfidenceInterval& interval) {
  return Json::array({number_json<Json>(interval.low), number_json<Json>(interval.high)});
}

Json rate_json(const Rate& rate) {
  Json object = {{"hits", rate.hits}, {"count", rate.count}};
  object["rate"] =
      rate.count == 0 ? Json() : Json(static_cast<double>(rate.hits) / static_cast<double>(rate.count));
  object["interval"] = interval_json(rate.interval);
  return object;
}

Json metric_json(const MetricSummary& metric) {
  Json object = {{"count", metric.count}};
  if (metric.count == 0) return object;
  object["mean"] = number_json<Json>(metric.mean);
  object["mean_interval"] = interval_json(metric.mean_interval);
  object["deviation"] = number_json<Json>(metric.deviation);
  object["low"] = number_json<Json>(metric.low);
  object["high"] = number_json<Json>(metric.high);
  object["quantiles"] = Json::array();
  for (const QuantileSummary& one : metric.quantiles) {
    object["quantiles"].push_back({{"share", one.share},
                                   {"value", number_json<Json>(one.value)},
                                   {"interval", interval_json(one.interval)}});
  }
  return object;
}

Json runs_json(const RunsSummary& runs) {
  Json object = {{"values", Json::object()}, {"done", rate_json(runs.done)}, {"statuses", Json::object()}};
  for (const auto& [key, value] : runs.values) object["values"][key] = value;
  for (const auto& [status, count] : runs.statuses) object["statuses"][status] = count;
  object["metrics"] = Json::object();
  for (const MetricSummary& metric : runs.metrics) object["metrics"][metric.name] = metric_json(metric);
  return object;
}

Json paired_json(const SweepSummary& summary) {
  const PairedDone& done = summary.paired_done;
  Json object = {{"done",
                  {{"both", done.both},
                   {"only_a", done.only_a},
                   {"only_b", done.only_b},
                   {"neither", done.neither},
                   {"mcnemar_p", done.mcnemar_p}}},
                 {"metrics", Json::object()}};
  for (const PairedSummary& one : summary.paired) {
    if (one.pairs == 0) continue;
    object["metrics"][one.name] = {{"pairs", one.pairs},
                                   {"less", one.less},
                                   {"equal", one.equal},
                                   {"more", one.more},
                                   {"median_difference", number_json<Json>(one.median_difference)},
                                   {"interval", interval_json(one.interval)},
                                   {"wilcoxon_p", one.wilcoxon_p}};
  }
  return object;
}

}  // namespace

std::string summary_text(const Sweep& sweep, const SweepSummary& summary) {
  std::string text;
  for (const RunsSummary& runs : summary.sides)
    text += fmt::format("{}{}", text.empty() ? "" : "\n", runs_text(runs));
  text += points_text(summary);
  text += reasons_text(summary);
  if (sweep.sides() == 2) text += paired_text(summary);
  return text;
}

std::string summary_json(const Sweep& sweep, const SweepSummary& summary) {
  Json object = {
      {"job", summary.job}, {"runs", summary.runs}, {"sides", Json::array()}, {"points", Json::array()}};
  for (const RunsSummary& runs : summary.sides) object["sides"].push_back(runs_json(runs));
  for (const RunsSummary& runs : summary.points) object["points"].push_back(runs_json(runs));
  object["reasons"] = Json::array();
  for (const ReasonSummary& one : summary.reasons) {
    object["reasons"].push_back({{"status", one.status},
                                 {"reason", one.reason},
                                 {"runs", rate_json(one.rate)},
                                 {"example", one.example}});
  }
  object["other_reasons"] = summary.other_reasons;
  if (sweep.sides() == 2) object["paired"] = paired_json(summary);
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace outrider
