// A table of a run, such as its targets: columns by name, and a value of each in every row.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

/// A piece of a path: an arc about its centre, or a straight leg where it does not turn.
struct TableArc {
  Vec2 from;
  Vec2 to;
  Vec2 centre;            ///< of an arc
  double turn_rad = 0.0;  ///< of an arc, counter-clockwise positive; 0 for a leg
  friend bool operator==(const TableArc&, const TableArc&) = default;
};

/// A number (NaN: unknown), a text, a point, a list of points or the pieces of a path, m.
using TableValue = std::variant<double, std::string, Vec2, std::vector<Vec2>, std::vector<TableArc>>;

struct Table {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<TableValue>> rows;  ///< each as long as `columns`
};

}  // namespace outrider
