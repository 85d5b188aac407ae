#include "laser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "outrider/io/files/files.hpp"
#include "outrider/jobs/slam/laser/laser_run.hpp"
#include "outrider/jobs/slam/scenario.hpp"

namespace outrider::bench {
namespace {

nlohmann::ordered_json known(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::string column(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

}  // namespace

Outcome<LaserRow> measure_laser_log(const std::string& path, int repeat,
                                    const std::function<double()>& processor_s) {
  const auto text = read_file(path);
  if (!text) return pass_on(text);
  const auto log = laser_log_from_carmen({*text, path}, {});
  if (!log) return pass_on(log);
  const std::string name = std::filesystem::path(path).filename().string();
  LaserRow row;
  row.name = name.substr(0, name.find(".log"));
  row.scans = log->steps.size();
  row.time_s = row.max_step_s = HUGE_VAL;
  for (int i = 0; i < repeat; ++i) {
    const auto run = run_laser_log(*log, laser_options_for_logs(), {}, processor_s);
    if (!run) return bad_input(run.error().sentence, path);
    row.loops = run->slam.loops();
    row.mean_error_m = run->mean_error_m;
    row.rms_error_m = run->rms_error_m;
    row.time_s = std::min(row.time_s, run->time_s);
    row.max_step_s = std::min(row.max_step_s, run->max_step_s);
    if (run->log_s && row.time_s > 0.0) row.real_time_factor = *run->log_s / row.time_s;
  }
  return row;
}

nlohmann::ordered_json row_json(const LaserRow& row) {
  return {{"log", row.name},
          {"scans", row.scans},
          {"loops", row.loops},
          {"mean_absolute_error_m", known(row.mean_error_m)},
          {"ate_m", known(row.rms_error_m)},
          {"time_s", row.time_s},
          {"max_step_s", row.max_step_s},
          {"real_time_factor", known(row.real_time_factor)}};
}

std::string table_text(const std::vector<LaserRow>& rows) {
  std::string text = fmt::format("  {:<24} {:>6} {:>6} {:>12} {:>8} {:>9} {:>11} {:>10}\n", "laser log",
                                 "scans", "loops", "mean error m", "rms m", "s", "max step s", "real time");
  for (const LaserRow& row : rows) {
    text += fmt::format("  {:<24} {:>6} {:>6} {:>12} {:>8} {:>9.3f} {:>11.4f} {:>10}\n", row.name, row.scans,
                        row.loops, column(row.mean_error_m, 4), column(row.rms_error_m, 4), row.time_s,
                        row.max_step_s, row.real_time_factor ? column(row.real_time_factor, 0) + "x" : "-");
  }
  return text;
}

}  // namespace outrider::bench
