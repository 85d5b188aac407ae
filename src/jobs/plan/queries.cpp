#include "queries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/scenario/values.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_items = 10'000;

/// The parts between blanks; those beside a comma do not part.
Outcome<std::vector<std::string>> items_of(std::string_view text, const std::string& key) {
  std::vector<std::string> items;
  bool open = false;
  for (const std::string_view word : words(text)) {
    if (items.empty() || !(open || word.starts_with(','))) {
      items.emplace_back(word);
    } else {
      items.back() += word;
    }
    open = word.ends_with(',');
  }
  if (items.size() <= most_items) return items;
  return bad_input(fmt::format("{} are too many; expected {}", items.size(), most_items), key);
}

/// A point, and a heading if there is one.
struct QueryEnd {
  Vec2 position;
  std::optional<double> heading_rad;
};

Outcome<QueryEnd> end_of(const std::string& text, const std::string& key) {
  const bool has_heading = std::ranges::count(text, ',') == 2;
  const char* form =
      has_heading ? "x,y,heading in m and degrees, such as 1.5,-2,90" : "x,y in m, such as 1.5,-2";
  auto numbers = parse_numbers(text, has_heading ? 3 : 2, key, form);
  if (!numbers) return pass_on(numbers);
  QueryEnd end{{(*numbers)[0], (*numbers)[1]}, std::nullopt};
  if (has_heading) end.heading_rad = radians((*numbers)[2]);
  return end;
}

Outcome<std::vector<PlanQuery>> queries_to_goals(const PlanScenario& scenario) {
  auto from = end_of(scenario.from, "from");
  if (!from) return pass_on(from);
  auto goals = items_of(scenario.to, "to");
  if (!goals) return pass_on(goals);
  std::vector<PlanQuery> queries;
  for (const std::string& goal : *goals) {
    auto to = end_of(goal, "to");
    if (!to) return pass_on(to);
    queries.push_back({{}, from->position, to->position, from->heading_rad, to->heading_rad});
    if (goals->size() > 1) queries.back().number = queries.size();
  }
  return queries;
}

Outcome<CellChange> change_of(const std::string& text, const std::string& where, bool blocked) {
  const std::string form = "x,y or x,y,width,height in whole cells, such as 3,4 or 3,4,10,1";
  const bool one_cell = std::count(text.begin(), text.end(), ',') == 1;
  auto numbers = parse_numbers(text, one_cell ? 2 : 4, where, form);
  if (!numbers) return pass_on(numbers);
  for (const double number : *numbers) {
    if (number != std::floor(number) || std::abs(number) > most_grid_side) {
      return bad_input(fmt::format("{} is not valid; expected {}", number, form), where);
    }
  }
  const auto whole = [&](std::size_t i) { return static_cast<int>((*numbers)[i]); };
  return CellChange{{whole(0), whole(1)}, one_cell ? 1 : whole(2), one_cell ? 1 : whole(3), blocked};
}

}  // namespace

Outcome<std::vector<PlanQuery>> queries_of(const PlanScenario& scenario, const LoadedMap& map) {
  if (scenario.query.empty()) return queries_to_goals(scenario);
  const auto* polygons = std::get_if<PolygonMap>(&map.shape);
  if (polygons == nullptr)
    return bad_input("it works with a polygon environment only; leave it out, and give from and to", "query");
  std::vector<PlanQuery> queries;
  for (const PointQuery& query : polygons->queries) {
    queries.push_back({queries.size() + 1, query.start, query.goal});
  }
  if (scenario.query == "all" && !queries.empty()) return queries;
  const auto asked = number<std::size_t>(scenario.query);
  if (!asked || *asked < 1 || *asked > queries.size()) {
    return bad_input(
        fmt::format("'{}' is no query of this map, which has {}; expected all or a number from 1",
                    excerpt(scenario.query), queries.size()),
        "query");
  }
  return std::vector<PlanQuery>{queries[*asked - 1]};
}

Outcome<std::vector<PlanCellChange>> cell_changes(const PlanScenario& scenario) {
  std::vector<PlanCellChange> changes;
  for (const bool blocked : {true, false}) {
    const std::string key = blocked ? "block" : "free";
    auto items = items_of(blocked ? scenario.block : scenario.free, key);
    if (!items) return pass_on(items);
    for (const std::string& item : *items) {
      std::string where = key + " " + excerpt(item);
      auto change = change_of(item, where, blocked);
      if (!change) return pass_on(change);
      changes.push_back({*change, std::move(where)});
    }
  }
  return changes;
}

}  // namespace outrider
