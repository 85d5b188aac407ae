#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "output/output.hpp"
#include "output/terminal.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "outrider/jobs/guard/behaviour/policy.hpp"
#include "outrider/jobs/guard/catalog.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/path/fleet/planners.hpp"
#include "outrider/pursuit/catalog.hpp"

namespace outrider::cli {
namespace {

/// Returns the grid models that a planner takes: "cells", "corners".
std::vector<std::string> models_of(const PathPlanner& planner) {
  std::vector<std::string> names;
  for (const GridModel model : planner.models) names.emplace_back(to_string(model));
  return names;
}

/// Returns the grid models of a planner, and "polygons" if it takes them.
std::vector<std::string> grounds_of(const PathPlanner& planner) {
  std::vector<std::string> grounds = models_of(planner);
  if (planner.polygons) grounds.emplace_back("polygons");
  return grounds;
}

nlohmann::ordered_json policies_json() {
  auto policies = nlohmann::ordered_json::array();
  for (const ReplanPolicy& policy : replan_policies()) {
    policies.push_back({{"name", policy.name}, {"sentence", policy.sentence}, {"source", policy.source}});
  }
  return policies;
}

void list_policies() {
  show("\nGuard policies, when intruders keep coming (outrider guard --arrivals-policy NAME)\n");
  for (const ReplanPolicy& policy : replan_policies()) {
    show("  {}\n      {}\n      Source: {}.\n", policy.name, policy.sentence, policy.source);
  }
}

nlohmann::ordered_json cover_methods_json() {
  auto methods = nlohmann::ordered_json::array();
  for (const CoverMethod& method : cover_methods()) {
    methods.push_back({{"name", method.name}, {"sentence", method.sentence}, {"paper", method.paper}});
  }
  return methods;
}

void list_cover_methods() {
  show("\nCover methods (outrider cover FILE --method NAME)\n");
  for (const CoverMethod& method : cover_methods()) {
    show("  {}\n      {}\n", method.name, method.sentence);
    if (!method.paper.empty()) show("      Source: {}.\n", method.paper);
  }
}

void list_json(const std::vector<Job>& jobs) {
  auto job_list = nlohmann::ordered_json::array();
  for (const Job& job : jobs) job_list.push_back({{"name", job.name}, {"sentence", job.sentence}});
  auto planners = nlohmann::ordered_json::array();
  for (const PathPlanner& planner : path_planners()) {
    planners.push_back({{"name", planner.name},
                        {"sentence", planner.sentence},
                        {"paper", planner.paper},
                        {"guarantee", planner.guarantee.sentence},
                        {"complete", planner.guarantee.complete},
                        {"models", models_of(planner)},
                        {"polygons", planner.polygons},
                        {"steers", planner.steers},
                        {"index", planner.index},
                        {"tells", to_string(planner.tells)},
                        {"many_goals", static_cast<bool>(planner.configure().plan_many)},
                        {"cost_unit", unit_of(planner.guarantee.measure)}});
  }
  auto guards = nlohmann::ordered_json::array();
  for (const GuardPlanner& planner : guard_planners()) {
    guards.push_back({{"name", planner.name}, {"sentence", planner.sentence}, {"source", planner.source}});
  }
  auto fleets = nlohmann::ordered_json::array();
  for (const FleetPlanner& planner : fleet_planners()) {
    fleets.push_back({{"name", planner.name},
                      {"sentence", planner.sentence},
                      {"paper", planner.paper},
                      {"guarantee", planner.guarantee},
                      {"complete", planner.complete},
                      {"optimal", planner.optimal}});
  }
  auto pursuers = nlohmann::ordered_json::array();
  for (const PursuitPlanner& planner : pursuit_planners()) {
    pursuers.push_back({{"name", planner.name},
                        {"sentence", planner.sentence},
                        {"paper", planner.paper},
                        {"guarantee", planner.guarantee.sentence},
                        {"complete", planner.guarantee.complete},
                        {"optimal", planner.guarantee.optimal}});
  }
  print({{"jobs", job_list},
         {"guard_planners", guards},
         {"path_planners", planners},
         {"fleet_planners", fleets},
         {"pursuit_planners", pursuers},
         {"cover_methods", cover_methods_json()},
         {"guard_policies", policies_json()}});
}

void list_text(const std::vector<Job>& jobs) {
  show("Jobs\n");
  for (const Job& job : jobs) show("  {}\n      {}\n", job.name, job.sentence);
  show("\nGuard planners (outrider guard --planner NAME)\n");
  for (const GuardPlanner& planner : guard_planners()) {
    show("  {}\n      {}\n      Source: {}.\n", planner.name, planner.sentence, planner.source);
  }
  show("\nPath planners (outrider plan --planner NAME)\n");
  for (const PathPlanner& planner : path_planners()) {
    show("  {}\n      {}\n", planner.name, planner.sentence);
    show("      Guarantee: {}.\n      Ground: {}.\n", planner.guarantee.sentence,
         fmt::join(grounds_of(planner), ", "));
    show("      Source: {}.\n", planner.paper);
  }
  show("\nFleet planners (outrider fleet FILE --planner NAME)\n");
  for (const FleetPlanner& planner : fleet_planners()) {
    show("  {}\n      {}\n      Guarantee: {}.\n      Source: {}.\n", planner.name, planner.sentence,
         planner.guarantee, planner.paper);
  }
  show("\nPursuit planners (outrider pursue FILE --planner NAME)\n");
  for (const PursuitPlanner& planner : pursuit_planners()) {
    show("  {}\n      {}\n", planner.name, planner.sentence);
    show("      Guarantee: {}.\n      Source: {}.\n", planner.guarantee.sentence, planner.paper);
  }
  list_cover_methods();
  list_policies();
}

}  // namespace

void add_list(Command& tool, const std::vector<Job>& jobs) {
  Command& list = tool.add("list", "the jobs, and the planners with what they guarantee");
  auto json = std::make_shared<bool>(false);
  list.flag("--json", json.get(), "print one JSON object on standard output");
  list.does([json, jobs](const Command&) {
    *json ? list_json(jobs) : list_text(jobs);
    return job_done;
  });
}

}  // namespace outrider::cli
