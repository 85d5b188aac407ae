#include "svg_explore.hpp"

#include <fmt/format.h>

#include <iterator>

#include "svg_mapping.hpp"
#include "text.hpp"

namespace outrider {
namespace {

constexpr std::string_view refused_colour = "#7c4d9e", home_colour = "#00785a", wall_colour = "#e0457b";

/// The map, and with a margin all walls that are near it.
Box2 drawn_area(const PageReport& report) {
  const ReportMap& map = report.explore->map;
  Box2 box;
  box.include(report.start.position);
  for (const TrackSample& sample : report.track) box.include(sample.pose.position);
  if (map.columns > 0 && map.rows > 0) {
    box.include(map.origin);
    box.include(map.origin + map.cell_m * Vec2{1.0 * map.columns, 1.0 * map.rows});
  }
  const Box2 near = box.grown(0.25 * norm(box.size()) + 0.5);
  for (const auto& wall : report.explore->walls) {
    for (const Vec2 p : wall) {
      if (p.x > near.low.x && p.y > near.low.y && p.x < near.high.x && p.y < near.high.y) box.include(p);
    }
  }
  return box.grown(0.05 + 0.01 * norm(box.size()));
}

std::string walls(const MappingView& view, const ReportExplore& explore) {
  std::string d;
  for (const auto& wall : explore.walls) {
    char command = 'M';
    for (const Vec2 corner : wall) {
      const Vec2 p = view(corner);
      fmt::format_to(std::back_inserter(d), "{}{:.1f} {:.1f}", command, p.x, p.y);
      command = 'L';
    }
    d += 'Z';
  }
  return fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"1\" d=\"{}\"/>\n", wall_colour, d);
}

std::string marks(const MappingView& view, const PageReport& report) {
  std::string svg;
  for (const ReportRefusal& refusal : report.explore->refused) {
    const Vec2 p = view(refusal.position);
    svg += fmt::format(
        "<path fill=\"none\" stroke=\"{}\" stroke-width=\"2.5\" d=\"M{:.1f} {:.1f}l8 8m0 -8l-8 8\">"
        "<title>{}</title>{}</path>\n",
        refused_colour, p.x - 4.0, p.y - 4.0, markup_text(refusal.reason),
        view.from(1.0 - mapping_still_end));
  }
  const Vec2 home = view(report.start.position);
  return svg + fmt::format("<path fill=\"{}\" stroke=\"#fff\" d=\"M{:.1f} {:.1f}l9 8h-3v8h-12v-8h-3z\"/>\n",
                           home_colour, home.x, home.y - 8.0);
}

}  // namespace

std::string explore_picture(const PageReport& report, double seconds) {
  const ReportExplore& explore = *report.explore;
  const MappingView view = mapping_view(report, drawn_area(report), explore.beliefs, seconds);
  const auto keys = mapping_keys(view, report.track);
  return mapping_head(view, report,
                      {{way_colour, "true way"},
                       {belief_colour, belief_legend(view)},
                       {wall_colour, "true walls"},
                       {occupied_colour, "walls mapped"},
                       {refused_colour, "frontier refused"},
                       {home_colour, "home"}}) +
         growing_map(view, explore.map) + walls(view, explore) + believed_ellipses(view, explore.beliefs) +
         growing_line(view, keys, way_colour, 2.5) +
         growing_line(view, mapping_keys(view, explore.beliefs), belief_colour, 1.2) + marks(view, report) +
         moving_robot(view, keys, report.robot_radius_m) + mapping_foot(view);
}

}  // namespace outrider
