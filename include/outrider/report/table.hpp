// Table: named columns and rows of values, such as the targets of a run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

/// A piece of a path: an arc about `centre`, or a straight leg if `turn_rad` is 0.
struct TableArc {
  Vec2 from;
  Vec2 to;
  Vec2 centre;            ///< centre of the arc; unused for a leg
  double turn_rad = 0.0;  ///< angle of the arc, counter-clockwise positive; 0 for a leg
  friend bool operator==(const TableArc&, const TableArc&) = default;
};

/// A cell of a table: a number (NaN if unknown), a text, a point, a list of points or the pieces of a path.
/// Points are in metres.
using TableValue = std::variant<double, std::string, Vec2, std::vector<Vec2>, std::vector<TableArc>>;

struct Table {
  std::string name;
  std::vector<std::string> columns;           ///< names of the columns
  std::vector<std::vector<TableValue>> rows;  ///< each row has one value per column
  /// Columns of numbers that are processing times. They are displayed and never stored.
  std::vector<std::string> machine_times = {};
};

/// Gives access to the values of a row by the names of their columns. Throws std::out_of_range if there is no
/// such column, and std::bad_variant_access if the value has another type.
struct TableRow {
  const Table& table;
  const std::vector<TableValue>& values;

  template <class Value>
  [[nodiscard]] const Value& get(std::string_view column) const {
    const auto found = std::find(table.columns.begin(), table.columns.end(), column);
    return std::get<Value>(values.at(static_cast<std::size_t>(found - table.columns.begin())));
  }
  [[nodiscard]] double number(std::string_view column) const { return get<double>(column); }
  [[nodiscard]] const std::string& text(std::string_view column) const { return get<std::string>(column); }
};

}  // namespace outrider
