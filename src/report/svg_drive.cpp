#include "svg_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "text.hpp"

namespace outrider {
namespace {

constexpr double width_px = 900.0;
constexpr double pad_px = 24.0;
constexpr double chart_px = 150.0;
constexpr double most_map_px = 900.0;
constexpr double closed_loop_scale = 5.0;  ///< of ellipses; those of the open loop are large as they are
constexpr double ellipse_every_s = 2.0;
constexpr std::string_view truth_colour = "#0a6cc4", belief_colour = "#d55e00", tag_colour = "#00785a",
                           solid_colour = "#3f454b", stop_colour = "#7c4d9e", paper_colour = "#fbfcfc";

/// Metres to pixels.
struct Map {
  Vec2 low;
  double top_px = 0.0;
  double left_px = 0.0;
  double scale = 1.0;

  [[nodiscard]] Vec2 operator()(Vec2 p) const {
    return {left_px + scale * (p.x - low.x), top_px - scale * (p.y - low.y)};
  }
};

std::string polyline(const std::vector<Vec2>& points, std::string_view colour, std::string_view more) {
  std::string text = fmt::format("<polyline fill=\"none\" stroke=\"{}\" {} points=\"", colour, more);
  for (const Vec2 p : points) text += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
  return text + "\"/>\n";
}

std::string label(Vec2 at, std::string_view colour, std::string_view text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n", at.x, at.y, colour,
                     markup_text(text));
}

/// Returns the box of the driven path with a margin, within the bounds.
Box2 drawn_area(const PageReport& report) {
  Box2 box;
  for (const TrackSample& sample : report.track) box.include(sample.pose.position);
  for (const ReportStop& stop : report.drive->stops) box.include(stop.pose.position);
  for (const ReportTag& tag : report.drive->tags) box.include(tag.position);
  for (const ReportSolid& solid : report.solids) {
    for (const RoundedPolygon& piece : solid.footprint) {
      box.include(piece.bounds().low);
      box.include(piece.bounds().high);
    }
  }
  if (box.empty()) box = report.bounds;
  return box.grown(report.robot_radius_m + 0.1);
}

std::string solids(const PageReport& report, const Map& map) {
  std::string text;
  for (const ReportSolid& solid : report.solids) {
    for (const RoundedPolygon& piece : solid.footprint) {
      text += fmt::format("<polygon fill=\"{}\" points=\"", solid_colour);
      for (const Vec2 corner : circumscribed(piece, radians(10.0))) {
        text += fmt::format("{:.1f},{:.1f} ", map(corner).x, map(corner).y);
      }
      text += "\"/>\n";
    }
  }
  return text;
}

std::string tags(const ReportDrive& drive, const Map& map) {
  std::string text;
  for (const ReportTag& tag : drive.tags) {
    const Vec2 out = direction(tag.facing_rad);
    const Vec2 side = 0.5 * tag.size_m * perpendicular(out);
    text += polyline({map(tag.position - side), map(tag.position + side)}, tag_colour, "stroke-width=\"5\"");
    text += polyline({map(tag.position), map(tag.position + 0.5 * tag.size_m * out)}, tag_colour,
                     "stroke-width=\"1.5\"");
    const std::string name = fmt::format("tag {}", tag.id);
    const double half_px = 4.0 * static_cast<double>(name.size());
    const Vec2 beyond_px{(half_px + 6.0) * out.x,
                         -12.0 * out.y};  // of the stroke, for the middle of the name
    text +=
        label(map(tag.position + 0.5 * tag.size_m * out) + beyond_px + Vec2{-half_px, 5.0}, tag_colour, name);
  }
  return text;
}

std::string stops(const PageReport& report, const Map& map) {
  std::string text;
  for (std::size_t i = 0; i < report.drive->stops.size(); ++i) {
    const ReportStop& stop = report.drive->stops[i];
    const Vec2 at = map(stop.pose.position);
    const double radius = map.scale * report.robot_radius_m;
    if (!stop.stop) {
      text +=
          fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", at.x, at.y, stop_colour);
      continue;
    }
    text += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\" fill-opacity=\"0.08\" "
        "stroke=\"{}\"/>\n",
        at.x, at.y, radius, stop_colour, stop_colour);
    const Vec2 nose = stop.pose.position + report.robot_radius_m * direction(stop.pose.heading_rad);
    text += polyline({at, map(nose)}, stop_colour, "stroke-width=\"2\"");
    const double row = 15.0 * static_cast<double>(i);  // stops may lie on one another
    text += label(at + Vec2{radius + 4.0, row}, stop_colour,
                  std::isnan(stop.time_s)
                      ? fmt::format("{}: not reached", i + 1)
                      : fmt::format("{}: {:.0f} mm, {:.1f}\u00b0 off", i + 1, 1e3 * norm(stop.error),
                                    std::abs(degrees(stop.heading_error_rad))));
  }
  return text;
}

double ellipse_scale(const ReportDrive& drive) { return drive.loop == "closed" ? closed_loop_scale : 1.0; }

/// Two standard deviations of the position, enlarged.
std::string ellipse(const ReportBelief& belief, const Map& map, double enlarged) {
  const double xx = belief.sigma_x_m * belief.sigma_x_m, yy = belief.sigma_y_m * belief.sigma_y_m;
  const double xy = belief.correlation * belief.sigma_x_m * belief.sigma_y_m;
  const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double px = 2.0 * enlarged * map.scale;
  const Vec2 at = map(belief.pose.position);
  return fmt::format(
      "<ellipse rx=\"{:.1f}\" ry=\"{:.1f}\" fill=\"{}\" fill-opacity=\"0.12\" stroke=\"{}\" "
      "transform=\"translate({:.1f} {:.1f}) rotate({:.1f})\"/>\n",
      px * std::sqrt(std::max(0.0, mean + half)), px * std::sqrt(std::max(0.0, mean - half)), belief_colour,
      belief_colour, at.x, at.y, -degrees(angle));
}

std::string ways(const PageReport& report, const Map& map) {
  std::string text;
  double next_s = 0.0;
  std::vector<Vec2> truth, believed;
  for (const TrackSample& sample : report.track) truth.push_back(map(sample.pose.position));
  for (const ReportBelief& belief : report.drive->beliefs) {
    believed.push_back(map(belief.pose.position));
    if (belief.time_s < next_s) continue;
    next_s = belief.time_s + ellipse_every_s;
    text += ellipse(belief, map, ellipse_scale(*report.drive));
  }
  return text + polyline(truth, truth_colour, "stroke-width=\"3\"") +
         polyline(believed, belief_colour, "stroke-width=\"1.5\" stroke-dasharray=\"5 3\"");
}

/// How far the belief was from the truth, over time.
std::string chart(const PageReport& report, double top_px) {
  const auto& beliefs = report.drive->beliefs;
  const std::size_t count = std::min(beliefs.size(), report.track.size());
  if (count < 2) return {};
  double most_m = 0.01;
  std::vector<double> errors, bands;
  for (std::size_t i = 0; i < count; ++i) {
    errors.push_back(distance(beliefs[i].pose.position, report.track[i].pose.position));
    bands.push_back(2.0 * std::hypot(beliefs[i].sigma_x_m, beliefs[i].sigma_y_m));
    most_m = std::max({most_m, errors.back(), bands.back()});
  }
  const double end_s = std::max(report.track[count - 1].time_s, 1e-9);
  const double bottom_px = top_px + chart_px - 34.0, high_px = chart_px - 60.0;
  const auto at = [&](std::size_t i, double value) {
    return Vec2{pad_px + (width_px - 2.0 * pad_px) * report.track[i].time_s / end_s,
                bottom_px - high_px * value / most_m};
  };
  std::vector<Vec2> error, band = {{pad_px, bottom_px}};
  std::string marks;
  for (std::size_t i = 0; i < count; ++i) {
    error.push_back(at(i, errors[i]));
    band.push_back(at(i, bands[i]));
    if (beliefs[i].corrected) {
      marks += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"2\" height=\"4\" fill=\"{}\"/>\n",
                           at(i, 0.0).x, bottom_px + 3.0, tag_colour);
    }
  }
  band.push_back({width_px - pad_px, bottom_px});
  std::string text =
      polyline(band, "none", fmt::format("style=\"fill:{};fill-opacity:0.15\"", belief_colour));
  text += polyline(error, truth_colour, "stroke-width=\"1.5\"") + marks;
  text +=
      label({pad_px, top_px + 12.0}, "#222",
            fmt::format("distance of belief and truth; band: 2 standard deviations; top: {:.0f} mm; marks: a "
                        "tag was used; {:.1f} s",
                        1e3 * most_m, end_s));
  return text;
}

}  // namespace

std::string drive_picture(const PageReport& report) {
  const Box2 area = drawn_area(report);
  const double across_m = std::max(area.size().x, 1e-3), up_m = std::max(area.size().y, 1e-3);
  const double scale = std::min((width_px - 2.0 * pad_px) / across_m, most_map_px / up_m);
  const double bottom_px = pad_px + 22.0 + scale * up_m;
  const Map map{area.low, bottom_px, 0.5 * (width_px - scale * across_m), scale};
  const double height_px = bottom_px + pad_px + chart_px;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"{3}\"/>\n",
      width_px, height_px, markup_text(report.job + ": " + report.world_name), paper_colour);
  svg += label({pad_px, pad_px}, truth_colour, "true way");
  std::string believed = "believed way, ellipses of 2 standard deviations";
  const double enlarged = ellipse_scale(*report.drive);
  if (enlarged != 1.0) believed += fmt::format(", {:.0f} times as large", enlarged);
  svg += label({pad_px + 80.0, pad_px}, belief_colour, believed);
  svg += label({pad_px + 560.0, pad_px}, stop_colour, "waypoints with the true errors");
  svg += solids(report, map) + tags(*report.drive, map) + ways(report, map) + stops(report, map);
  // Wide ellipses end above the chart.
  svg += fmt::format("<rect y=\"{:.0f}\" width=\"100%\" height=\"100%\" fill=\"{}\"/>\n",
                     bottom_px + 0.5 * pad_px, paper_colour);
  return svg + chart(report, bottom_px + pad_px) + "</svg>\n";
}

}  // namespace outrider
