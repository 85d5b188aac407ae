#include "outrider/job/write_run.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "outrider/io/files/files.hpp"
#include "outrider/picture/plan_view.hpp"

namespace outrider {

std::string result_text(const Run& run) {
  using Json = nlohmann::ordered_json;
  Json object = run_json<Json>(run.report);
  for (const auto& [name, seconds] : run.report.machine_times) object["metrics"].erase(name);
  for (const Table& table : run.report.tables) {
    for (const std::string& column : table.machine_times)
      for (Json& row : object[table.name]) row[column] = nullptr;
  }
  object.erase("files");
  object["settings"] = Json::object();
  for (const auto& [key, value] : run.report.settings) object["settings"][key] = value;
  return object.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Outcome<WrittenFiles> write_run(Run& run, RunLog& log, const std::string& folder, const MakePage& page) {
  const bool begun = run.report.status != "cancelled" || !run.report.metrics.empty();
  if (folder.empty() || !begun) return WrittenFiles{};
  std::vector<NamedContent> files;
  std::vector<FileToRename> complete;
  WrittenFiles written;
  const auto add = [&](const std::string& what, const std::string& file, std::string text) {
    written.emplace_back(what, folder + "/" + file);
    files.push_back({folder + "/" + file, std::move(text)});
  };
  const std::string result = result_text(run);
  add("result", "run.json", result);
  const auto log_path = log.finish(result);
  if (!log_path) return pass_on(log_path);
  if (!log_path->empty()) {
    complete.push_back({folder + "/run.mcap", *log_path});
    written.emplace_back("log", complete.back().path);
    add("picture", "run.svg", plan_view(run.log));
    if (page) {
      auto file = page(*log_path);
      if (!file) return pass_on(file);
      add("page", file->path, std::move(file->content));
    }
  }
  for (NamedContent& file : run.files) add(file.path, file.path, std::move(file.content));
  if (auto ok = make_folder(folder); !ok) return pass_on(ok);
  std::rotate(files.begin(), files.begin() + 1, files.end());  // run.json comes last: where it is, all are
  if (auto ok = write_files(files, complete); !ok) return pass_on(ok);
  log.release();
  return written;
}

}  // namespace outrider
