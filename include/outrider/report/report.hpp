// Report: the result of a run: status, metrics, tables and settings. run.json is its text. The events of the
// run are in its log.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/report/table.hpp"

namespace outrider {

/// The result of a run.
struct Report {
  std::string status;      ///< "done", "not_done", "doubtful", "unconfirmed" or "cancelled"
  std::string job;         ///< "guard", ...
  std::string reason;      ///< why it is not done; empty when it is
  std::string world_name;  ///< name of the world, the map or the log
  std::vector<std::pair<std::string, std::string>> settings;  ///< option name -> value with unit
  std::vector<std::string> warnings;                    ///< what was repaired or is uncertain in the input
  std::vector<std::pair<std::string, double>> metrics;  ///< in display order
  /// Processing times by name. They are displayed and never stored, because they differ from run to run.
  std::vector<std::pair<std::string, double>> machine_times = {};
  std::vector<Table> tables = {};  ///< such as what became of each target
};

/// Returns the metric or processing time of that name, or `otherwise` if the report has none. O(metrics).
inline double metric(const Report& report, std::string_view name,
                     double otherwise = std::numeric_limits<double>::quiet_NaN()) {
  for (const auto* list : {&report.metrics, &report.machine_times}) {
    for (const auto& [key, value] : *list) {
      if (key == name) return value;
    }
  }
  return otherwise;
}

/// Returns the value of a setting as text; empty if the report has none of that name.
inline std::string setting(const Report& report, std::string_view name) {
  for (const auto& [key, value] : report.settings) {
    if (key == name) return value;
  }
  return {};
}

/// Returns the table of that name; an empty one if the report has none.
inline const Table& table_named(const Report& report, std::string_view name) {
  static const Table none;
  for (const Table& table : report.tables) {
    if (table.name == name) return table;
  }
  return none;
}

}  // namespace outrider
