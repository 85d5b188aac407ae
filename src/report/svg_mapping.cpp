#include "svg_mapping.hpp"

#include <array>
#include <cmath>
#include <iterator>

#include "outrider/core/units.hpp"
#include "text.hpp"

namespace outrider {
namespace {

constexpr double strip_px = 44.0;
constexpr double most_map_px = 860.0;
constexpr int most_frames = 50;      // in which the map grows
constexpr double ellipse_px = 40.0;  // of the largest, to which all are enlarged, at most tenfold
constexpr double ellipses = 40.0;    // over the whole way
constexpr std::string_view free_colour = "#fdfdfb";

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
      const double share = frames * known_s / end_s;
      const int next_frame = share > 0.0 ? static_cast<int>(std::min(share, frames - 1.0)) : 0;
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

/// How much larger the ellipses are drawn than they are.
double enlargement(const std::vector<ReportBelief>& beliefs, double scale) {
  double largest_m = 1e-6;
  for (const ReportBelief& belief : beliefs)
    largest_m = std::max({largest_m, belief.sigma_x_m, belief.sigma_y_m});
  return std::clamp(std::floor(ellipse_px / (2.0 * scale * largest_m)), 1.0, 10.0);
}

}  // namespace

MappingView mapping_view(const PageReport& report, const Box2& area, const std::vector<ReportBelief>& beliefs,
                         double loop_s) {
  MappingView view{area, std::max(report.track.empty() ? 0.0 : report.track.back().time_s, 1e-3), loop_s};
  const Vec2 size{std::max(area.size().x, 1e-3), std::max(area.size().y, 1e-3)};
  view.scale = std::min((mapping_width_px - 2.0 * mapping_pad_px) / size.x, most_map_px / size.y);
  view.enlarged = enlargement(beliefs, view.scale);
  return view;
}

std::string mapping_head(const MappingView& view, const PageReport& report,
                         const std::vector<std::pair<std::string_view, std::string>>& legend) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"{3}\"/>\n",
      mapping_width_px, view.bottom_px() + strip_px, markup_text(report.job + ": " + report.world_name),
      unknown_colour);
  double x = mapping_pad_px;
  for (const auto& [colour, text] : legend) {
    svg += fmt::format("<text x=\"{:.0f}\" y=\"21\" fill=\"{}\">{}</text>\n", x, colour, text);
    x += 6.6 * static_cast<double>(text.size()) + 16.0;
  }
  return svg;
}

std::string belief_legend(const MappingView& view) {
  return "believed way, 2 standard deviations" +
         (view.enlarged > 1.0 ? fmt::format(" {:.0f} times as large", view.enlarged) : std::string());
}

std::string growing_map(const MappingView& view, const ReportMap& map) {
  if (map.columns <= 0 || map.rows <= 0 || std::int64_t{map.columns} * map.rows > most_drawn_cells) return {};
  const Vec2 origin = view(map.origin);
  const double cell_px = view.scale * map.cell_m;
  std::string svg = fmt::format(
      "<g shape-rendering=\"crispEdges\" transform=\"translate({:.2f} {:.2f}) scale({:.5f} {:.5f})\">\n",
      origin.x, origin.y, cell_px, -cell_px);
  const auto frames = frames_of(map, most_frames, view.end_s);
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    const auto& [free, occupied] = frames[frame];
    if (free.empty() && occupied.empty()) continue;
    svg += "<g>" + view.from(view.share(view.end_s * static_cast<double>(frame) / most_frames));
    svg += fmt::format("<path fill=\"{}\" d=\"{}\"/><path fill=\"{}\" d=\"{}\"/></g>\n", free_colour, free,
                       occupied_colour, occupied);
  }
  return svg + "</g>\n";
}

std::string growing_line(const MappingView& view, const std::vector<Key>& keys, std::string_view colour,
                         double width) {
  if (keys.size() < 2) return {};
  double length = 0.0;
  for (std::size_t i = 1; i < keys.size(); ++i) length += distance(keys[i - 1].value, keys[i].value);
  std::string points, times = "0", offsets = "1";
  double driven = 0.0;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i > 0) driven += distance(keys[i - 1].value, keys[i].value);
    fmt::format_to(std::back_inserter(points), "{:.1f},{:.1f} ", keys[i].value.x, keys[i].value.y);
    fmt::format_to(std::back_inserter(times), ";{:.6f}", view.share(keys[i].time));
    fmt::format_to(std::back_inserter(offsets), ";{:.6f}", 1.0 - driven / std::max(length, 1e-9));
  }
  return fmt::format(
      R"(<polyline fill="none" stroke="{}" stroke-width="{}" pathLength="1" stroke-dasharray="1 1" points="{}"><animate attributeName="stroke-dashoffset" dur="{}s" repeatCount="indefinite" keyTimes="{};1" values="{};0"/></polyline>)"
      "\n",
      colour, width, points, number(view.loop_s), times, offsets);
}

std::string ellipse(const MappingView& view, Vec2 position, double sigma_x_m, double sigma_y_m,
                    double correlation, double time_s) {
  const double xx = sigma_x_m * sigma_x_m, yy = sigma_y_m * sigma_y_m;
  const double xy = correlation * sigma_x_m * sigma_y_m;
  const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  const double px = 2.0 * view.enlarged * view.scale;
  const Vec2 at = view(position);
  return fmt::format(
      "<ellipse rx=\"{:.1f}\" ry=\"{:.1f}\" transform=\"translate({:.1f} {:.1f}) "
      "rotate({:.1f})\">{}</ellipse>\n",
      px * std::sqrt(std::max(0.0, mean + half)), px * std::sqrt(std::max(0.0, mean - half)), at.x, at.y,
      -degrees(0.5 * std::atan2(2.0 * xy, xx - yy)), view.from(view.share(time_s)));
}

std::string believed_ellipses(const MappingView& view, const std::vector<ReportBelief>& beliefs) {
  std::string svg = fmt::format("<g fill=\"{0}\" fill-opacity=\"0.12\" stroke=\"{0}\">\n", belief_colour);
  double next_s = 0.0;
  for (const ReportBelief& belief : beliefs) {
    if (belief.time_s < next_s) continue;
    next_s = belief.time_s + view.end_s / ellipses;
    svg += ellipse(view, belief.pose.position, belief.sigma_x_m, belief.sigma_y_m, belief.correlation,
                   belief.time_s);
  }
  return svg + "</g>\n";
}

std::string moving_robot(const MappingView& view, const std::vector<Key>& keys, double radius_m) {
  if (keys.empty()) return {};
  std::string times, xs, ys;
  const auto add = [&](double share, Vec2 p) {
    const char* const between = times.empty() ? "" : ";";
    times += fmt::format("{}{:.6f}", between, share);
    xs += fmt::format("{}{:.1f}", between, p.x);
    ys += fmt::format("{}{:.1f}", between, p.y);
  };
  add(0.0, keys.front().value);
  for (const Key& key : keys) add(view.share(key.time), key.value);
  add(1.0, keys.back().value);
  std::string svg = fmt::format(
      "<circle r=\"{:.1f}\" cx=\"{:.1f}\" cy=\"{:.1f}\" fill=\"{}\" stroke=\"#fff\" "
      "stroke-width=\"1.5\">",
      std::max(5.0, view.scale * radius_m), keys.back().value.x, keys.back().value.y, way_colour);
  for (const auto& [attribute, values] : {std::pair{"cx", &xs}, std::pair{"cy", &ys}}) {
    svg += fmt::format(
        R"(<animate attributeName="{}" dur="{}s" repeatCount="indefinite" keyTimes="{}" values="{}"/>)",
        attribute, number(view.loop_s), times, *values);
  }
  return svg + "</circle>\n";
}

std::string mapping_foot(const MappingView& view) {
  const double y = view.bottom_px() + 0.5 * strip_px, left = mapping_pad_px + 64.0;
  const double length = mapping_width_px - mapping_pad_px - left;
  std::string svg;
  for (int frame = 0; frame <= most_frames; ++frame) {
    const double time_s = view.end_s * frame / most_frames;
    const double until = frame < most_frames ? view.share(view.end_s * (frame + 1) / most_frames) : 1.0;
    const auto seconds = static_cast<long long>(std::min(std::round(time_s), 1e9));
    const bool last = frame == most_frames;
    svg += fmt::format(
        R"(<text x="{}" y="{:.0f}" opacity="{}"><animate attributeName="opacity" dur="{}s" repeatCount="indefinite" calcMode="discrete" keyTimes="0;{:.4f};{:.4f}" values="{};1;{}"/>{}:{:02}</text>)",
        mapping_pad_px, y + 5.0, last ? 1 : 0, number(view.loop_s), view.share(time_s), std::min(until, 1.0),
        0, last ? 1 : 0, seconds / 60, seconds % 60);
  }
  return svg +
         fmt::format(
             "\n<rect x=\"{0}\" y=\"{1:.1f}\" width=\"{2}\" height=\"4\" rx=\"2\" fill=\"#b9c2c8\"/>"
             "<rect x=\"{0}\" y=\"{1:.1f}\" width=\"{2}\" height=\"4\" rx=\"2\" fill=\"{3}\">"
             "<animate attributeName=\"width\" dur=\"{4}s\" repeatCount=\"indefinite\" "
             "keyTimes=\"0;{5};1\" values=\"0;{2};{2}\"/></rect>\n",
             left, y - 2.0, length, way_colour, number(view.loop_s), 1.0 - mapping_still_end) +
         "</svg>\n";
}

}  // namespace outrider
