#include "svg_scene.hpp"

namespace outrider {

std::string_view colour(std::string_view status) {
  if (status == "reached") return "#2fd3a5";
  if (status == "failed") return "#ff8f4d";
  return "#c7a0e6";
}

std::string number(double value) {
  if (!std::isfinite(value)) return "0";
  std::string text = fmt::format("{:.3f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string point(Vec2 p) { return fmt::format("{} {}", number(p.x), number(p.y)); }

bool can_be_drawn(const ReportShot& shot) {
  const Vec3 sum = shot.muzzle + shot.velocity_mps + shot.contact_point;
  return shot.time_s >= 0.0 && shot.flight_s > 0.0 &&
         std::isfinite(sum.x + sum.y + sum.z + shot.time_s + shot.flight_s);
}

}  // namespace outrider
