#include "slam_job.hpp"

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "outrider/report/slam_record.hpp"
#include "page.hpp"
#include "scenario_words.hpp"

namespace outrider::cli {
namespace {

bool is_machine_time(std::string_view name) {
  return name == "time_s" || name == "max_step_s" || name == "median_step_s" || name == "real_time_factor";
}

}  // namespace

OptionGroup describe_output(SlamJob& job) {
  return {"",
          "output",
          {{"json", "", 0, 0, "print one JSON object on standard output", &job.json},
           {"out", "", 0, 0, "folder for the report, the map, the track, the state and a picture", &job.out},
           {"html", "", 0, 0, "write slam.html as well, a page that plays the mapping", &job.html}}};
}

nlohmann::ordered_json known(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

Report opened(const SlamJob& job) {
  Report report;
  report.job = "slam";
  report.status = "done";
  const std::string name = std::filesystem::path(job.scenario.log).filename().string();
  report.world_name = name.substr(0, name.find('.'));
  report.robot_radius_m = std::numeric_limits<double>::quiet_NaN();
  SlamScenario scenario = job.scenario;
  report.settings = settings_of(describe(scenario));
  return report;
}

void add_metrics(Report& report, const nlohmann::ordered_json& result) {
  std::vector<std::pair<std::string, double>> metrics;
  for (const auto& [name, value] : result.items()) {
    if (!value.is_number()) continue;
    (is_machine_time(name) ? report.machine_times : metrics).emplace_back(name, value.get<double>());
  }
  report.metrics.insert(report.metrics.begin(), metrics.begin(), metrics.end());
}

Outcome<std::string> write_report(const SlamJob& job, Report& report, std::vector<NamedText> files) {
  if (job.out.empty()) return std::string{};
  report.bounds = bounds_of(report);
  const std::string text = to_json(report);
  files.insert(files.begin(), {"slam.json", text});
  if (job.html) {
    auto stored = report_from_json(text);
    if (!stored) return pass_on(stored);
    files.emplace_back("slam.html", to_html(*stored, page::viewer()));
  }
  if (auto ok = write_files(job.out, files); !ok) return pass_on(ok);
  return job.out + "/slam.json";
}

}  // namespace outrider::cli
