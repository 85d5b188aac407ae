#include "scenarios/scenarios.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "catalogue.hpp"
#include "outrider/core/base64.hpp"
#include "outrider/io/map/map_server.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/catalog.hpp"
#include "outrider/jobs/plan/job.hpp"
#include "scenarios/yard_scenarios.hpp"

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

/// Returns the planner options that differ from their defaults, in the form that the page keeps.
Json chosen_options(const PlanScenario& scenario) {
  Json options = Json::object();
  const PlanScenario usual;
  for (std::size_t i = 0; i < scenario.planners.size(); ++i) {
    if (scenario.planners[i].first.name != scenario.planner) continue;
    const auto& all = scenario.planners[i].second.options;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Json value = value_json(all[k]);
      if (value != value_json(usual.planners[i].second.options[k])) options[all[k].name] = value;
    }
  }
  return options;
}

/// Returns x and y. A heading behind them is left out, as the page has none.
Outcome<Json> point_from(const std::string& text, const char* key) {
  const std::size_t count = std::ranges::count(text, ',') == 2 ? 3 : 2;
  auto numbers = parse_numbers(text, count, key, "x,y in m, such as 1.5,-2");
  if (!numbers) return pass_on(numbers);
  return Json{(*numbers)[0], (*numbers)[1]};
}

Outcome<Json> shown_question(const std::string& path) {
  PlanJob job;
  if (auto ok = read_scenario(job, path); !ok) return pass_on(ok);
  if (auto ok = check(job.scenario); !ok) return pass_on(ok);
  auto read = read_map(job.scenario.map, job.scenario.height_m);
  if (!read) return pass_on(read);
  const PlanScenario scenario = settle(job.scenario, read->kind, job.given);
  auto start = point_from(scenario.from, "from");
  if (!start) return start;
  auto goal = point_from(scenario.to, "to");
  if (!goal) return goal;
  auto planner = find_path_planner(scenario.planner);
  if (!planner) return pass_on(planner);
  read->map.radius_m = scenario.radius_m;
  return Json{{"job", "plan"},
              {"map", packed(read->map)},
              {"start", std::move(*start)},
              {"goal", std::move(*goal)},
              {"planner", scenario.planner},
              {"options", chosen_options(scenario)},
              {"model", scenario.model},
              {"radius_m", scenario.radius_m},
              {"resolution_m", scenario.grid.resolution_m}};
}

/// Returns ROOM_map.yaml and ROOM_map.pgm, or ROOM_map.txt; the file that a scenario names comes last.
Outcome<std::vector<NamedContent>> map_files(const std::string& stem, const KnownMap& map) {
  if (const auto* polygons = std::get_if<PolygonMap>(&map.shape)) {
    return std::vector<NamedContent>{
        {stem + "_map.txt", fmt::format("# {}\n{}", saved_here, polygon_map_text(*polygons))}};
  }
  const auto& cells = std::get<MapCells>(map.shape);
  const std::string image = fs::path(stem).filename().string() + "_map.pgm";
  auto text = map_server_text({cells.occupancy, cells.yaw_rad}, image);
  if (!text) return pass_on(text);
  text->image.insert(text->image.find('\n') + 1, fmt::format("# {}\n", saved_here));
  return std::vector<NamedContent>{{stem + "_map.pgm", std::move(text->image)},
                                   {stem + "_map.yaml", fmt::format("# {}\n{}", saved_here, text->yaml)}};
}

Outcome<std::vector<NamedContent>> question_files(const std::string& path, const Json& question,
                                                  PlanningMemory& memory) {
  auto asked = scenario_of_question(question, memory);
  if (!asked) return pass_on(asked);
  auto files = map_files(path.substr(0, path.rfind('.')), asked->map);
  if (!files) return files;
  asked->scenario.map = fs::path(files->back().path).filename().string();
  PlanScenario usual;  // values that depend on the map are always written
  usual.planner = usual.model = "";
  usual.radius_m = usual.grid.resolution_m = -1.0;
  files->push_back({path, fmt::format("# {}\njob: plan\n{}", saved_here,
                                      scenario_changes(describe(asked->scenario), describe(usual)))});
  return files;
}

/// Returns true if the name needs no quotes in YAML or in a shell.
bool plain_name(const std::string& name) {
  return name.size() <= 100 && std::all_of(name.begin(), name.end(), [](char c) {
           return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_' ||
                  c == '-' || c == '.';
         });
}

/// Decodes the files that the reader made.
Outcome<std::vector<NamedContent>> unpacked_files(const Json& answer) {
  std::vector<NamedContent> files;
  for (const Json& file : answer.value("files", Json::array())) {
    auto content = base64_decoded(file.value("base64", "?"));
    if (!content) return bad_input("the files of the scenario were not made; try again");
    files.push_back({file.value("path", ""), std::move(*content)});
  }
  return files;
}

/// Returns a scenario for the page; refuses jobs that the page cannot change.
Outcome<Json> shown_job(const std::string& path) {
  const auto job = job_of_scenario(jobs(), path);
  if (!job) return pass_on(job);
  if (job->name == "plan") return shown_question(path);
  if (job->name == "guard") return shown_yard(path);
  return bad_input(
      fmt::format("the page changes scenarios of the jobs plan and guard; this one is {}", job->name), path);
}

}  // namespace

Outcome<Json> with_kept_map(Json shown, MapStore& maps) {
  auto map = unpacked(shown.value("map", Json::object()));
  if (!map) return pass_on(map);
  shown["map"] = map_json(*maps.keep(std::move(*map)));
  return shown;
}

Outcome<Json> shown_scenario(const std::string& path) {
  auto shown = shown_job(path);
  if (!shown) return shown;
  (*shown)["path"] = path;
  return shown;
}

Outcome<std::vector<NamedContent>> scenario_files(const std::string& path, const Json& request,
                                                  const Folder& folder, PlanningMemory& memory,
                                                  const ReadFiles& read, const std::stop_token& stop) {
  if (!path.ends_with(".yaml") || !plain_name(fs::path(path).filename().string())) {
    return bad_input("a scenario is saved under a name of letters, digits, _ . and - that ends in .yaml",
                     path.substr(0, 200));
  }
  Fields fields(request, "");
  const bool yard = fields.has("guard");
  if (yard == fields.has("plan")) return bad_input("give one of plan and guard", "");
  const Json* content = fields.object(yard ? "guard" : "plan");
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  if (!yard) return question_files(path, *content, memory);
  auto answer = read(folder, {{"yard", *content}, {"save_as", path}}, stop);
  return answer ? unpacked_files(*answer) : pass_on(answer);
}

}  // namespace outrider::server
