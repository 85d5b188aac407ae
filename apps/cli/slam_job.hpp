// What the kinds of input of `outrider slam` share: the request, and how its report begins and is written.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "live_report.hpp"
#include "output.hpp"
#include "outrider/jobs/slam/scenario.hpp"

namespace outrider::cli {

struct SlamJob {
  SlamScenario scenario;
  std::string scenario_path;
  std::string log;     ///< named before all flags
  std::string resume;  ///< state of an earlier run to continue from
  std::string out;
  bool json = false;
  bool html = false;
  bool chose_gate = false;  ///< flag or file named it
  bool chose_patience = false;
};

OptionGroup describe_output(SlamJob& job);

/// A number, or null.
nlohmann::ordered_json known(const std::optional<double>& value);

/// A report of the job before anything has happened.
Report opened(const SlamJob& job);

/// Puts the numbers of the result into the report, before the metrics that are there; times of the machine
/// apart.
void add_metrics(Report& report, const nlohmann::ordered_json& result);

/// Writes the report, with --html the page that plays it, and the other files, where --out asks for them;
/// the path of the report, or nothing.
Outcome<std::string> write_report(const SlamJob& job, Report& report, std::vector<NamedText> files);

}  // namespace outrider::cli
