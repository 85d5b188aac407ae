#include "scenarios/yard_scenarios.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "outrider/io/scenario/scenario.hpp"
#include "outrider/io/scenario/targets.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "scenarios/yard_things.hpp"

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_boxes = 1000;
constexpr std::size_t most_moved_targets = 1000;
constexpr double box_height_m = 1.0;
constexpr double least_box_m = 0.01;

struct Yard {
  GuardScenario scenario;  ///< with the world as in its file
  YardThings things;
};

Outcome<Yard> loaded_yard(const fs::path& file) {
  Yard yard;
  GuardJob job;
  if (auto ok = read_scenario(job, file.string()); !ok) return pass_on(ok);
  yard.scenario = std::move(job.scenario);
  GuardScenario& scenario = yard.scenario;
  auto changes = changes_from_text(scenario.moved, scenario.removed);
  if (!changes) return pass_on(changes);
  scenario.moved = scenario.removed = "";
  if (auto read = load_problem(scenario); !read) return pass_on(read);
  auto things = yard_things(scenario.problem, std::move(*changes));
  if (!things) return pass_on(things);
  yard.things = std::move(*things);
  return yard;
}

Json target_json(const Target& target) {
  return {{"name", target.name},
          {"position", {target.base.x, target.base.y, target.base.z}},
          {"size", {target.size.x, target.size.y, target.size.z}},
          {"heading_rad", target.yaw_rad}};
}

/// Returns the target of that name, moved to `at`, or else a new one.
Outcome<Target> placed(const GuardProblem& yard, const std::string& name, Vec2 at, const std::string& where) {
  const auto old = std::ranges::find(yard.targets, name, &Target::name);
  if (old != yard.targets.end()) {
    Target target = *old;
    if (xy(target.base) == at) return target;
    const double above_m = target.base.z - yard.world.ground_z_m(xy(target.base));
    target.base = {at.x, at.y, yard.world.ground_z_m(at) + above_m};
    return target;
  }
  const std::string line =
      fmt::format("type=1 name={} x={} y={} z={}", name, at.x, at.y, yard.world.ground_z_m(at));
  auto made = targets_from_text(line, where);
  if (!made) return pass_on(made);
  if (made->size() != 1 || made->front().name != name) {
    return bad_input("the name of a target has no blanks and no #", where);
  }
  return made->front();
}

Outcome<std::vector<Target>> targets_of(const Json& list, const GuardProblem& yard) {
  std::vector<Target> targets;
  if (list.empty() || list.size() > std::max(most_moved_targets, yard.targets.size())) {
    return bad_input(fmt::format("expected 1 to {} targets", most_moved_targets), "targets");
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string where = fmt::format("targets[{}]", i);
    Fields fields(list[i], where);
    const std::string name = fields.text("name");
    const Vec2 at = fields.point("position");
    const bool turned = fields.has("heading_rad");
    const double heading_rad = fields.number("heading_rad", -most_turn_rad, most_turn_rad, 0.0);
    if (auto ok = fields.end(); !ok) return pass_on(ok);
    auto target = placed(yard, name, at, where);
    if (!target) return pass_on(target);
    if (turned) target->yaw_rad = heading_rad;
    if (std::ranges::count(targets, name, &Target::name) > 0)
      return bad_input("another target has that name", where + ".name");
    targets.push_back(std::move(*target));
  }
  return targets;
}

struct Box {
  Vec2 low;
  Vec2 high;
  double turn_rad = 0.0;
};

Outcome<std::vector<Box>> boxes_of(const Json& list) {
  std::vector<Box> boxes;
  if (list.size() > most_boxes) return bad_input(fmt::format("more than {} boxes", most_boxes), "boxes");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& corners = list[i];
    const auto corner = [&](std::size_t k) { return point_of({corners[k], corners[k + 1]}); };
    const bool turned = corners.is_array() && corners.size() == 5 && corners[4].is_number();
    const bool four = turned || (corners.is_array() && corners.size() == 4);
    const auto low = four ? corner(0) : std::nullopt, high = four ? corner(2) : std::nullopt;
    if (!low || !high || high->x - low->x < least_box_m || high->y - low->y < least_box_m) {
      return bad_input(
          fmt::format("expected [low x, low y, high x, high y], {} m apart, and the turn; m and rad",
                      least_box_m),
          fmt::format("boxes[{}]", i));
    }
    boxes.push_back({*low, *high, turned ? wrap_angle(corners[4].get<double>()) : 0.0});
  }
  return boxes;
}

/// Returns the text of the world with the boxes added as models.
Outcome<std::string> world_with(const std::vector<Box>& boxes, const GuardScenario& scenario,
                                const fs::path& beside) {
  auto text = read_file(scenario.world, largest_served_bytes);
  if (!text) return text;
  const bool names_files = text->find("<uri") != std::string::npos;
  if (names_files && fs::path(scenario.world).parent_path() != beside) {
    return bad_input(
        "the world names files beside it, and obstacles were added; save it in the folder of its "
        "world",
        fs::path(scenario.world).filename().string());
  }
  const std::size_t end = text->rfind("</world>");
  if (end == std::string::npos) {
    return bad_input("obstacles cannot be added to it, since it has no </world>", scenario.world);
  }
  std::string models;
  for (const auto& [low, high, turn_rad] : boxes) {
    const Vec2 middle = 0.5 * (low + high), size = high - low;
    models += fmt::format(
        "<model name=\"box_{:.3f},{:.3f}\"><static>true</static><pose>{} {} {} 0 0 {}</pose><link "
        "name=\"link\">"
        "<collision name=\"box\"><geometry><box><size>{} {} {}</size></box></geometry></collision></link>"
        "</model>\n",
        low.x, low.y, middle.x, middle.y, scenario.problem.world.ground_z_m(middle) + 0.5 * box_height_m,
        turn_rad, size.x, size.y, box_height_m);
  }
  text->insert(end, models);
  if (is_saved_here(*text)) return text;
  const std::size_t begin = text->starts_with("<?xml") ? text->find('>') + 1 : 0;
  return text->insert(begin, fmt::format("<!-- {} -->\n", saved_here));
}

}  // namespace

Outcome<Json> shown_yard(const fs::path& file) {
  auto loaded = loaded_yard(file);
  if (!loaded) return pass_on(loaded);
  const GuardProblem& yard = loaded->scenario.problem;
  auto world = changed(yard.world, loaded->things.changes);
  if (!world) return pass_on(world);
  auto polygons = polygons_of(*world, yard.robot.height_m);
  if (!polygons) return pass_on(polygons);
  const KnownMap map{{}, file.filename().string(), std::move(*polygons), {}, yard.robot.radius_m};
  Json targets = Json::array();
  for (const Target& target : yard.targets) targets.push_back(target_json(target));
  return Json{{"job", "guard"},
              {"map", packed(map)},
              {"start", {yard.start.position.x, yard.start.position.y}},
              {"heading_rad", yard.start.heading_rad},
              {"targets", std::move(targets)},
              {"fixed", fixed_json(yard, loaded->things)},
              {"things", things_json(yard, loaded->things)}};
}

Outcome<std::vector<NamedContent>> yard_files(const std::string& path, const Json& request) {
  Fields fields(request, "guard");
  const std::string of = fields.text("scenario");
  const Vec2 start = fields.point("start");
  const Json* target_list = fields.list("targets");
  const Json* box_list = fields.list("boxes");
  const bool turned = fields.has("heading_rad");
  const double heading_rad = fields.number("heading_rad", -most_turn_rad, most_turn_rad, 0.0);
  const bool changes_things = fields.has("moved") || fields.has("removed");
  const Json* moved = fields.list("moved");
  const Json* removed = fields.list("removed");
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  auto checked = checked_path(of);
  if (!checked) return pass_on(checked);
  const fs::path file = *checked, place = path;
  auto yard = loaded_yard(file);
  if (!yard) return pass_on(yard);
  const GuardScenario& scenario = yard->scenario;
  auto targets = targets_of(*target_list, scenario.problem);
  if (!targets) return pass_on(targets);
  auto boxes = boxes_of(*box_list);
  if (!boxes) return pass_on(boxes);

  const fs::path beside = place.parent_path();
  const std::string stem = path.substr(0, path.rfind('.'));
  std::vector<NamedContent> files{
      {stem + "_targets.txt", fmt::format("# {}\n{}", saved_here, targets_text(*targets))}};
  GuardJob job;
  const std::string as_if = (file.parent_path().lexically_relative(beside) / "a").string();
  if (auto ok = read_scenario(job, file.string(), as_if); !ok) return pass_on(ok);
  GuardScenario& changed = job.scenario;
  changed.targets = fs::path(files.back().path).filename().string();
  if (!boxes->empty()) {
    auto world = world_with(*boxes, scenario, beside);
    if (!world) return pass_on(world);
    files.push_back({stem + "_world.sdf", std::move(*world)});
    changed.world = fs::path(files.back().path).filename().string();
  }
  if (start != scenario.problem.start.position || turned) {
    const std::string heading = changed.start.substr(changed.start.rfind(',') + 1);
    changed.start = fmt::format("{},{},{}", start.x, start.y, turned ? degrees_text(heading_rad) : heading);
  }
  if (changes_things) {
    auto changes = changes_of(*moved, *removed, scenario.problem, yard->things);
    if (!changes) return pass_on(changes);
    changed.moved = moved_text(changes->moved);
    changed.removed = removed_text(changes->removed);
  }
  GuardScenario usual;
  files.push_back({path, fmt::format("# {}\njob: guard\n{}", saved_here,
                                     scenario_changes(describe(changed), describe(usual)))});
  return files;
}

}  // namespace outrider::server
