#include "outrider/io/map/polygons.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_queries = 100'000;

void skip_white(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(white_space), rest.size()));
}

/// Removes one "(x,y)" from the text and returns it.
Outcome<Vec2> take_point(std::string_view& rest, const std::string& where) {
  const auto wrong = [&] {
    return bad_input(fmt::format("'{}' is no corner; write (x,y) with x and y from -{} to {} m",
                                 excerpt(rest), farthest_corner_m, farthest_corner_m),
                     where);
  };
  const std::size_t end = rest.find(')');
  if (rest.front() != '(' || end == std::string_view::npos) return wrong();
  const std::string_view inner = rest.substr(1, end - 1);
  const auto corner = numbers_of(parts_between(inner, ','), farthest_corner_m);
  if (!corner || corner->size() != 2) return wrong();
  rest.remove_prefix(end + 1);
  skip_white(rest);
  return Vec2{(*corner)[0], (*corner)[1]};
}

Outcome<std::vector<Vec2>> points_of(std::string_view line, const std::string& where) {
  std::vector<Vec2> points;
  skip_white(line);
  while (!line.empty()) {
    auto point = take_point(line, where);
    if (!point) return pass_on(point);
    points.push_back(*point);
  }
  return points;
}

std::string line_of(const std::vector<Vec2>& points) {
  std::string line;
  for (const Vec2 p : points) line += fmt::format("{}({},{})", line.empty() ? "" : " ", p.x, p.y);
  return line + "\n";
}

enum Block { boundary_block, obstacle_block, query_block };

Status take_line_of(Block block, std::string_view line, const std::string& where, PolygonMap& map,
                    std::size_t& corners) {
  auto points = points_of(line, where);
  if (!points) return pass_on(points);
  if (block == query_block) {
    if (points->size() != 2) {
      return bad_input(fmt::format("a query has a start and a goal; this one has {} points", points->size()),
                       where);
    }
    if (map.queries.size() == most_queries) {
      return bad_input(fmt::format("more than {} queries; split the file", most_queries), where);
    }
    map.queries.push_back({(*points)[0], (*points)[1]});
    return {};
  }
  corners += points->size();
  if (corners > most_polygon_corners) {
    return bad_input(fmt::format("more than {} corners; simplify the polygons", most_polygon_corners), where);
  }
  if (block == boundary_block) {
    map.boundary.insert(map.boundary.end(), points->begin(), points->end());
    return {};
  }
  map.obstacles.push_back(std::move(*points));
  auto good = check_polygon(map.obstacles.back(), fmt::format("obstacle {}", map.obstacles.size()));
  if (!good) good.error().where = where;
  return good;
}

}  // namespace

Outcome<PolygonMap> polygon_map_from_text(std::string_view text, const std::string& name) {
  PolygonMap map;
  int block = boundary_block;
  std::size_t corners = 0;
  TextLines lines{text, name};
  while (lines.next_filled()) {
    const std::string where = lines.where();
    if (trimmed(lines.line) == "---") {
      if (block == boundary_block) {
        if (auto good = check_polygon(map.boundary, "the boundary"); !good) {
          good.error().where = where;
          return pass_on(good);
        }
      }
      if (++block <= query_block) continue;
      return bad_input("a third ---; there are three blocks: boundary, obstacles, queries", where);
    }
    if (auto taken = take_line_of(static_cast<Block>(block), lines.line, where, map, corners); !taken) {
      return pass_on(taken);
    }
  }
  if (block == boundary_block) {
    return bad_input("no line --- after the boundary; then come the obstacles, --- and the queries", name);
  }
  return map;
}

std::string polygon_map_text(const PolygonMap& map) {
  std::string text = line_of(map.boundary) + "---\n";
  for (const auto& corners : map.obstacles) text += line_of(corners);
  if (!map.queries.empty()) text += "---\n";
  for (const PointQuery& query : map.queries) text += line_of({query.start, query.goal});
  return text;
}

Outcome<PolygonMap> load_polygon_map(const std::string& path) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  return polygon_map_from_text(*text, path);
}

}  // namespace outrider
