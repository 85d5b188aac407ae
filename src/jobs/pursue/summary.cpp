#include "summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "outrider/core/text.hpp"

namespace outrider {
namespace {

/// Returns a phrase about the quality of the cost.
std::string verdict(const Report& report) {
  const double cost = metric(report, "cost"), bound = metric(report, "lower_bound");
  if (metric(report, "optimal") == 1.0) return "proven: no catch costs less";
  if (!(bound > 0.0)) return "no bound is known";
  if (metric(report, "caught") == 0.0) return fmt::format("a catch would have cost at least {:.0f}", bound);
  return fmt::format("{:.2f} % above {:.0f}, below which no catch is", 100.0 * (cost / bound - 1.0), bound);
}

std::string times_text(const Report& report) {
  const double planning_s = metric(report, "planning_s"), first_s = metric(report, "first_feasible_s");
  if (std::isnan(planning_s)) return {};
  const std::string first = std::isnan(first_s) ? std::string("no catch was found")
                                                : fmt::format("a first catch after {:.1f} ms", 1e3 * first_s);
  return fmt::format("  planning  {:.1f} ms, {}; {:.0f} MiB\n", 1e3 * planning_s, first,
                     metric(report, "peak_mib"));
}

}  // namespace

std::string pursuit_summary(const Report& report) {
  if (metric(report, "caught") == 0.0) {
    std::string text =
        fmt::format("{}: not caught\n\n  {}\n", printable(report.world_name), printable(report.reason));
    if (std::isfinite(metric(report, "cost"))) {
      text += fmt::format("  paid      {:.0f}; {}\n", metric(report, "cost"), verdict(report));
    }
    return text + times_text(report);
  }
  std::string text = fmt::format("{}: caught in second {:.0f} for {:.0f}\n\n", printable(report.world_name),
                                 metric(report, "catch_time_s"), metric(report, "cost"));
  text += fmt::format("  cost      {:.0f}; {}\n", metric(report, "cost"), verdict(report));
  text += fmt::format("  moves     {:.0f}, and {:.0f} s of waiting\n", metric(report, "moves"),
                      metric(report, "catch_time_s") - metric(report, "moves"));
  if (metric(report, "earliest_catch_s") >= 0.0) {
    text += fmt::format("  earliest  second {:.0f} is the first in which a catch is possible\n",
                        metric(report, "earliest_catch_s"));
  }
  if (metric(report, "robots") > 1.0) {
    text += fmt::format("  team      robot {:.0f} of {:.0f} made the catch, {:.0f} handovers\n",
                        metric(report, "catcher"), metric(report, "robots"), metric(report, "handovers"));
  }
  return text + times_text(report);
}

}  // namespace outrider
