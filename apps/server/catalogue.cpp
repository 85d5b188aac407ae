#include "catalogue.hpp"

#include <nlohmann/json.hpp>

#include "outrider/path/catalog.hpp"

namespace outrider::server {
namespace {

std::string_view name_of(PathClass among) {
  switch (among) {
    case PathClass::along_moves: return "along_moves";
    case PathClass::any_direction: return "any_direction";
    case PathClass::any_curve: return "any_curve";
    case PathClass::widest_curve: return "widest_curve";
    case PathClass::turning_curve: return "turning_curve";
    case PathClass::lattice_curve: return "lattice_curve";
  }
  return "";
}

std::string_view name_of(Measure measure) {
  switch (measure) {
    case Measure::length: return "length";
    case Measure::time: return "time";
    case Measure::safety: return "safety";
    case Measure::terrain: return "terrain";
    case Measure::manoeuvre: return "manoeuvre";
  }
  return "";
}

Json options_json(const std::vector<Option>& options) {
  Json list = Json::array();
  for (const Option& option : options) list.push_back(option_json(option));
  return list;
}

Json planner_json(const PathPlanner& planner) {
  Json grounds = Json::array();
  for (const GridModel model : planner.models) grounds.push_back(to_string(model));
  if (planner.polygons) grounds.push_back("polygons");
  return {{"name", planner.name},
          {"sentence", planner.sentence},
          {"paper", planner.paper},
          {"guarantee",
           {{"sentence", planner.guarantee.sentence},
            {"complete", planner.guarantee.complete},
            {"among", name_of(planner.guarantee.among)},
            {"measure", name_of(planner.guarantee.measure)},
            {"cost_unit", unit_of(planner.guarantee.measure)}}},
          {"grounds", std::move(grounds)},
          {"traces", planner.tells != TraceKind::lookup},
          {"tells", to_string(planner.tells)},
          {"index", planner.index},
          {"options", options_json(planner.configure().options)}};
}

}  // namespace

Json value_json(const Option& option) {
  if (const auto* text = std::get_if<std::string*>(&option.value)) return **text;
  if (const auto* flag = std::get_if<bool*>(&option.value)) return **flag;
  const std::string text = value_text(option);
  Json number = Json::parse(text, nullptr, false);
  return number.is_number() ? number : Json(text);
}

Json option_json(const Option& option) {
  Json object = {{"name", option.name}, {"type", type_name(option)}, {"unit", option.unit}};
  const bool number =
      std::holds_alternative<double*>(option.value) || std::holds_alternative<std::int64_t*>(option.value);
  if (number) object["low"] = option.low;
  if (number) object["high"] = option.high;
  if (!option.choices.empty()) object["choices"] = option.choices;
  object["default"] = value_json(option);
  object["sentence"] = option.sentence;
  return object;
}

Json catalogue_json(const std::vector<Job>& jobs) {
  Json planners = Json::array(), job_list = Json::array();
  for (const PathPlanner& planner : path_planners()) planners.push_back(planner_json(planner));
  for (const Job& job : jobs) {
    Json groups = Json::array();
    const auto task = job.blank();
    for (const OptionGroup& group : task->options()) {
      groups.push_back(
          {{"name", group.name}, {"sentence", group.sentence}, {"options", options_json(group.options)}});
    }
    job_list.push_back({{"name", job.name}, {"sentence", job.sentence}, {"groups", std::move(groups)}});
  }
  return {{"path_planners", std::move(planners)}, {"jobs", std::move(job_list)}};
}

}  // namespace outrider::server
