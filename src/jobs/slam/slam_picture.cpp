#include "slam_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double size_px = 860.0;
constexpr double margin_px = 24.0;
constexpr double legend_px = 34.0;

/// The transform from world to picture: metres to pixels, y down.
struct View {
  Vec2 low;
  Vec2 high;
  double scale = 1.0;
  [[nodiscard]] Vec2 at(Vec2 p) const {
    return {margin_px + scale * (p.x - low.x), margin_px + scale * (high.y - p.y)};
  }
  [[nodiscard]] Vec2 size() const {
    return {2.0 * margin_px + scale * (high.x - low.x), 2.0 * margin_px + scale * (high.y - low.y)};
  }
};

/// Returns the view of the estimates; odometry may leave the picture.
View view_of(const SlamPicture& picture) {
  std::vector<Vec2> points = picture.truth;
  for (const auto& track : picture.driven) points.insert(points.end(), track.begin(), track.end());
  for (const LandmarkEstimate& landmark : picture.landmarks) points.push_back(landmark.position);
  if (points.empty()) points.emplace_back();
  View view{points.front(), points.front(), 1.0};
  for (const Vec2 p : points) {
    view.low = {std::min(view.low.x, p.x), std::min(view.low.y, p.y)};
    view.high = {std::max(view.high.x, p.x), std::max(view.high.y, p.y)};
  }
  const double widest = std::max({view.high.x - view.low.x, view.high.y - view.low.y, 1e-3});
  view.scale = size_px / widest;
  return view;
}

std::string lines(const View& view, const std::vector<std::vector<Vec2>>& tracks, const char* kind) {
  std::string d;
  for (const auto& track : tracks) {
    for (std::size_t i = 0; i < track.size(); ++i) {
      const Vec2 p = view.at(track[i]);
      fmt::format_to(std::back_inserter(d), "{}{:.1f} {:.1f}", i == 0 ? 'M' : 'L', p.x, p.y);
    }
  }
  return d.empty() ? d : fmt::format("<path class=\"{}\" d=\"{}\"/>\n", kind, d);
}

/// Returns the 95 % ellipse, or a dot if it is smaller than one.
std::string ellipse(const View& view, const LandmarkEstimate& landmark) {
  constexpr double share_95 = 5.991464547;  // of chi squared with 2 degrees of freedom
  const Eigen::Matrix2d& c = landmark.covariance;
  const double middle = 0.5 * (c(0, 0) + c(1, 1));
  const double spread = std::hypot(0.5 * (c(0, 0) - c(1, 1)), c(0, 1));
  const double turn_rad = 0.5 * std::atan2(2.0 * c(0, 1), c(0, 0) - c(1, 1));
  const auto radius = [&](double variance) {
    return view.scale * std::sqrt(share_95 * std::max(0.0, variance));
  };
  const Vec2 p = view.at(landmark.position);
  return fmt::format(
      "<g transform=\"translate({:.1f} {:.1f})\"><ellipse class=\"sure\" rx=\"{:.2f}\" ry=\"{:.2f}\" "
      "transform=\"rotate({:.2f})\"/><circle class=\"mark\" r=\"2.2\"/><title>{}</title></g>\n",
      p.x, p.y, radius(middle + spread), radius(middle - spread), -degrees(turn_rad), landmark.id);
}

std::string legend(double y, const SlamPicture& picture) {
  struct LegendEntry {
    const char* kind;
    const char* word;
    bool shown;
  };
  const LegendEntry entries[] = {{"driven", "estimated", !picture.driven.empty()},
                                 {"odometry", "odometry alone", !picture.odometry.empty()},
                                 {"loop", "loop closures", !picture.loops.empty()},
                                 {"sure", "landmarks, 95 %", !picture.landmarks.empty()},
                                 {"truth", "true places", !picture.truth.empty()}};
  std::string text;
  double x = margin_px;
  for (const LegendEntry& entry : entries) {
    if (!entry.shown) continue;
    fmt::format_to(std::back_inserter(text),
                   "<path class=\"{}\" d=\"M{:.0f} {:.0f}h22\"/><text x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n",
                   entry.kind, x, y, x + 28.0, y + 4.0, entry.word);
    x += 46.0 + 7.0 * static_cast<double>(std::string_view(entry.word).size());
  }
  return text;
}

constexpr const char* style =
    "<style>svg{background:#fff}path{fill:none;stroke-linejoin:round}.driven{stroke:#1f5fbf;stroke-width:1.4}"
    ".odometry{stroke:#999;stroke-width:1;stroke-dasharray:4 3}.loop{stroke:#d9903c;stroke-width:.7;"
    "opacity:.6}.sure{fill:#2c9c5a33;stroke:#2c9c5a;stroke-width:1}.mark{fill:#2c9c5a}.truth{stroke:#c0392b;"
    "stroke-width:1.4}text{font:13px sans-serif;fill:#333}@media(prefers-color-scheme:dark){svg{"
    "background:#16181d}text{fill:#ddd}.driven{stroke:#6ea8ff}}</style>\n";

}  // namespace

std::string to_svg(const SlamPicture& picture) {
  const View view = view_of(picture);
  const Vec2 size = view.size();
  const double width = std::max(size.x, 640.0), height = size.y + legend_px;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\" "
      "height=\"{:.0f}\">\n{}<clipPath id=\"map\"><rect width=\"{:.0f}\" height=\"{:.0f}\"/></clipPath>\n"
      "<g clip-path=\"url(#map)\">\n",
      width, height, width, height, style, width, size.y);
  svg += lines(view, picture.loops, "loop");
  svg += lines(view, picture.odometry, "odometry");
  svg += lines(view, picture.driven, "driven");
  for (const LandmarkEstimate& landmark : picture.landmarks) svg += ellipse(view, landmark);
  for (const Vec2 place : picture.truth) {
    const Vec2 p = view.at(place);
    fmt::format_to(std::back_inserter(svg), "<path class=\"truth\" d=\"M{:.1f} {:.1f}l8 8m0 -8l-8 8\"/>\n",
                   p.x - 4.0, p.y - 4.0);
  }
  return svg + "</g>\n" + legend(size.y + 0.4 * legend_px, picture) + "</svg>\n";
}

}  // namespace outrider
