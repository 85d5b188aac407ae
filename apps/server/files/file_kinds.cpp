#include "files/file_kinds.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "files/head_comment.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/job/run_job.hpp"

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& path) {
  fs::path name = path;
  if (name.extension() == ".gz") name.replace_extension();
  std::string extension = name.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

/// Returns the job that run.json names in its first keys; empty for other JSON.
std::string job_of_result(const std::string& head) {
  if (head.find("\"status\"") == std::string::npos) return {};
  std::size_t at = head.find("\"job\"");
  if (at == std::string::npos) return {};
  at = head.find('"', head.find(':', at));
  if (at == std::string::npos) return {};
  return head.substr(at + 1, head.find('"', at + 1) - at - 1);
}

bool has_key(const std::string& yaml, const std::string& key) {
  return yaml.starts_with(key + ":") || yaml.find("\n" + key + ":") != std::string::npos;
}

/// Returns the value of the key `seed` of a scenario; nothing if it has none that is a number.
std::optional<std::int64_t> seed_of(const std::string& yaml) {
  static constexpr std::string_view key = "seed:";
  std::size_t at = yaml.starts_with(key) ? 0 : yaml.find("\nseed:");
  if (at == std::string::npos) return std::nullopt;
  at = yaml.find_first_not_of(" \t", yaml.find(':', at) + 1);
  std::int64_t seed = 0;
  if (at == std::string::npos) return std::nullopt;
  const auto [end, error] = std::from_chars(yaml.data() + at, yaml.data() + yaml.size(), seed);
  const bool whole =
      end == yaml.data() + yaml.size() || std::string_view(" \t\r\n").find(*end) != std::string_view::npos;
  return error == std::errc{} && whole && seed >= 0 ? std::optional(seed) : std::nullopt;
}

Json yaml_kind(const std::string& path, const Folder& folder) {
  const auto text = folder.text(path, largest_saved_bytes);
  if (!text) return {{"kind", "other"}};
  if (has_key(text->substr(0, 4000), "image")) return {{"kind", "map"}};
  const auto job = scenario_job_from_text(*text, path);
  if (!job || job->empty()) return {{"kind", "other"}};
  Json kind = {{"kind", "scenario"}, {"job", *job}};
  if (std::string comment = head_comment(*text); !comment.empty()) kind["description"] = std::move(comment);
  return kind;
}

}  // namespace

bool is_parsed(const std::string& path) {
  const std::string extension = lower_extension(path);
  return extension == ".yaml" || extension == ".yml";
}

Json file_kind(const std::string& path, const Folder& folder) {
  const std::string extension = lower_extension(path);
  const auto head = [&](std::size_t bytes) {
    const auto file = OpenFile::in(folder.gate(), path);
    return file ? file->part(0, bytes) : std::string();
  };
  if (extension == ".mcap") return {{"kind", "log"}};
  if (is_parsed(path)) return yaml_kind(path, folder);
  if (fs::path(path).filename() == "run.json") {
    const std::string job = job_of_result(head(400));
    return job.empty() ? Json{{"kind", "other"}} : Json{{"kind", "result"}, {"job", job}};
  }
  for (const char* map : {".map", ".sdf", ".world", ".png", ".pgm"}) {
    if (extension == map) return {{"kind", "map"}};
  }
  const bool polygons = extension == ".txt" && head(65536).find("---") != std::string::npos;
  return {{"kind", polygons ? "map" : "other"}};
}

Outcome<Json> scenario_head(const std::string& text, const std::string& name, const std::vector<Job>& jobs) {
  const auto job = job_of_scenario_text(jobs, text, name);
  if (!job) return pass_on(job);
  const auto seed = seed_of(text);
  return Json{{"job", job->name}, {"seed", seed ? Json(*seed) : Json()}};
}

}  // namespace outrider::server
