#include "output/calibration_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider::cli {
namespace {

constexpr double width_px = 900.0;
constexpr double pad_px = 24.0;
constexpr double panel_px = 250.0;  ///< height of one panel
constexpr int columns = 3;
constexpr int band_steps = 24;
constexpr const char* run_colour = "#0a6cc4";
constexpr const char* law_colour = "#d55e00";

struct Panel {
  double left, top, width, height;
};

std::string text_at(double x, double y, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x, y, text);
}

std::string law_panel(const FittedLaw& law, const Panel& panel) {
  const bool turn = law.direction == Direction::counter_clockwise || law.direction == Direction::clockwise;
  const double unit = turn ? degrees(1.0) : 1.0;
  double last_s = 0.0, most = 0.0;
  for (const Vec2 p : law.points) {
    last_s = std::max(last_s, p.x);
    most = std::max(most, p.y);
  }
  last_s *= 1.05;
  most *= 1.1;
  const double bottom = panel.top + panel.height - 24.0, high = panel.height - 84.0;
  const auto at = [&](double time_s, double value) {
    return fmt::format("{:.1f},{:.1f} ", panel.left + panel.width * time_s / last_s,
                       bottom - high * std::clamp(value / most, -0.1, 1.2));
  };
  std::string upper, lower, line;
  for (int i = 0; i <= band_steps; ++i) {
    const double t = last_s * i / band_steps;
    const double value = law.offset.value + law.slope.value * t;
    upper += at(t, value + confidence_half_width(law, t));
    lower.insert(0, at(t, value - confidence_half_width(law, t)));
    line += at(t, value);
  }
  std::string svg = fmt::format(
      "<polyline points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\" fill=\"none\" stroke=\"#888\"/>\n",
      panel.left, bottom - high, panel.left, bottom, panel.left + panel.width, bottom);
  svg +=
      fmt::format("<polygon points=\"{}{}\" fill=\"{}\" fill-opacity=\"0.2\"/>\n", upper, lower, law_colour);
  svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", line,
                     law_colour);
  for (const Vec2 p : law.points) {
    const std::string xy = at(p.x, p.y);
    const std::size_t comma = xy.find(',');
    svg += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"3\" fill=\"{}\" fill-opacity=\"0.6\"/>\n",
                       xy.substr(0, comma), xy.substr(comma + 1, xy.size() - comma - 2), run_colour);
  }
  const char* name = turn ? "\u00b0" : " m";
  svg += text_at(panel.left, panel.top + 14.0,
                 fmt::format("{}, commanded {:.4g}{}/s", to_string(law.direction), unit * law.command, name));
  svg += text_at(
      panel.left, panel.top + 31.0,
      fmt::format("a = {:.4g} \u00b1 {:.2g}{}/s", unit * law.slope.value, unit * law.slope.half_width, name));
  svg += text_at(
      panel.left, panel.top + 48.0,
      fmt::format("b = {:.3g} \u00b1 {:.2g}{}", unit * law.offset.value, unit * law.offset.half_width, name));
  svg += text_at(panel.left, bottom + 16.0,
                 fmt::format("0 to {:.3g} s, 0 to {:.3g}{}", last_s, unit * most, name));
  return svg;
}

}  // namespace

std::string calibration_picture(const CalibrationFit& fit, const Chassis& chassis) {
  const int rows = (static_cast<int>(fit.laws.size()) + columns - 1) / columns;
  const double laws_px = pad_px + rows * panel_px;
  const double height_px = laws_px + 30.0 + 20.0 * static_cast<double>(fit.wheels.size()) + pad_px;
  const double panel_width = (width_px - (columns + 1) * pad_px) / columns;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" "
      "fill=\"#222\">\n<title>calibration</title>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fbfcfc\"/>\n",
      width_px, height_px);
  for (std::size_t i = 0; i < fit.laws.size(); ++i) {
    const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
    svg += law_panel(fit.laws[i], {pad_px + column * (panel_width + pad_px), pad_px + row * panel_px,
                                   panel_width, panel_px});
  }
  svg += text_at(pad_px, laws_px + 20.0, "gains of the wheels, relative to their mean");
  for (std::size_t i = 0; i < fit.wheels.size(); ++i) {
    svg += text_at(pad_px + 12.0, laws_px + 42.0 + 20.0 * static_cast<double>(i),
                   std::isfinite(fit.wheels[i].half_width)
                       ? fmt::format("{}: {:.4f} \u00b1 {:.4f}", chassis.wheels[i].name, fit.wheels[i].value,
                                     fit.wheels[i].half_width)
                       : fmt::format("{}: {:.4f}, which the runs do not tell", chassis.wheels[i].name,
                                     fit.wheels[i].value));
  }
  return svg + "</svg>\n";
}

}  // namespace outrider::cli
