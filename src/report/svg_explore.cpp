#include "svg_explore.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "keyframes.hpp"
#include "outrider/core/units.hpp"
#include "svg_scene.hpp"
#include "text.hpp"

namespace outrider {
namespace {

constexpr double width_px = 900.0, pad_px = 24.0, head_px = 34.0, strip_px = 44.0;
constexpr double most_map_px = 860.0;
constexpr int most_frames = 50;      // in which the map grows
constexpr double still_end = 0.08;   // share of the loop that shows the end
constexpr double ellipse_px = 40.0;  // of the largest, to which all are enlarged, at most tenfold
constexpr double ellipses = 40.0;    // over the whole way
constexpr double most_cells = 4e6;   // of a map that is drawn
constexpr std::string_view truth_colour = "#0a6cc4", belief_colour = "#d55e00", refused_colour = "#7c4d9e",
                           home_colour = "#00785a", free_colour = "#fdfdfb", occupied_colour = "#262d33",
                           wall_colour = "#e0457b", unknown_colour = "#cfd6da";

struct Picture {
  const Report& report;
  const ReportExplore& explore;
  Box2 area;
  double scale = 1.0;     // px per m
  double enlarged = 1.0;  // of the ellipses
  double end_s = 1.0;
  double loop_s = 1.0;

  [[nodiscard]] Vec2 operator()(Vec2 p) const {
    return {0.5 * width_px + scale * (p.x - 0.5 * (area.low.x + area.high.x)),
            head_px + scale * (area.high.y - p.y)};
  }
  [[nodiscard]] double share(double time_s) const {
    return std::clamp((1.0 - still_end) * time_s / end_s, 0.0, 1.0);
  }
  [[nodiscard]] double bottom_px() const { return head_px + scale * area.size().y; }
  /// Shown from a share of the loop on; in a viewer that plays nothing, always.
  [[nodiscard]] std::string from(double share) const {
    if (share <= 0.0) return {};
    return fmt::format(
        R"(<animate attributeName="opacity" dur="{}s" repeatCount="indefinite" calcMode="discrete" keyTimes="0;{:.4f}" values="0;1"/>)",
        number(loop_s), std::min(share, 1.0));
  }
};

/// The map, and with a margin all walls that are near it.
Box2 drawn_area(const Report& report) {
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

/// Values of runs, one after the other; after the last one `otherwise`.
class Runs {
 public:
  Runs(const std::vector<int>& runs, int otherwise) : runs_(runs), otherwise_(otherwise) {}
  int next() {
    while (at_ + 1 < runs_.size() && used_ >= runs_[at_ + 1]) {
      at_ += 2;
      used_ = 0;
    }
    if (at_ + 1 >= runs_.size()) return otherwise_;
    ++used_;
    return runs_[at_];
  }

 private:
  const std::vector<int>& runs_;
  int otherwise_;
  std::size_t at_ = 0;
  int used_ = 0;
};

using States = std::array<std::string, 2>;  // paths of what is free and what is occupied

/// The cells in frames of equal time: horizontal runs of one state and frame are rectangles of a path.
std::vector<States> frames_of(const ReportMap& map, int frames, double end_s) {
  std::vector<States> paths(static_cast<std::size_t>(frames));
  Runs states(map.state_runs, 2), known(map.known_runs, 0);
  for (int row = 0; row < map.rows; ++row) {
    int begin = 0, state = 2, frame = 0;
    const auto flush = [&](int end) {
      if (state > 1 || state < 0 || end == begin) return;
      fmt::format_to(
          std::back_inserter(paths[static_cast<std::size_t>(frame)][static_cast<std::size_t>(state)]),
          "M{} {}h{}v1h-{}z", begin, row, end - begin, end - begin);
    };
    for (int column = 0; column < map.columns; ++column) {
      const int next_state = states.next();
      const double known_s = map.step_s * known.next();
      const int next_frame = std::clamp(static_cast<int>(frames * known_s / end_s), 0, frames - 1);
      if (next_state == state && (next_frame == frame || state == 2)) continue;
      flush(column);
      begin = column;
      state = next_state;
      frame = next_frame;
    }
    flush(map.columns);
  }
  return paths;
}

std::string cells(const Picture& picture) {
  const ReportMap& map = picture.explore.map;
  if (map.columns <= 0 || map.rows <= 0 || 1.0 * map.columns * map.rows > most_cells) return {};
  const Vec2 origin = picture(map.origin);
  const double cell_px = picture.scale * map.cell_m;
  std::string svg = fmt::format(
      "<g shape-rendering=\"crispEdges\" transform=\"translate({:.2f} {:.2f}) scale({:.5f} {:.5f})\">\n",
      origin.x, origin.y, cell_px, -cell_px);
  const auto frames = frames_of(map, most_frames, picture.end_s);
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    const auto& [free, occupied] = frames[frame];
    if (free.empty() && occupied.empty()) continue;
    svg += "<g>" + picture.from(picture.share(picture.end_s * static_cast<double>(frame) / most_frames));
    svg += fmt::format("<path fill=\"{}\" d=\"{}\"/><path fill=\"{}\" d=\"{}\"/></g>\n", free_colour, free,
                       occupied_colour, occupied);
  }
  return svg + "</g>\n";
}

std::string walls(const Picture& picture) {
  std::string d;
  for (const auto& wall : picture.explore.walls) {
    char command = 'M';
    for (const Vec2 corner : wall) {
      const Vec2 p = picture(corner);
      fmt::format_to(std::back_inserter(d), "{}{:.1f} {:.1f}", command, p.x, p.y);
      command = 'L';
    }
    d += 'Z';
  }
  return fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"1\" d=\"{}\"/>\n", wall_colour, d);
}

/// Positions over time in px, as few as keep them to half a pixel.
template <class Samples>
std::vector<Key> keys_of(const Picture& picture, const Samples& samples) {
  std::vector<Key> keys;
  for (const auto& sample : samples) keys.push_back({sample.time_s, picture(sample.pose.position)});
  return simplified(keys, 0.5);
}

/// A line that grows as it was driven.
std::string grown_line(const Picture& picture, const std::vector<Key>& keys, std::string_view colour,
                       double width) {
  if (keys.size() < 2) return {};
  double length = 0.0;
  for (std::size_t i = 1; i < keys.size(); ++i) length += distance(keys[i - 1].value, keys[i].value);
  std::string points, times = "0", offsets = "1";
  double driven = 0.0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0) driven += distance(keys[i - 1].value, keys[i].value);
    fmt::format_to(std::back_inserter(points), "{:.1f},{:.1f} ", keys[i].value.x, keys[i].value.y);
    fmt::format_to(std::back_inserter(times), ";{:.4f}", picture.share(keys[i].time));
    fmt::format_to(std::back_inserter(offsets), ";{:.4f}", 1.0 - driven / std::max(length, 1e-9));
  }
  return fmt::format(
      R"(<polyline fill="none" stroke="{}" stroke-width="{}" pathLength="1" stroke-dasharray="1 1" points="{}"><animate attributeName="stroke-dashoffset" dur="{}s" repeatCount="indefinite" keyTimes="{};1" values="{};0"/></polyline>)"
      "\n",
      colour, width, points, number(picture.loop_s), times, offsets);
}

/// Two standard deviations of the position, enlarged.
std::string ellipse(const Picture& picture, const ReportBelief& belief) {
  const double xx = belief.sigma_x_m * belief.sigma_x_m, yy = belief.sigma_y_m * belief.sigma_y_m;
  const double xy = belief.correlation * belief.sigma_x_m * belief.sigma_y_m;
  const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  const double px = 2.0 * picture.enlarged * picture.scale;
  const Vec2 at = picture(belief.pose.position);
  return fmt::format(
      "<ellipse rx=\"{:.1f}\" ry=\"{:.1f}\" transform=\"translate({:.1f} {:.1f}) "
      "rotate({:.1f})\">{}</ellipse>\n",
      px * std::sqrt(std::max(0.0, mean + half)), px * std::sqrt(std::max(0.0, mean - half)), at.x, at.y,
      -degrees(0.5 * std::atan2(2.0 * xy, xx - yy)), picture.from(picture.share(belief.time_s)));
}

std::string ways(const Picture& picture) {
  std::string svg = fmt::format("<g fill=\"{0}\" fill-opacity=\"0.12\" stroke=\"{0}\">\n", belief_colour);
  double next_s = 0.0;
  for (const ReportBelief& belief : picture.explore.beliefs) {
    if (belief.time_s < next_s) continue;
    next_s = belief.time_s + picture.end_s / ellipses;
    svg += ellipse(picture, belief);
  }
  svg += "</g>\n";
  svg += grown_line(picture, keys_of(picture, picture.report.track), truth_colour, 2.5);
  return svg + grown_line(picture, keys_of(picture, picture.explore.beliefs), belief_colour, 1.2);
}

std::string marks(const Picture& picture) {
  std::string svg;
  for (const ReportRefusal& refusal : picture.explore.refused) {
    const Vec2 p = picture(refusal.position);
    svg += fmt::format(
        "<path fill=\"none\" stroke=\"{}\" stroke-width=\"2.5\" d=\"M{:.1f} {:.1f}l8 8m0 -8l-8 8\">"
        "<title>{}</title>{}</path>\n",
        refused_colour, p.x - 4.0, p.y - 4.0, markup_text(refusal.reason), picture.from(1.0 - still_end));
  }
  const Vec2 home = picture(picture.report.start.position);
  return svg + fmt::format("<path fill=\"{}\" stroke=\"#fff\" d=\"M{:.1f} {:.1f}l9 8h-3v8h-12v-8h-3z\"/>\n",
                           home_colour, home.x, home.y - 8.0);
}

/// The robot, which goes its true way in the loop.
std::string robot(const Picture& picture) {
  const auto keys = keys_of(picture, picture.report.track);
  if (keys.empty()) return {};
  std::string times, xs, ys;
  const auto add = [&](double share, Vec2 p) {
    const char* const between = times.empty() ? "" : ";";
    times += fmt::format("{}{:.4f}", between, share);
    xs += fmt::format("{}{:.1f}", between, p.x);
    ys += fmt::format("{}{:.1f}", between, p.y);
  };
  add(0.0, keys.front().value);
  for (const Key& key : keys) add(picture.share(key.time), key.value);
  add(1.0, keys.back().value);
  std::string svg = fmt::format(
      "<circle r=\"{:.1f}\" cx=\"{:.1f}\" cy=\"{:.1f}\" fill=\"{}\" stroke=\"#fff\" "
      "stroke-width=\"1.5\">",
      std::max(5.0, picture.scale * picture.report.robot_radius_m), keys.back().value.x, keys.back().value.y,
      truth_colour);
  for (const auto& [attribute, values] : {std::pair{"cx", &xs}, std::pair{"cy", &ys}}) {
    svg += fmt::format(
        R"(<animate attributeName="{}" dur="{}s" repeatCount="indefinite" keyTimes="{}" values="{}"/>)",
        attribute, number(picture.loop_s), times, *values);
  }
  return svg + "</circle>\n";
}

/// How much larger the ellipses are drawn than they are.
double enlargement(const ReportExplore& explore, double scale) {
  double largest_m = 1e-6;
  for (const ReportBelief& belief : explore.beliefs) {
    largest_m = std::max({largest_m, belief.sigma_x_m, belief.sigma_y_m});
  }
  return std::clamp(std::floor(ellipse_px / (2.0 * scale * largest_m)), 1.0, 10.0);
}

std::string legend(double enlarged) {
  const std::string larger = enlarged > 1.0 ? fmt::format(" {:.0f} times as large", enlarged) : std::string();
  std::string svg;
  double x = pad_px;
  for (const auto& [colour, text] : {std::pair{truth_colour, std::string("true way")},
                                     {belief_colour, "believed way, 2 standard deviations" + larger},
                                     {wall_colour, std::string("true walls")},
                                     {occupied_colour, std::string("walls mapped")},
                                     {refused_colour, std::string("frontier refused")},
                                     {home_colour, std::string("home")}}) {
    svg += fmt::format("<text x=\"{:.0f}\" y=\"21\" fill=\"{}\">{}</text>\n", x, colour, text);
    x += 6.6 * static_cast<double>(text.size()) + 16.0;
  }
  return svg;
}

/// The clock and the bar of time.
std::string strip(const Picture& picture) {
  const double y = picture.bottom_px() + 0.5 * strip_px, left = pad_px + 64.0;
  const double length = width_px - pad_px - left;
  std::string svg;
  for (int frame = 0; frame <= most_frames; ++frame) {
    const double time_s = picture.end_s * frame / most_frames;
    const double until = frame < most_frames ? picture.share(picture.end_s * (frame + 1) / most_frames) : 1.0;
    const auto seconds = static_cast<long long>(std::min(std::round(time_s), 1e9));
    const bool last = frame == most_frames;
    svg += fmt::format(
        R"(<text x="{}" y="{:.0f}" opacity="{}"><animate attributeName="opacity" dur="{}s" repeatCount="indefinite" calcMode="discrete" keyTimes="0;{:.4f};{:.4f}" values="{};1;{}"/>{}:{:02}</text>)",
        pad_px, y + 5.0, last ? 1 : 0, number(picture.loop_s), picture.share(time_s), std::min(until, 1.0), 0,
        last ? 1 : 0, seconds / 60, seconds % 60);
  }
  return svg + fmt::format(
                   "\n<rect x=\"{0}\" y=\"{1:.1f}\" width=\"{2}\" height=\"4\" rx=\"2\" fill=\"#b9c2c8\"/>"
                   "<rect x=\"{0}\" y=\"{1:.1f}\" width=\"{2}\" height=\"4\" rx=\"2\" fill=\"{3}\">"
                   "<animate attributeName=\"width\" dur=\"{4}s\" repeatCount=\"indefinite\" "
                   "keyTimes=\"0;{5};1\" values=\"0;{2};{2}\"/></rect>\n",
                   left, y - 2.0, length, truth_colour, number(picture.loop_s), 1.0 - still_end);
}

}  // namespace

std::string explore_picture(const Report& report, double seconds) {
  Picture picture{report, *report.explore, drawn_area(report)};
  const Vec2 size{std::max(picture.area.size().x, 1e-3), std::max(picture.area.size().y, 1e-3)};
  picture.scale = std::min((width_px - 2.0 * pad_px) / size.x, most_map_px / size.y);
  picture.enlarged = enlargement(*report.explore, picture.scale);
  picture.end_s = std::max(report.track.empty() ? 0.0 : report.track.back().time_s, 1e-3);
  picture.loop_s = seconds;
  const double height_px = picture.bottom_px() + strip_px;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"{3}\"/>\n",
      width_px, height_px, markup_text(report.job + ": " + report.world_name), unknown_colour);
  return svg + legend(picture.enlarged) + cells(picture) + walls(picture) + ways(picture) + marks(picture) +
         robot(picture) + strip(picture) + "</svg>\n";
}

}  // namespace outrider
