#include "regions_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "outrider/geometry/convex.hpp"

namespace outrider {
namespace {

constexpr double large_px = 760.0;
constexpr double gap_px = 14.0;
constexpr double text_px = 15.0;
constexpr int columns = 6;
constexpr int small_fields = 80;  // across a small map

/// From dark blue through teal to yellow; 0 to 1.
std::string heat(double share) {
  constexpr double stops[][3] = {
      {38, 50, 110}, {32, 110, 142}, {40, 168, 130}, {150, 210, 70}, {253, 231, 60}};
  const double at = 4.0 * std::clamp(share, 0.0, 1.0);
  const auto low = static_cast<std::size_t>(std::min(3.0, std::floor(at)));
  const double part = at - static_cast<double>(low);
  const auto mix = [&](std::size_t i) {
    return static_cast<int>(std::lround(stops[low][i] + part * (stops[low + 1][i] - stops[low][i])));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2));
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else
      safe += c;
  }
  return safe;
}

/// Fields of one map, each `size` x `size` cells, as one path for each colour, row by row in runs.
/// `colour` gives an index, or -1 for no paint.
std::string fields(const GridFrame& frame, int size, const std::vector<std::string>& colours,
                   const std::function<int(Cell)>& colour) {
  std::map<int, std::string> paths;
  for (int y = 0; y < frame.height; y += size) {
    for (int x = 0; x < frame.width;) {
      const int paint = colour({x, y});
      int end = x + size;
      while (end < frame.width && colour({end, y}) == paint) end += size;
      if (paint >= 0) paths[paint] += fmt::format("M{} {}h{}v{}h-{}z", x, y, end - x, size, end - x);
      x = end;
    }
  }
  std::string text;
  for (const auto& [paint, path] : paths) {
    text += fmt::format("<path d=\"{}\" fill=\"{}\"/>\n", path, colours[static_cast<std::size_t>(paint)]);
  }
  return text;
}

/// A polygon in cells.
std::string outline(const GridFrame& frame, const std::vector<Vec2>& polygon) {
  std::string path;
  for (const Vec2 corner : polygon) {
    const Vec2 p = 1.0 / frame.resolution_m * (corner - frame.origin);
    path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? 'M' : 'L', p.x, p.y);
  }
  return path + "Z";
}

std::string solids(const GuardProblem& problem, const GridFrame& frame) {
  const double floor = problem.world.floor_z_m;
  std::string path;
  for (const Solid& solid : problem.world.solids) {
    for (const RoundedPolygon& shape :
         footprint(solid, floor + 1e-3, std::numeric_limits<double>::infinity())) {
      if (!shape.core.empty()) path += outline(frame, circumscribed(shape, radians(15.0)));
    }
  }
  return fmt::format("<path d=\"{}\" fill=\"#94a6b4\" fill-opacity=\".55\"/>\n", path);
}

std::string target_box(const GuardProblem& problem, const GridFrame& frame, std::size_t t) {
  const Target& target = problem.targets[t];
  const Vec2 x = std::max(0.5 * target.size.x, 0.15) * direction(target.yaw_rad);
  const Vec2 y = std::max(0.5 * target.size.y, 0.15) * perpendicular(direction(target.yaw_rad));
  const Vec2 c = xy(target.base);
  return fmt::format("<path d=\"{}\" fill=\"#ff5d5d\"/>\n",
                     outline(frame, {c - x - y, c + x - y, c + x + y, c - x + y}));
}

/// A map with its lower left corner at the origin of the yard, `scale` pixels a cell.
std::string placed(const GridFrame& frame, double left, double top, double scale,
                   const std::string& content) {
  return fmt::format(
      "<g transform=\"translate({:.1f} {:.1f}) scale({:.4f} {:.4f})\">"
      "<rect width=\"{}\" height=\"{}\" fill=\"#16212b\"/>\n{}</g>\n",
      left, top + scale * frame.height, scale, -scale, frame.width, frame.height, content);
}

std::string words(double x, double y, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x, y, escaped(text));
}

bool hits(const FiringMap& firing_map, std::size_t t, std::size_t cell) {
  return firing_map.regions[t].pitch[cell] != FiringRegion::no_shot;
}

/// How many targets can be hit from each cell.
std::vector<int> counts(const FiringMap& firing_map) {
  std::vector<int> all(firing_map.frame.size(), 0);
  for (std::size_t c = 0; c < all.size(); ++c) {
    for (std::size_t t = 0; t < firing_map.regions.size(); ++t) all[c] += hits(firing_map, t, c) ? 1 : 0;
  }
  return all;
}

std::string large_map(const GuardProblem& problem, const FiringMap& firing_map, const std::vector<int>& count,
                      int most) {
  std::vector<std::string> colours;
  for (int i = 0; i <= most; ++i) colours.push_back(i == 0 ? "#1f2d3a" : heat(static_cast<double>(i) / most));
  std::string content = fields(firing_map.frame, 1, colours, [&](Cell c) {
    const std::size_t i = firing_map.frame.index(c);
    return firing_map.reachable[i] != 0 ? count[i] : -1;
  });
  content += solids(problem, firing_map.frame);
  for (std::size_t t = 0; t < problem.targets.size(); ++t)
    content += target_box(problem, firing_map.frame, t);
  return content;
}

/// The spreads of one target's shots, in ten colours; a error_ratio of 1 and more is the last.
std::string small_map(const GuardProblem& problem, const FiringMap& firing_map, std::size_t t) {
  std::vector<std::string> colours;
  for (int i = 0; i < 10; ++i) colours.push_back(heat(1.0 - i / 9.0));
  colours.push_back("#1f2d3a");
  const GridFrame& frame = firing_map.frame;
  const int size = std::max(1, std::max(frame.width, frame.height) / small_fields);
  const std::string content = fields(frame, size, colours, [&](Cell c) {
    int paint = -1;
    float least = std::numeric_limits<float>::infinity();
    for (int y = c.y; y < std::min(c.y + size, frame.height); ++y) {
      for (int x = c.x; x < std::min(c.x + size, frame.width); ++x) {
        const std::size_t i = frame.index({x, y});
        if (firing_map.reachable[i] != 0) paint = 10;
        if (hits(firing_map, t, i)) least = std::min(least, firing_map.regions[t].error_ratio[i]);
      }
    }
    return std::isfinite(least) ? static_cast<int>(9.0F * std::min(1.0F, least)) : paint;
  });
  return content + solids(problem, frame) + target_box(problem, frame, t);
}

std::string legend(double top, int most) {
  std::string text;
  const double step = large_px / 2.0 / (most + 1);
  for (int i = 0; i <= most; ++i) {
    text +=
        fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"12\" fill=\"{}\"/>\n",
                    gap_px + i * step, top, step, i == 0 ? "#1f2d3a" : heat(static_cast<double>(i) / most));
  }
  return text + words(gap_px + large_px / 2.0 + 10.0, top + 11.0,
                      fmt::format("0 to {} targets can be hit from a place", most));
}

}  // namespace

std::string regions_svg(const GuardProblem& problem, const FiringMap& firing_map) {
  const GridFrame& frame = firing_map.frame;
  const auto count = counts(firing_map);
  const int most = std::max(1, count.empty() ? 1 : *std::max_element(count.begin(), count.end()));
  const double aspect = static_cast<double>(frame.height) / frame.width;
  const double small_px = (large_px - (columns - 1) * gap_px) / columns;

  std::string body =
      placed(frame, gap_px, gap_px, large_px / frame.width, large_map(problem, firing_map, count, most));
  double top = 2.0 * gap_px + large_px * aspect;
  body += legend(top, most);
  top += 12.0 + 2.0 * gap_px;
  body += words(gap_px, top + text_px,
                "each target: from where it can be hit, the brighter the more error is forgiven");
  top += text_px + gap_px;
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    const double left = gap_px + static_cast<double>(t % columns) * (small_px + gap_px);
    body += placed(frame, left, top, small_px / frame.width, small_map(problem, firing_map, t));
    body += words(left, top + small_px * aspect + text_px, problem.targets[t].name);
    if (t % columns == columns - 1 || t + 1 == problem.targets.size())
      top += small_px * aspect + text_px + gap_px;
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#dfe7ee\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#101820\"/>\n{2}</svg>\n",
      large_px + 2.0 * gap_px, top + gap_px, body);
}

}  // namespace outrider
