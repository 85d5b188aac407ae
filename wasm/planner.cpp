// The functions of planner.wasm: a ground, plans on it, each checked, and the steps of a search. planner.mjs
// calls them.
//
// Texts go out as JSON that stays valid until the next call. The page writes numbers into input(), which
// holds as many bytes as it was asked for.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"

namespace outrider {
namespace {

std::vector<unsigned char> given;  // what the page writes
std::string answer;                // what it reads
Problem problem;                   // its ground stays; each plan sets start and goal
Workspace workspace;
std::string planner_name;
ConfiguredPlanner planner;

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') result += '\\';
    result += static_cast<unsigned char>(letter) < ' ' ? ' ' : letter;
  }
  return result + '"';
}

const char* fault(const Fault& fault) {
  answer = fmt::format(R"({{"code":{},"sentence":{},"where":{}}})", quoted(to_string(fault.code)),
                       quoted(fault.sentence), quoted(fault.where));
  return answer.c_str();
}

const char* done() {
  answer = "{}";
  return answer.c_str();
}

std::string point(const Vec2& p) { return fmt::format("[{},{}]", p.x, p.y); }

template <class Items, class Text>
std::string list(const Items& items, Text text) {
  std::string result = "[";
  for (const auto& item : items) {
    if (result.size() > 1) result += ',';
    result += text(item);
  }
  return result + ']';
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

/// Sets "name=value" lines of options.
Status set_options(std::string_view lines) {
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(std::min(lines.size(), line.size() + 1));
    const std::string_view name = line.substr(0, line.find('='));
    const auto option = std::find_if(planner.options.begin(), planner.options.end(),
                                     [&](const Option& known) { return known.name == name; });
    if (option == planner.options.end() || name.size() == line.size()) {
      return bad_input(fmt::format("{} has no option '{}'", planner_name, name), std::string(name));
    }
    if (auto ok = assign(*option, line.substr(name.size() + 1)); !ok) return ok;
  }
  return {};
}

/// Returns where a state of the search is: a vertex of the grid, or a place of its own.
Vec2 place_of(std::uint32_t state, const Trace& trace) {
  if (!trace.places.empty()) return {trace.places[state].x, trace.places[state].y};
  return problem.grid->point(problem.grid->at(state));
}

std::string step_text(const Expansion& step, const Trace& trace) {
  const Vec2 here = place_of(step.state, trace), before = place_of(step.parent, trace);
  return fmt::format("[{},{},{},{},{},{}]", here.x, here.y, before.x, before.y, number(step.g),
                     number(step.f));
}

std::string piece_text(const PathPiece& piece) {
  return fmt::format("[{},{},{},{},{},{},{}]", piece.from.x, piece.from.y, piece.to.x, piece.to.y,
                     piece.centre.x, piece.centre.y, piece.turn_rad);
}

std::string text_of(const Plan& plan, const Trace& trace) {
  return fmt::format(
      R"({{"cost":{},"lower_bound":{},"length":{},"expansions":{},"waypoints":{},"pieces":{},"steps":{}}})",
      plan.cost, number(plan.lower_bound), length_of(plan), plan.counters.expansions,
      list(plan.waypoints, point), list(plan.pieces, piece_text),
      list(trace.expansions, [&](const Expansion& step) { return step_text(step, trace); }));
}

}  // namespace

extern "C" {

/// Returns room for that many bytes.
[[clang::export_name("input")]] unsigned char* input(std::size_t bytes) {
  given.resize(bytes);
  return given.data();
}

/// Takes the bytes of the input as the cells of a grid, row 0 lowest; others than 0 are blocked.
[[clang::export_name("set_grid")]] const char* set_grid(int columns, int rows, double resolution_m,
                                                        bool corners) {
  Grid<std::uint8_t> grid;
  grid.frame.width = columns;
  grid.frame.height = rows;
  grid.frame.resolution_m = resolution_m;
  if (auto ok = check_frame(grid.frame); !ok) return fault(ok.error());
  grid.cells.assign(given.begin(), given.end());
  auto map = GridMap::of(grid, corners ? GridModel::corners : GridModel::cells);
  if (!map) return fault(map.error());
  problem = {std::make_shared<const GridMap>(std::move(*map)), {}, {}, nullptr};
  return done();
}

/// Takes the doubles of the input as polygons: of each the number of its corners, then x and y of each. The
/// first one is the boundary.
[[clang::export_name("set_polygons")]] const char* set_polygons(double radius_m) {
  std::vector<double> numbers(given.size() / sizeof(double));
  std::memcpy(numbers.data(), given.data(), numbers.size() * sizeof(double));
  std::vector<std::vector<Vec2>> polygons;
  for (std::size_t i = 0; i < numbers.size();) {
    const double corners = numbers[i++];
    if (!(corners >= 0) || corners > static_cast<double>(numbers.size() - i) / 2)
      return fault({FaultCode::bad_input, "a polygon has fewer numbers than corners", "polygons"});
    std::vector<Vec2>& polygon = polygons.emplace_back();
    for (auto left = static_cast<std::size_t>(corners); left > 0; --left, i += 2)
      polygon.push_back({numbers[i], numbers[i + 1]});
  }
  if (polygons.empty()) return fault({FaultCode::bad_input, "there is no boundary", "polygons"});
  auto ground = PolygonGround::of(polygons[0], {polygons.begin() + 1, polygons.end()}, radius_m);
  if (!ground) return fault(ground.error());
  problem = {nullptr, {}, {}, std::make_shared<const PolygonGround>(std::move(*ground))};
  return done();
}

/// Returns name, sentence, guarantee, source and grounds of every planner, with its options.
[[clang::export_name("catalogue")]] const char* catalogue() {
  answer = list(path_planners(), [](const PathPlanner& row) {
    const ConfiguredPlanner configured = row.configure();
    return fmt::format(
        R"({{"name":{},"sentence":{},"paper":{},"guarantee":{},"models":{},"polygons":{},"tells":{},"options":{}}})",
        quoted(row.name), quoted(row.sentence), quoted(row.paper), quoted(row.guarantee.sentence),
        list(row.models, [](GridModel model) { return quoted(to_string(model)); }), row.polygons,
        quoted(to_string(row.tells)), list(configured.options, [](const Option& option) {
          return fmt::format(R"({{"name":{},"unit":{},"type":{},"sentence":{},"value":{},"choices":{}}})",
                             quoted(option.name), quoted(option.unit), quoted(type_name(option)),
                             quoted(option.sentence), quoted(value_text(option)),
                             list(option.choices, quoted));
        }));
  });
  return answer.c_str();
}

/// Chooses the planner of the next plans. The input is its name, and on further lines "option=value".
[[clang::export_name("set_planner")]] const char* set_planner() {
  const std::string text(given.begin(), given.end());
  const std::string name = text.substr(0, text.find('\n'));
  auto row = find_path_planner(name);
  if (!row) return fault(row.error());
  planner = row->configure();
  planner_name = name;
  auto ok = set_options(std::string_view(text).substr(std::min(text.size(), name.size() + 1)));
  return ok ? done() : fault(ok.error());
}

/// Plans, and checks the plan by code that shares nothing with the planner. With `most_steps`, the answer has
/// the first steps of the search: of each its place, that of its parent, its cost so far and its priority.
[[clang::export_name("plan")]] const char* plan(double from_x, double from_y, double to_x, double to_y,
                                                std::size_t most_steps) {
  if (!planner.plan) return fault({FaultCode::bad_input, "no planner is chosen", "planner"});
  problem.start = {from_x, from_y};
  problem.goal = {to_x, to_y};
  Trace trace;
  trace.most = most_steps;
  workspace.trace = most_steps > 0 ? &trace : nullptr;
  const auto found = planner.plan(problem, {}, workspace);
  workspace.trace = nullptr;
  if (!found) return fault(found.error());
  if (auto ok = check(*found, problem); !ok) return fault(ok.error());
  answer = text_of(*found, trace);
  return answer.c_str();
}

}  // extern "C"

}  // namespace outrider
