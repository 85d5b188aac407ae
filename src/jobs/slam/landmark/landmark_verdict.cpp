#include "landmark/landmark_verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/log/append.hpp"

namespace outrider {
namespace {

/// Returns what speaks against the map in the numbers of the run.
std::vector<std::string> doubts_of_numbers(const LandmarkSlamOptions& options, const LandmarkMission& run,
                                           const SystematicErrors& size) {
  constexpr double most_refused = 0.05, most_chi2_per_dof = 4.0;
  constexpr int most_contradicted = 1, most_misfits = 2;  // one landmark may have been moved
  std::vector<std::string> doubts;
  if (run.lost > 0) {
    doubts.push_back(fmt::format("the robot was lost in {} of {} steps", run.lost, run.times_s.size() - 1));
  }
  const int sightings = run.used + run.refused;
  if (run.refused > most_refused * sightings) {
    doubts.push_back(fmt::format("{} of {} sightings of the map contradict it", run.refused, sightings));
  }
  if (run.contradicted > most_contradicted || run.misfits > most_misfits) {
    doubts.push_back(
        fmt::format("{} landmarks were given up because their sightings contradict the map, and at up to {} "
                    "steps in a row no sighting fitted: was the robot moved, or were they?",
                    run.contradicted, run.misfits));
  }
  const double ratio = chi2_per_dof(run.slam);
  if (const std::string why = why_not_believed(size); !why.empty()) doubts.push_back(why);
  if (options.kernel == "none" && ratio > most_chi2_per_dof) {
    doubts.push_back(
        fmt::format("errors are {:.1f} times as large as the noise options say", std::sqrt(ratio)));
  }
  return doubts;
}

/// A landmark that was moved too far.
struct Doubted {
  MovedLandmark moved;
  double since_s = 0.0;
  Vec2 place;
};

std::vector<Doubted> doubted_landmarks(const LandmarkMission& run, const std::vector<double>& times_s) {
  const LandmarkMap map = run.slam.landmarks();
  std::vector<Doubted> result;
  for (const MovedLandmark& one : run.check.judge(map)) {
    const auto found = std::ranges::find(map, one.id, &LandmarkEstimate::id);
    result.push_back({one, times_s[one.step], found->position});
  }
  return result;
}

std::string moved_text(const Doubted& one) {
  return fmt::format(
      "landmark {} at x {:.2f} m, y {:.2f} m by {:.2f} m since {:.1f} s, {:.0f} times its "
      "standard deviation",
      one.moved.id, one.place.x, one.place.y, one.moved.moved_m, one.since_s,
      one.moved.moved_m / one.moved.sd_m);
}

std::string reason_text(const std::vector<Doubted>& doubted, std::size_t landmarks) {
  const Doubted& worst = *std::ranges::max_element(
      doubted, {}, [](const Doubted& one) { return one.moved.moved_m / one.moved.sd_m; });
  return fmt::format(
      "sightings moved {} of {} landmarks farther than the filter allows, so landmarks were taken for one "
      "another and some may be in the map twice: {}",
      doubted.size(), landmarks, moved_text(worst));
}

void add_table(Report& report, Log& log, const std::vector<Doubted>& doubted, double end_s) {
  Table table{"doubts", {"what", "landmark", "time_s", "x", "y", "moved_m", "sd_m"}, {}};
  for (const Doubted& one : doubted) {
    table.rows.push_back({"moved too far", static_cast<double>(one.moved.id), one.since_s, one.place.x,
                          one.place.y, one.moved.moved_m, one.moved.sd_m});
    log_event(log, end_s, "doubt", "moved " + moved_text(one));
  }
  report.tables.push_back(std::move(table));
}

}  // namespace

double chi2_per_dof(const LandmarkSlam& slam) {
  const auto freedom = static_cast<double>(slam.degrees_of_freedom());
  return freedom > 0.0 ? slam.cost() / freedom : std::numeric_limits<double>::quiet_NaN();
}

void judge_landmarks(Report& report, Log& log, const LandmarkSlamOptions& options, const LandmarkMission& run,
                     const SystematicErrors& size, const std::vector<double>& times_s) {
  std::vector<std::string> doubts = doubts_of_numbers(options, run, size);
  if (options.unknown_ids && !times_s.empty()) {
    const std::vector<Doubted> doubted = doubted_landmarks(run, times_s);
    report.metrics.emplace_back("landmarks_moved", static_cast<double>(doubted.size()));
    if (!doubted.empty()) {
      doubts.push_back(reason_text(doubted, run.slam.landmarks().size()));
      add_table(report, log, doubted, times_s.back());
    }
  }
  if (doubts.empty()) return;
  report.status = "doubtful";
  report.reason = fmt::format("{}", fmt::join(doubts, "; "));
}

}  // namespace outrider
