// Rows of `bench slam` for laser logs: how far from the reference, and how much faster than the robot drove.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider::cli {

struct LaserRow {
  std::string name;
  std::size_t scans = 0;
  std::size_t loops = 0;
  std::optional<double> mean_error_m;
  std::optional<double> rms_error_m;
  double time_s = 0.0;  ///< of the processor; the least of the repeats
  double max_step_s = 0.0;
  std::optional<double> real_time_factor;
};

Outcome<LaserRow> measure_laser_log(const std::string& path, int repeat);
nlohmann::ordered_json row_json(const LaserRow& row);
void print_table(const std::vector<LaserRow>& rows);

}  // namespace outrider::cli
