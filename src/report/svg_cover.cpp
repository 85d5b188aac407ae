#include "svg_cover.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "svg_mapping.hpp"

namespace outrider {
namespace {

constexpr std::string_view covered_colour = "#00785a", planned_colour = "#566470", missed_colour = "#d55e00",
                           out_colour = "#7c4d9e", ground_colour = "#fdfdfb";

using Outlines = std::vector<std::vector<Vec2>>;

/// The outlines as the `d` of a path, whose holes come out by the rule of even and odd.
std::string path_of(const MappingView& view, const Outlines& outlines) {
  std::string d;
  for (const auto& outline : outlines) {
    char command = 'M';
    for (const Vec2 corner : outline) {
      const Vec2 p = view(corner);
      fmt::format_to(std::back_inserter(d), "{}{:.1f} {:.1f}", command, p.x, p.y);
      command = 'L';
    }
    d += 'Z';
  }
  return d;
}

std::string shape(const MappingView& view, const Outlines& outlines, std::string_view paint) {
  return fmt::format("<path fill-rule=\"evenodd\" {} d=\"{}\"/>\n", paint, path_of(view, outlines));
}

/// The area hatched, with what can be reached blank on it.
std::string ground(const MappingView& view, const ReportCover& cover) {
  const std::string hatch = fmt::format(
      "<pattern id=\"out\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><rect width=\"6\" height=\"6\" fill=\"{}\"/>"
      "<rect width=\"2\" height=\"6\" fill=\"{}\"/></pattern>\n",
      ground_colour, out_colour);
  return hatch + shape(view, cover.area, "fill=\"url(#out)\"") +
         shape(view, cover.reach, fmt::format("fill=\"{}\"", ground_colour));
}

std::string planned_line(const MappingView& view, const std::vector<Vec2>& planned) {
  std::string points;
  for (const Vec2 corner : planned) {
    const Vec2 p = view(corner);
    fmt::format_to(std::back_inserter(points), "{:.1f},{:.1f} ", p.x, p.y);
  }
  return fmt::format(
      "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"0.7\" stroke-opacity=\"0.7\" points=\"{}\"/>\n",
      planned_colour, points);
}

Box2 drawn_area(const PageReport& report) {
  Box2 box;
  for (const auto& outline : report.cover->area) {
    for (const Vec2 p : outline) box.include(p);
  }
  for (const TrackSample& sample : report.track) box.include(sample.pose.position);
  box.include(report.start.position);
  return box.grown(0.01 * norm(box.size()));
}

}  // namespace

std::string cover_picture(const PageReport& report, double seconds) {
  const ReportCover& cover = *report.cover;
  const MappingView view = mapping_view(report, drawn_area(report), {}, seconds);
  const auto keys = mapping_keys(view, report.track);
  const double width_m = std::isfinite(cover.width_m) ? cover.width_m : 0.0;
  std::string svg = mapping_head(view, report,
                                 {{covered_colour, "covered"},
                                  {way_colour, "way"},
                                  {planned_colour, "planned"},
                                  {missed_colour, "missed in the end"},
                                  {out_colour, "out of reach"}});
  svg += ground(view, cover);
  svg += "<g stroke-opacity=\"0.3\" stroke-linecap=\"round\" stroke-linejoin=\"round\">" +
         growing_line(view, keys, covered_colour, view.scale * width_m) + "</g>\n";
  svg += planned_line(view, cover.planned) + growing_line(view, keys, way_colour, 1.6);
  svg += "<g>" + view.from(1.0 - mapping_still_end) +
         shape(view, cover.missed, fmt::format("fill=\"{0}\" stroke=\"{0}\"", missed_colour)) + "</g>\n";
  svg += shape(view, cover.area, "fill=\"none\" stroke=\"#222\" stroke-width=\"1.5\"");
  return svg + moving_robot(view, keys, report.robot_radius_m) + mapping_foot(view);
}

}  // namespace outrider
