#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "output.hpp"
#include "outrider/path/catalog.hpp"

namespace outrider::cli {
namespace {

void list_json() {
  auto planners = nlohmann::ordered_json::array();
  for (const PathPlanner& planner : path_planners()) {
    planners.push_back({{"name", planner.name},
                        {"sentence", planner.sentence},
                        {"paper", planner.paper},
                        {"guarantee", planner.guarantee.sentence},
                        {"complete", planner.guarantee.complete}});
  }
  print({{"jobs", {"guard", "plan"}}, {"path_planners", planners}});
}

void list_text() {
  fmt::print("Jobs\n  guard   hit every target in a yard with a ballistic water gun\n");
  fmt::print("  plan    a collision-free path for a disk robot\n\nPath planners (plan --planner NAME)\n");
  for (const PathPlanner& planner : path_planners()) {
    fmt::print("  {:<16} {}\n  {:<16} {}\n  {:<16} {}\n", planner.name, planner.sentence, "",
               planner.guarantee.sentence, "", planner.paper);
  }
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
