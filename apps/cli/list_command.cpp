#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "output.hpp"
#include "outrider/guard/catalog.hpp"
#include "outrider/guard/policy.hpp"
#include "outrider/path/catalog.hpp"
#include "outrider/pursuit/catalog.hpp"

namespace outrider::cli {
namespace {

struct Job {
  const char* name;
  const char* sentence;
};
constexpr Job jobs[] = {{"guard", "Hit every target in a yard with a ballistic water gun, soonest."},
                        {"plan", "Find a collision-free path for a disk robot."},
                        {"pursue", "Catch a moving target on a grid of costs, at the least cost."}};

/// The grids that a planner takes: "cells", "corners".
std::vector<std::string> models_of(const PathPlanner& planner) {
  std::vector<std::string> names;
  for (const GridModel model : planner.models) names.emplace_back(to_string(model));
  return names;
}

/// The same, and "polygons".
std::vector<std::string> grounds_of(const PathPlanner& planner) {
  std::vector<std::string> grounds = models_of(planner);
  if (planner.polygons) grounds.emplace_back("polygons");
  return grounds;
}

nlohmann::ordered_json policies_json() {
  auto policies = nlohmann::ordered_json::array();
  for (const WatchPolicy& policy : watch_policies()) {
    policies.push_back({{"name", policy.name}, {"sentence", policy.sentence}, {"source", policy.source}});
  }
  return policies;
}

void list_policies() {
  fmt::print("\nGuard policies, when intruders keep coming (outrider guard --arrivals-policy NAME)\n");
  for (const WatchPolicy& policy : watch_policies()) {
    fmt::print("  {}\n      {}\n      Source: {}.\n", policy.name, policy.sentence, policy.source);
  }
}

void list_json() {
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
                        {"index", planner.index},
                        {"many_goals", static_cast<bool>(planner.configure().plan_many)},
                        {"cost_unit", unit_of(planner.guarantee.measure)}});
  }
  auto guards = nlohmann::ordered_json::array();
  for (const GuardPlanner& planner : guard_planners()) {
    guards.push_back({{"name", planner.name}, {"sentence", planner.sentence}, {"source", planner.source}});
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
         {"pursuit_planners", pursuers},
         {"guard_policies", policies_json()}});
}

void list_text() {
  fmt::print("Jobs\n");
  for (const Job& job : jobs) fmt::print("  {}\n      {}\n", job.name, job.sentence);
  fmt::print("\nGuard planners (outrider guard --planner NAME)\n");
  for (const GuardPlanner& planner : guard_planners()) {
    fmt::print("  {}\n      {}\n      Source: {}.\n", planner.name, planner.sentence, planner.source);
  }
  fmt::print("\nPath planners (outrider plan --planner NAME)\n");
  for (const PathPlanner& planner : path_planners()) {
    fmt::print("  {}\n      {}\n", planner.name, planner.sentence);
    fmt::print("      Guarantee: {}.\n      Ground: {}.\n", planner.guarantee.sentence,
               fmt::join(grounds_of(planner), ", "));
    fmt::print("      Source: {}.\n", planner.paper);
  }
  fmt::print("\nPursuit planners (outrider pursue FILE --planner NAME)\n");
  for (const PursuitPlanner& planner : pursuit_planners()) {
    fmt::print("  {}\n      {}\n", planner.name, planner.sentence);
    fmt::print("      Guarantee: {}.\n      Source: {}.\n", planner.guarantee.sentence, planner.paper);
  }
  list_policies();
}

}  // namespace

void add_list(CLI::App& app, int& status) {
  CLI::App* list = app.add_subcommand("list", "the jobs, and the planners with what they guarantee");
  auto json = std::make_shared<bool>(false);
  list->add_flag("--json", *json, "print one JSON object on standard output");
  list->callback([json, &status] {
    *json ? list_json() : list_text();
    status = job_done;
  });
}

}  // namespace outrider::cli
