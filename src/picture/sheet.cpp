#include "sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/polyline.hpp"

namespace outrider::picture {
namespace {

constexpr double letter_px = 6.9;
constexpr double most_marks = 3000.0;

std::string number(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : printable(text)) {
    const bool special = c == '<' || c == '>' || c == '&' || c == '"';
    safe += special ? fmt::format("&#{};", static_cast<int>(c)) : std::string(1, c);
  }
  return safe;
}

std::string mixed(unsigned first_rgb, unsigned last_rgb, double share) {
  unsigned result = 0;
  for (const unsigned shift : {16U, 8U, 0U}) {
    const double a = (first_rgb >> shift) & 0xffU, b = (last_rgb >> shift) & 0xffU;
    result |= static_cast<unsigned>(std::lround(a + std::clamp(share, 0.0, 1.0) * (b - a))) << shift;
  }
  return fmt::format("#{:06x}", result);
}

std::string polyline(const std::vector<Vec2>& points_px) {
  std::string path;
  for (std::size_t i = 0; i < points_px.size(); ++i) {
    if (!finite(points_px[i])) return {};
    path += i == 0 ? "M" : i == 1 ? "L" : " ";
    path += number(points_px[i].x) + " " + number(points_px[i].y);
  }
  return path;
}

std::string shape_at(Vec2 middle_px, std::string_view shape) {
  const std::string start = polyline({middle_px});
  return start.empty() ? start : start + std::string(shape);
}

Vec2 Sheet::at(Vec2 world) {
  if (finite(world)) seen.include(world);
  return px_per_m * Vec2{world.x - box.low.x, box.high.y - world.y};
}

std::string Sheet::line(const std::vector<Vec2>& points) {
  std::string path;
  std::vector<Vec2> part;
  for (std::size_t i = 0; i <= points.size(); ++i) {
    if (i < points.size() && finite(points[i])) {
      part.push_back(at(points[i]));
      continue;
    }
    if (part.size() > 1) path += polyline(simplified(part, detail_px));
    part.clear();
  }
  return path;
}

std::string Sheet::area(const std::vector<Vec2>& corners) {
  std::vector<Vec2> ring;
  for (const Vec2 corner : corners) ring.push_back(at(corner));
  if (ring.size() < 3 || !std::ranges::all_of(ring, [](Vec2 p) { return finite(p); })) return {};
  ring.push_back(ring.front());
  return polyline(simplified(ring, detail_px)) + "Z";
}

std::string Sheet::area(const RoundedPolygon& shape) {
  if (shape.core.empty() || !std::isfinite(shape.radius_m)) return {};
  return area(circumscribed(shape, radians(15.0)));
}

std::string Sheet::ellipse(Vec2 centre, double variance_x, double covariance, double variance_y) {
  const double middle = 0.5 * (variance_x + variance_y);
  const double away = std::hypot(0.5 * (variance_x - variance_y), covariance);
  const double turn_rad = -0.5 * std::atan2(2.0 * covariance, variance_x - variance_y);
  const double major_px = std::max(0.5, 2.0 * px_per_m * std::sqrt(std::max(0.0, middle + away)));
  const double minor_px = std::max(0.5, 2.0 * px_per_m * std::sqrt(std::max(0.0, middle - away)));
  if (!std::isfinite(middle + away)) return {};
  const Vec2 side = major_px * direction(turn_rad);
  const std::string arc =
      fmt::format("a{} {} {} 1 0 ", number(major_px), number(minor_px), number(degrees(turn_rad)));
  const auto step = [](Vec2 by) { return number(by.x) + " " + number(by.y); };
  return shape_at(at(centre) - side, arc + step(2.0 * side) + arc + step(-2.0 * side) + "Z");
}

void Sheet::put(std::string_view kind, const std::string& path, std::string_view sample,
                const std::string& words, const std::string& style) {
  if (path.empty()) return;
  const std::string look =
      fmt::format("class=\"{}\"{}", kind, style.empty() ? "" : " style=\"" + style + "\"");
  body += fmt::format("<path {} d=\"{}\"/>\n", look, path);
  if (words.empty() || std::ranges::count(entries, words, &decltype(entries)::value_type::first) > 0) return;
  entries.emplace_back(words, fmt::format("<path {} d=\"{}\"/>", look, sample));
}

void Sheet::marks(std::string_view kind, const std::vector<Vec2>& places, std::string_view shape,
                  const std::string& words) {
  const double share = static_cast<double>(places.size()) / most_marks * std::max(1.0, detail_px / 0.3);
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(share)));
  std::string path;
  for (std::size_t i = 0; i < places.size(); i += stride) path += shape_at(at(places[i]), shape);
  put(kind, path, shape_at({15.0, 7.0}, shape), words);
}

void Sheet::name(Vec2 place, const std::string& text) {
  const Vec2 p = at(place);
  const double width = 0.95 * letter_px * static_cast<double>(text.size());
  for (const double side : {1.0, -1.0}) {
    const double x = p.x + 10.0 * side;
    const Box2 covered{{std::min(x, x + side * width), p.y - 7.0},
                       {std::max(x, x + side * width), p.y + 6.0}};
    const bool inside = finite(p) && covered.low.x > 0.0 && covered.high.x < px_per_m * box.size().x;
    if (!inside || std::ranges::any_of(named, [&](const Box2& other) { return other.overlaps(covered); }))
      continue;
    named.push_back(covered);
    names +=
        fmt::format("<text class=\"name\"{} x=\"{}\" y=\"{}\">{}</text>\n",
                    side < 0.0 ? " text-anchor=\"end\"" : "", number(x), number(p.y + 4.0), escaped(text));
    return;
  }
}

std::string Sheet::legend(double left_px, double top_px, double width_px, double& height_px) const {
  std::size_t longest = 1;
  for (const auto& [words, sample] : entries) longest = std::max(longest, words.size());
  const double least_px = 52.0 + letter_px * static_cast<double>(longest);
  const auto columns = static_cast<std::size_t>(std::max(1.0, std::floor(width_px / least_px)));
  height_px = 22.0 * std::ceil(static_cast<double>(entries.size()) / static_cast<double>(columns));
  std::string text;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double column = static_cast<double>(i % columns), row = static_cast<double>(i / columns);
    text += fmt::format("<g transform=\"translate({} {})\">{}<text x=\"38\" y=\"12\">{}</text></g>\n",
                        number(left_px + column * width_px / static_cast<double>(columns)),
                        number(top_px + 22.0 * row), entries[i].second, escaped(entries[i].first));
  }
  return text;
}

}  // namespace outrider::picture
