// Parts that the animated pictures of mapping share: the view, the map as it grows, paths, uncertainty, and
// the clock.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "keyframes.hpp"
#include "outrider/report/page_report.hpp"
#include "svg_scene.hpp"

namespace outrider {

inline constexpr double mapping_width_px = 900.0, mapping_pad_px = 24.0, mapping_head_px = 34.0;
inline constexpr double mapping_still_end = 0.08;  // share of the loop that shows the end
inline constexpr std::string_view way_colour = "#0a6cc4", belief_colour = "#d55e00",
                                  occupied_colour = "#262d33", unknown_colour = "#cfd6da";

/// World to picture: metres to pixels, y down; times of the run to shares of the loop.
struct MappingView {
  Box2 area;
  double end_s = 1.0;
  double loop_s = 1.0;
  double scale = 1.0;     ///< px per m
  double enlarged = 1.0;  ///< of the ellipses

  [[nodiscard]] Vec2 operator()(Vec2 p) const {
    return {0.5 * mapping_width_px + scale * (p.x - 0.5 * (area.low.x + area.high.x)),
            mapping_head_px + scale * (area.high.y - p.y)};
  }
  [[nodiscard]] double share(double time_s) const {
    return std::clamp((1.0 - mapping_still_end) * time_s / end_s, 0.0, 1.0);
  }
  [[nodiscard]] double bottom_px() const { return mapping_head_px + scale * area.size().y; }
  /// Shown from a share of the loop on; in a viewer that plays nothing, always.
  [[nodiscard]] std::string from(double share) const {
    if (share <= 0.0) return {};
    return fmt::format(
        R"(<animate attributeName="opacity" dur="{}s" repeatCount="indefinite" calcMode="discrete" keyTimes="0;{:.4f}" values="0;1"/>)",
        number(loop_s), std::min(share, 1.0));
  }
};

/// A view of the area for a run that ends with its track, with ellipses as large as the beliefs need.
MappingView mapping_view(const PageReport& report, const Box2& area, const std::vector<ReportBelief>& beliefs,
                         double loop_s);

/// The beginning of the picture: its size, its ground, and names in their colours along the top.
std::string mapping_head(const MappingView& view, const PageReport& report,
                         const std::vector<std::pair<std::string_view, std::string>>& legend);

/// "believed way, 2 standard deviations 10 times as large"
std::string belief_legend(const MappingView& view);

std::string growing_map(const MappingView& view, const ReportMap& map);

/// Positions over time in px, as few as keep them to half a pixel.
template <class Samples>
std::vector<Key> mapping_keys(const MappingView& view, const Samples& samples) {
  std::vector<Key> keys;
  for (const auto& sample : samples) keys.push_back({sample.time_s, view(sample.pose.position)});
  return simplified(keys, 0.5);
}

/// A line that grows as it was driven.
std::string growing_line(const MappingView& view, const std::vector<Key>& keys, std::string_view colour,
                         double width);

/// Two standard deviations of a position, enlarged; shown from a time on.
std::string ellipse(const MappingView& view, Vec2 position, double sigma_x_m, double sigma_y_m,
                    double correlation, double time_s);

/// Some of the beliefs, as ellipses over the whole way.
std::string believed_ellipses(const MappingView& view, const std::vector<ReportBelief>& beliefs);

/// The robot, which goes its way in the loop.
std::string moving_robot(const MappingView& view, const std::vector<Key>& keys, double radius_m);

/// The clock and the bar of time, and the end of the picture.
std::string mapping_foot(const MappingView& view);

}  // namespace outrider
