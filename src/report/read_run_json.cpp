#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "outrider/core/json_excess.hpp"
#include "outrider/report/run_json.hpp"

namespace outrider {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the number; NaN for null.
double number_of(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Vec2 point_of(const Json& value) { return {number_of(value.at(0)), number_of(value.at(1))}; }

TableArc arc_of(const Json& value) {
  TableArc arc{point_of(value.at("from")), point_of(value.at("to")), {}, value.value("turn_rad", 0.0)};
  if (value.contains("centre")) arc.centre = point_of(value["centre"]);
  return arc;
}

TableValue value_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return number_of(value);
  if (value.empty()) return std::vector<Vec2>{};
  if (value.front().is_object()) {
    std::vector<TableArc> arcs;
    for (const Json& one : value) arcs.push_back(arc_of(one));
    return arcs;
  }
  if (!value.front().is_array()) return point_of(value);
  std::vector<Vec2> points;
  for (const Json& one : value) points.push_back(point_of(one));
  return points;
}

/// The columns are those of the first row. A value that is missing in a later row is NaN.
Table table_of(const std::string& name, const Json& rows) {
  Table table{name, {}, {}};
  for (const Json& row : rows) {
    if (table.columns.empty()) {
      for (const auto& [column, value] : row.items()) table.columns.push_back(column);
    }
    std::vector<TableValue> values;
    values.reserve(table.columns.size());
    for (const std::string& column : table.columns)
      values.push_back(value_of(row.contains(column) ? row[column] : Json()));
    table.rows.push_back(std::move(values));
  }
  return table;
}

bool is_table(const Json& value) {
  if (!value.is_array()) return false;
  return std::ranges::all_of(value, [](const Json& row) { return row.is_object(); });
}

Report report_of(const Json& object) {
  Report report;
  report.status = object.at("status").get<std::string>();
  report.job = object.at("job").get<std::string>();
  report.world_name = object.at("world").get<std::string>();
  report.reason = object.at("reason").get<std::string>();
  for (const auto& [name, value] : object.at("metrics").items())
    report.metrics.emplace_back(name, number_of(value));
  const Json settings = object.value("settings", Json::object());
  for (const auto& [name, value] : settings.items())
    report.settings.emplace_back(name, value.get<std::string>());
  report.warnings = object.at("warnings").get<std::vector<std::string>>();
  for (const auto& [name, value] : object.items()) {
    if (name != "warnings" && is_table(value)) report.tables.push_back(table_of(name, value));
  }
  return report;
}

}  // namespace

Outcome<Report> read_run_json(const std::string& text, const std::string& name) {
  if (const auto why = json_excess(text); !why.empty())
    return bad_input(fmt::format("{}, so it is not the run.json of a run", why), name);
  const Json object = Json::parse(text, nullptr, false);
  if (!object.is_object()) return bad_input("it is not a JSON object; a run leaves it as run.json", name);
  if (object.contains("outrider_report")) {
    return bad_input(
        "it is a report of an older version; run the job again with --out DIR, which leaves DIR/run.mcap",
        name);
  }
  try {
    return report_of(object);
  } catch (const Json::exception&) {
    return bad_input(
        "it is not the run.json of a run: a key is missing or has the wrong type; run the job again", name);
  }
}

}  // namespace outrider
