#include "outrider/sweep/manifest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "build_id.hpp"
#include "outrider/core/json_excess.hpp"
#include "outrider/core/sha256.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/read_record.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/sweep/canary.hpp"

namespace outrider {
namespace {

using Json = nlohmann::ordered_json;
using Pairs = std::vector<std::pair<std::string, std::string>>;

constexpr int format_number = 1;
constexpr std::uint64_t most_tries = 10;  // runs of which one must load

Status load_once(const Sweep& sweep, const Changes& changes) {
  const auto task = sweep.job.blank();
  if (auto ok = read_scenario(*task, sweep.request.scenario); !ok) return ok;
  if (auto ok = change(*task, changes); !ok) return ok;
  if (auto loaded = task->load(); !loaded && !is_answer(loaded.error())) return pass_on(loaded);
  return {};
}

bool names_file(const Sweep& sweep, const std::string& key) {
  const auto task = sweep.job.blank();
  for (const OptionGroup& group : task->options()) {
    for (const Option& option : group.options) {
      if (key_of(group, option) == key) return option.names_file;
    }
  }
  return false;
}

/// Loads runs, so that the files they read are noted.
Status load_samples(const Sweep& sweep) {
  Status first;
  Changes loaded;
  for (std::uint64_t i = 0; i < std::min(sweep.total, most_tries); ++i) {
    loaded = changes_of(sweep, run_of(sweep, i));
    auto ok = load_once(sweep, loaded);
    if (i == 0) first = ok;
    if (ok) break;
    if (i + 1 == std::min(sweep.total, most_tries)) return first;  // drawn values may be refused, not all
  }
  for (const auto* list : {&sweep.varied, &sweep.compared}) {
    for (const Varied& varied : *list) {
      if (!names_file(sweep, varied.key)) continue;
      for (const std::string& value : extreme_values(varied)) {
        Changes other = loaded;
        std::ranges::find(other, varied.key, &Changes::value_type::first)->second = value;
        if (auto ok = load_once(sweep, other); !ok) return ok;
      }
    }
  }
  return {};
}

/// Returns what the manifests hold as texts by name, in the order in which they are compared.
Pairs facts(const Manifest& manifest) {
  const SweepRequest& request = manifest.request;
  return {{"the version of Outrider", manifest.version},
          {"the build of Outrider", manifest.build},
          {"the job", manifest.job},
          {"the scenario", manifest.scenario_hash},
          {"--runs", fmt::format("{}", request.runs)},
          {"--seed", fmt::format("{}", request.seed)},
          {"--vary", fmt::format("{}", fmt::join(request.vary, " "))},
          {"--compare", fmt::format("{}", fmt::join(request.compare, " "))},
          {"--chunk-runs", fmt::format("{}", request.chunk_runs)}};
}

/// Refuses other numbers than those of requests: conversions would wrap or round them.
Status check_counts(const Json& manifest, const std::string& name) {
  const std::tuple<const char*, std::uint64_t, std::uint64_t> counts[] = {
      {"runs", 1, most_sweep_runs}, {"seed", 0, most_seed}, {"chunk_runs", 1, most_chunk_runs}};
  for (const auto& [key, low, high] : counts) {
    const Json& value = manifest.at(key);
    if (value.is_number_unsigned() && value >= low && value <= high) continue;
    return bad_input(fmt::format("{} '{}' is not valid; expected a whole number from {} to {}; restore the "
                                 "file, or name another folder",
                                 key, value.is_number() ? value.dump() : value.type_name(), low, high),
                     name);
  }
  return {};
}

Json object_of(const Pairs& pairs) {
  Json object = Json::object();
  for (const auto& [name, value] : pairs) object[name] = value;
  return object;
}

Pairs pairs_of(const Json& object) {
  Pairs pairs;
  for (const auto& [name, value] : object.items()) pairs.emplace_back(name, value.get<std::string>());
  return pairs;
}

/// Returns the names whose values differ, or which one side lacks.
std::vector<std::string> differences(const Pairs& a, const Pairs& b) {
  std::map<std::string, std::string> rest(b.begin(), b.end());
  std::vector<std::string> names;
  for (const auto& [name, value] : a) {
    const auto found = rest.find(name);
    if (found == rest.end() || found->second != value) names.push_back(name);
    if (found != rest.end()) rest.erase(found);
  }
  for (const auto& [name, value] : rest) names.push_back(name);
  return names;
}

}  // namespace

Outcome<Manifest> make_manifest(const Sweep& sweep, const std::string& version) {
  Manifest manifest{.request = sweep.request,
                    .job = std::string(sweep.job.name),
                    .version = version,
                    .build = build_id(),
                    .scenario_hash = {}};
  auto hash = file_hash(sweep.request.scenario);
  if (!hash) return pass_on(hash);
  manifest.scenario_hash = std::move(*hash);
  std::set<std::string> paths;
  {
    const ReadRecord record;
    if (auto ok = load_samples(sweep); !ok) return pass_on(ok);
    paths = record.paths();
  }
  const auto folder = std::filesystem::absolute(sweep.request.scenario).parent_path();
  for (const std::string& path : paths) {
    if (path == sweep.request.scenario) continue;
    auto content = file_hash(path);
    if (!content) continue;  // it was looked for and is not there
    manifest.inputs.emplace_back(std::filesystem::absolute(path).lexically_proximate(folder).string(),
                                 std::move(*content));
  }
  std::ranges::sort(manifest.inputs);
  manifest.mathematics = mathematics_canary();
  return manifest;
}

std::string manifest_text(const Manifest& manifest) {
  const SweepRequest& request = manifest.request;
  const Json object = {{"format", format_number},
                       {"outrider", manifest.version},
                       {"build", manifest.build},
                       {"job", manifest.job},
                       {"scenario", request.scenario},
                       {"scenario_sha256", manifest.scenario_hash},
                       {"inputs", object_of(manifest.inputs)},
                       {"runs", request.runs},
                       {"seed", request.seed},
                       {"vary", request.vary},
                       {"compare", request.compare},
                       {"chunk_runs", request.chunk_runs},
                       {"mathematics", object_of(manifest.mathematics)}};
  return object.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string manifest_hash(Manifest manifest) {
  manifest.request.scenario.clear();
  return sha256(manifest_text(manifest));
}

std::string manifest_path(const std::string& folder) { return folder + "/manifest.json"; }

Outcome<Manifest> manifest_in(const std::string& folder) {
  const auto text = read_file(manifest_path(folder));
  if (!text) return pass_on(text);
  return read_manifest(*text, manifest_path(folder));
}

Outcome<Manifest> read_manifest(const std::string& text, const std::string& name) {
  const Json object = Json::parse(json_excess(text).empty() ? text : std::string(), nullptr, false);
  try {
    if (!object.is_discarded() && object.at("format") == format_number) {
      if (auto ok = check_counts(object, name); !ok) return pass_on(ok);
      return Manifest{.request = {.scenario = object.at("scenario"),
                                  .runs = object.at("runs"),
                                  .seed = object.at("seed"),
                                  .vary = object.at("vary"),
                                  .compare = object.at("compare"),
                                  .chunk_runs = object.at("chunk_runs")},
                      .job = object.at("job"),
                      .version = object.at("outrider"),
                      .build = object.at("build"),
                      .scenario_hash = object.at("scenario_sha256"),
                      .inputs = pairs_of(object.at("inputs")),
                      .mathematics = pairs_of(object.at("mathematics"))};
    }
  } catch (const Json::exception&) {  // a member is missing or of another type
  }
  return bad_input("it is not the manifest of a sweep; name another folder, or remove this one", name);
}

Status check_same(const Manifest& begun, const Manifest& here, const std::string& where) {
  const Pairs was = facts(begun), is = facts(here);
  for (std::size_t i = 0; i < was.size(); ++i) {
    if (was[i].second == is[i].second) continue;
    const bool shown = was[i].first.starts_with("--");
    return bad_input(fmt::format("the folder has a sweep that differs in {}{}; name another folder, or "
                                 "continue it as it was begun",
                                 was[i].first,
                                 shown ? fmt::format(" ('{}' there, '{}' here)", excerpt(was[i].second),
                                                     excerpt(is[i].second))
                                       : ""),
                     where);
  }
  if (const auto names = differences(begun.inputs, here.inputs); !names.empty()) {
    return bad_input(fmt::format("the input {} is not what it was when the sweep was begun; name another "
                                 "folder, or restore the file",
                                 excerpt(names.front())),
                     where);
  }
  if (const auto names = differences(begun.mathematics, here.mathematics); !names.empty()) {
    return bad_input(
        fmt::format("this machine computes {} otherwise than the one that began the sweep (its C "
                    "library or processor differs); compute all chunks on machines of one kind",
                    fmt::join(names, ", ")),
        where);
  }
  return {};
}

}  // namespace outrider
