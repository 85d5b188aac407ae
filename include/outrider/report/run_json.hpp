// The JSON form of a report. A run leaves it as run.json, the command line tool prints it with --json, and
// the server sends it.
//
//   {"status", "job", "world", "reason", "metrics": {...}, the tables by their names, "files": {...},
//    "warnings": [...]}
//
// Unknown numbers are null; whole numbers have no decimal point. `Json` is any type with the interface of
// nlohmann::ordered_json, so this header does not depend on that library.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/core/overload.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// The files written for a run, as pairs of name and path. Names are "result", "log", "picture", "page" and
/// the names that the job gave to its own files.
using WrittenFiles = std::vector<std::pair<std::string, std::string>>;

/// Converts a number: null if it is not finite, an integer if it is whole.
template <class Json>
Json number_json(double value) {
  constexpr double exact = 9e15;
  if (!std::isfinite(value)) return nullptr;
  if (std::abs(value) < exact && value == std::floor(value)) return static_cast<std::int64_t>(value);
  return value;
}

template <class Json>
Json point_json(Vec2 p) {
  return {number_json<Json>(p.x), number_json<Json>(p.y)};
}

template <class Json>
Json piece_json(const TableArc& piece) {
  Json object = {{"from", point_json<Json>(piece.from)}, {"to", point_json<Json>(piece.to)}};
  if (piece.turn_rad != 0.0) object["centre"] = point_json<Json>(piece.centre);
  if (piece.turn_rad != 0.0) object["turn_rad"] = piece.turn_rad;
  return object;
}

template <class Json>
Json table_value_json(const TableValue& value) {
  return std::visit(Overload{[](double number) { return number_json<Json>(number); },
                             [](const std::string& text) { return Json(text); },
                             [](Vec2 point) { return point_json<Json>(point); },
                             [](const std::vector<Vec2>& points) {
                               Json list = Json::array();
                               for (const Vec2 p : points) list.push_back(point_json<Json>(p));
                               return list;
                             },
                             [](const std::vector<TableArc>& pieces) {
                               Json list = Json::array();
                               for (const TableArc& piece : pieces) list.push_back(piece_json<Json>(piece));
                               return list;
                             }},
                    value);
}

/// Converts a table to a list of objects, one per row, with one member per column.
template <class Json>
Json table_json(const Table& table) {
  Json rows = Json::array();
  for (const auto& row : table.rows) {
    Json object = Json::object();
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      object[table.columns[i]] = table_value_json<Json>(row[i]);
    }
    rows.push_back(std::move(object));
  }
  return rows;
}

/// Converts a run to the JSON object described at the top of this file.
template <class Json>
Json run_json(const Report& report, const WrittenFiles& files = {}) {
  Json metrics = Json::object(), paths = Json::object();
  for (const auto& [name, value] : report.metrics) metrics[name] = number_json<Json>(value);
  for (const auto& [name, value] : report.machine_times) metrics[name] = number_json<Json>(value);
  for (const auto& [name, path] : files) paths[name] = path;
  Json object = {{"status", report.status},
                 {"job", report.job},
                 {"world", report.world_name},
                 {"reason", report.reason},
                 {"metrics", metrics}};
  for (const Table& table : report.tables) object[table.name] = table_json<Json>(table);
  object["files"] = std::move(paths);
  object["warnings"] = report.warnings;
  return object;
}

/// Reads run.json, as a run leaves it. Fault: bad_input with `name`.
Outcome<Report> read_run_json(const std::string& text, const std::string& name);

}  // namespace outrider
