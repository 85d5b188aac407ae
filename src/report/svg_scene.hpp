// Functions that the parts of the animated picture share: the scale, the loop, and how values move over it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "keyframes.hpp"
#include "outrider/report/page_report.hpp"

namespace outrider {

// Water is blue, the robot amber; the states are apart for every kind of colour vision and by shape.
inline constexpr std::string_view water = "#62c6ff";
inline constexpr std::string_view robot_colour = "#ffc857";
inline constexpr std::string_view waiting = "#a9b8c4";

/// Returns the colour of a target's status.
std::string_view colour(std::string_view status);

/// Three decimals (1 mm), without zeros at the end.
std::string number(double value);
std::string point(Vec2 p);

/// Values of one attribute over the loop.
struct Frames {
  std::string times;
  std::string values;

  void add(double share, std::string_view value) {
    if (!times.empty()) {
      times += ';';
      values += ';';
    }
    times += fmt::format("{:.5g}", std::round(std::clamp(share, 0.0, 1.0) * 1e5) / 1e5);
    values += value;
  }
};

struct Scene {
  const PageReport& report;
  LoopClock clock;
  Box2 area;
  double scale = 1.0;       // px per m
  double tolerance = 0.01;  // of the motion, m; half of it in rad

  [[nodiscard]] double pixels(double px) const { return px / scale; }
  [[nodiscard]] double share(double run_s) const { return clock.to_loop(run_s) / clock.loop_s(); }

  [[nodiscard]] std::string animate(std::string_view attribute, const Frames& frames,
                                    std::string_view mode = "linear") const {
    return fmt::format(
        R"svg(<animate attributeName="{}" dur="{}s" repeatCount="indefinite" calcMode="{}" keyTimes="{}" values="{}"/>)svg",
        attribute, number(clock.loop_s()), mode, frames.times, frames.values);
  }
  [[nodiscard]] std::string transform(std::string_view type, const Frames& frames) const {
    return fmt::format(
        R"svg(<animateTransform attributeName="transform" type="{}" dur="{}s" repeatCount="indefinite" keyTimes="{}" values="{}"/>)svg",
        type, number(clock.loop_s()), frames.times, frames.values);
  }
  /// Shown from one share of the loop to another.
  [[nodiscard]] std::string shown(double from, double to) const {
    if (from <= 0.0 && to >= 1.0) return {};
    Frames frames;
    frames.add(0.0, from <= 0.0 ? "1" : "0");
    if (from > 0.0) frames.add(from, "1");
    if (to < 1.0) frames.add(to, "0");
    return animate("opacity", frames, "discrete");
  }
};

/// Numbers that are not known cannot be drawn.
bool can_be_drawn(const ReportShot& shot);

/// The grid, the solids and the targets with their changes of state (svg_yard.cpp).
std::string yard(const Scene& scene);
/// The robot, its way and the flights (svg_motion.cpp).
std::string motion(const Scene& scene);

}  // namespace outrider
