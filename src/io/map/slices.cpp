#include "outrider/io/map/slices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

constexpr std::size_t largest_bytes = std::size_t{64} << 20;
constexpr std::size_t most_pieces = 200'000;
constexpr std::size_t most_corners = 1000;
constexpr double farthest_height_m = 1e6;
constexpr double dented_m = 1e-3;  ///< a corner deeper than this inside the hull makes a polygon concave

constexpr const char* form = "expected x0,y0,x1,y1 or model,link,x0,y0,x1,y1,... in m";

/// Returns the corners as a convex polygon, or the fault that they are not convex.
Outcome<std::vector<Vec2>> convex(const std::vector<Vec2>& corners) {
  std::vector<Vec2> hull = convex_hull(corners);
  if (hull.size() < 3) return bad_input("its corners lie on one line; give a wall by its two ends");
  for (const Vec2 corner : corners) {
    double depth_m = farthest_height_m;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      depth_m = std::min(depth_m, distance(corner, Segment{hull[i], hull[(i + 1) % hull.size()]}));
    }
    if (depth_m <= dented_m) continue;
    return bad_input(
        fmt::format("the polygon is not convex: its corner {:g},{:g} lies {:.3g} m inside; cut it "
                    "in convex parts",
                    corner.x, corner.y, depth_m));
  }
  return hull;
}

Outcome<WorldSlice> slice_of(std::string_view line) {
  const std::vector<std::string_view> fields = parts_between(line, ',');
  WorldSlice slice;
  std::size_t first = 0;
  if (!number<double>(fields[0]) && fields.size() > 2) {
    first = 2;
    slice.name = excerpt(fields[0]) + '/' + excerpt(fields[1]);
  }
  const std::size_t count = fields.size() - first;
  if (count < 4 || count % 2 != 0 || (first == 0 && count != 4) || count > 2 * most_corners) {
    return bad_input(fmt::format("the line has {} numbers; {}", count, form));
  }
  for (std::size_t i = first; i < fields.size(); i += 2) {
    const auto corner = numbers_of(std::span(fields).subspan(i, 2), farthest_height_m);
    if (!corner) {
      return bad_input(fmt::format("'{}' is no place within 1e6 m; {}",
                                   excerpt(fmt::format("{},{}", fields[i], fields[i + 1])), form));
    }
    slice.corners.push_back({(*corner)[0], (*corner)[1]});
  }
  if (slice.corners.size() > 2) {
    auto hull = convex(slice.corners);
    if (!hull) return pass_on(hull);
    slice.corners = std::move(*hull);
  } else if (slice.corners[0] == slice.corners[1]) {
    return bad_input("a wall whose two ends are one has no length; take the line away");
  }
  return slice;
}

}  // namespace

Outcome<std::vector<WorldSlice>> slices_from_text(std::string_view text, const std::string& name) {
  std::vector<WorldSlice> slices;
  TextLines lines{text, name};
  while (lines.next()) {
    const std::string_view line = trimmed(lines.line);
    if (line.empty() || line.front() == '#') continue;
    auto slice = slice_of(line);
    if (!slice) return bad_input(slice.error().sentence, lines.where());
    if (slices.size() == most_pieces) {
      return bad_input(fmt::format("there are more than {} pieces, the most that is read", most_pieces),
                       lines.where());
    }
    slices.push_back(std::move(*slice));
  }
  return slices;
}

Outcome<std::vector<WorldSlice>> load_slices(const std::string& path) {
  auto text = read_file(path, largest_bytes);
  if (!text) return pass_on(text);
  return slices_from_text(*text, path);
}

}  // namespace outrider
