#include "output/tag_picture.hpp"

#include <fmt/format.h>

#include <iterator>
#include <string_view>

#include "outrider/geometry/box.hpp"
#include "outrider/io/camera/photo.hpp"

namespace outrider::cli {
namespace {

/// Encodes bytes as base64 (RFC 4648).
std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::string_view group = bytes.substr(i, 3);
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (k < group.size() ? static_cast<unsigned char>(group[k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= group.size() ? digits[bits >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

void draw_axis(std::string& svg, const Camera& camera, const Pose3& camera_T_tag, double length_m,
               bool dashed) {
  const auto from = project(camera, camera_T_tag.position);
  const auto to = project(camera, camera_T_tag * Vec3{0, 0, -length_m});
  if (!from || !to) return;
  fmt::format_to(std::back_inserter(svg),
                 "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"#0072b2\" "
                 "stroke-width=\"2\"{}/>\n",
                 from->x, from->y, to->x, to->y, dashed ? " stroke-dasharray=\"4 3\"" : "");
}

void draw_tag(std::string& svg, const Camera& camera, double size_m, const TagSighting& sighting) {
  const auto out = std::back_inserter(svg);
  Box2 box;
  fmt::format_to(out, "<polygon points=\"");
  for (const Vec2 corner : sighting.corners_px) {
    box.include(corner);
    fmt::format_to(out, "{:.2f},{:.2f} ", corner.x, corner.y);
  }
  fmt::format_to(out,
                 "\" fill=\"none\" stroke=\"#d55e00\" stroke-width=\"1.5\"/>\n"
                 "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"2.5\" fill=\"#d55e00\"/>\n",
                 sighting.corners_px[0].x, sighting.corners_px[0].y);
  for (std::size_t i = 0; i < sighting.poses.size(); ++i) {
    draw_axis(svg, camera, sighting.poses[i].camera_T_tag, 0.5 * size_m, i > 0);
  }
  fmt::format_to(out,
                 "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\" font-family=\"sans-serif\" "
                 "font-size=\"14\" font-weight=\"bold\" fill=\"#ffe14d\" stroke=\"#000\" "
                 "stroke-width=\"3\" paint-order=\"stroke\">{}</text>\n",
                 0.5 * (box.low.x + box.high.x), box.low.y - 5.0, sighting.id);
}

}  // namespace

std::string tag_picture(const CameraImage& image, const Camera& camera, double size_m,
                        const std::vector<TagSighting>& sightings) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<image width=\"{0}\" height=\"{1}\" href=\"data:image/png;base64,{2}\"/>\n",
      image.width, image.height, base64(to_png(image)));
  for (const TagSighting& sighting : sightings) draw_tag(svg, camera, size_m, sighting);
  return svg + "</svg>\n";
}

}  // namespace outrider::cli
