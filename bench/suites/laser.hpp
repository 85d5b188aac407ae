// Rows of the suite `slam` for laser logs: the error of the track against the reference, and the mapping
// speed relative to the recorded drive.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider::bench {

struct LaserRow {
  std::string name;
  std::size_t scans = 0;
  std::size_t loops = 0;
  std::optional<double> mean_error_m;
  std::optional<double> rms_error_m;
  double time_s = 0.0;  ///< processor time; shortest of the repetitions
  double max_step_s = 0.0;
  std::optional<double> real_time_factor;
};

Outcome<LaserRow> measure_laser_log(const std::string& path, int repeat,
                                    const std::function<double()>& processor_s);
nlohmann::ordered_json row_json(const LaserRow& row);
std::string table_text(const std::vector<LaserRow>& rows);

}  // namespace outrider::bench
