#include "svg_slam.hpp"

#include <iterator>

#include "svg_mapping.hpp"

namespace outrider {
namespace {

constexpr std::string_view odometry_colour = "#7a858c", reference_colour = "#00785a", loop_colour = "#7c4d9e",
                           landmark_colour = "#00785a", truth_colour = "#262d33", ground_colour = "#fdfdfb";

/// The bounds that the report names; else all that was settled.
Box2 drawn_area(const PageReport& report) {
  Box2 box = report.bounds;
  if (box.empty()) {
    for (const TrackSample& sample : report.track) box.include(sample.pose.position);
    box.include(report.start.position);
    box = box.grown(0.5 + 0.01 * norm(box.size()));
  }
  return box;
}

/// Places at the times of the beliefs.
std::vector<Key> keys_of(const MappingView& view, const ReportSlam& slam, const std::vector<Vec2>& places) {
  std::vector<Key> keys;
  for (std::size_t i = 0; i < places.size() && i < slam.beliefs.size(); ++i)
    keys.push_back({slam.beliefs[i].time_s, view(places[i])});
  return simplified(keys, 0.5);
}

std::string ground(const MappingView& view) {
  const Vec2 corner = view({view.area.low.x, view.area.high.y});
  return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
                     corner.x, corner.y, view.scale * view.area.size().x, view.scale * view.area.size().y,
                     ground_colour);
}

std::string loops(const MappingView& view, const std::vector<ReportLoop>& all) {
  std::string svg = fmt::format("<g stroke=\"{}\" stroke-width=\"1.2\">\n", loop_colour);
  for (const ReportLoop& loop : all) {
    const Vec2 a = view(loop.from), b = view(loop.to);
    svg += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\">{}</path>\n", a.x, a.y, b.x, b.y,
                       view.from(view.share(loop.time_s)));
  }
  return svg + "</g>\n";
}

std::string landmarks(const MappingView& view, const std::vector<ReportLandmark>& all) {
  MappingView exact = view;
  exact.enlarged = 1.0;
  std::string svg = fmt::format("<g fill=\"{0}\" fill-opacity=\"0.2\" stroke=\"{0}\">\n", landmark_colour);
  for (const ReportLandmark& one : all) {
    const Vec2 at = view(one.position);
    svg +=
        ellipse(exact, one.position, one.sigma_x_m, one.sigma_y_m, one.correlation, one.first_s) +
        fmt::format(
            "<circle r=\"2.5\" cx=\"{:.1f}\" cy=\"{:.1f}\" fill-opacity=\"1\"><title>{}</title>{}</circle>\n",
            at.x, at.y, one.id, view.from(view.share(one.first_s)));
  }
  svg += "</g>\n";
  for (const ReportLandmark& one : all) {
    if (!one.truth) continue;
    const Vec2 at = view(*one.truth);
    svg +=
        fmt::format("<path stroke=\"{}\" stroke-width=\"1.4\" d=\"M{:.1f} {:.1f}l8 8m0 -8l-8 8\">{}</path>\n",
                    truth_colour, at.x - 4.0, at.y - 4.0, view.from(view.share(one.first_s)));
  }
  return svg;
}

std::vector<std::pair<std::string_view, std::string>> legend(const MappingView& view,
                                                             const ReportSlam& slam) {
  std::vector<std::pair<std::string_view, std::string>> names = {{way_colour, "way as settled"},
                                                                 {belief_colour, belief_legend(view)},
                                                                 {odometry_colour, "odometry alone"}};
  if (!slam.reference.empty()) names.emplace_back(reference_colour, "reference");
  if (!slam.loops.empty()) names.emplace_back(loop_colour, "loops closed");
  if (!slam.landmarks.empty()) names.emplace_back(landmark_colour, "landmarks");
  return names;
}

}  // namespace

std::string slam_picture(const PageReport& report, double seconds) {
  const ReportSlam& slam = *report.slam;
  const MappingView view = mapping_view(report, drawn_area(report), slam.beliefs, seconds);
  const auto keys = mapping_keys(view, report.track);
  const double bottom_px = view.bottom_px() - mapping_head_px;
  std::string svg = mapping_head(view, report, legend(view, slam));
  svg += fmt::format("<clipPath id=\"area\"><rect y=\"{}\" width=\"100%\" height=\"{:.1f}\"/></clipPath>\n",
                     mapping_head_px, bottom_px);
  svg += "<g clip-path=\"url(#area)\">\n";  // odometry may leave the picture
  svg += slam.map ? growing_map(view, *slam.map) : ground(view);
  svg += growing_line(view, keys_of(view, slam, slam.odometry), odometry_colour, 1.0);
  svg += growing_line(view, keys_of(view, slam, slam.reference), reference_colour, 1.4);
  svg += believed_ellipses(view, slam.beliefs) + loops(view, slam.loops);
  svg += growing_line(view, mapping_keys(view, slam.beliefs), belief_colour, 1.2);
  svg += growing_line(view, keys, way_colour, 2.0) + landmarks(view, slam.landmarks) + "</g>\n";
  return svg + moving_robot(view, keys, 0.0) + mapping_foot(view);
}

}  // namespace outrider
