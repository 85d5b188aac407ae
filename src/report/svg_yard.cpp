#include <utility>
#include <vector>

#include "outrider/core/units.hpp"
#include "svg_scene.hpp"
#include "text.hpp"

namespace outrider {
namespace {

// Outline of a core grown by its radius: straight edges and arcs, counter-clockwise.
std::string outline(const RoundedPolygon& shape) {
  const std::vector<Vec2>& core = shape.core;
  const double r = shape.radius_m;
  if (core.empty()) return {};
  if (core.size() == 1) {
    const Vec2 side{r, 0.0};
    return fmt::format("M{}A{r} {r} 0 1 1 {}A{r} {r} 0 1 1 {}Z", point(core[0] - side), point(core[0] + side),
                       point(core[0] - side), fmt::arg("r", number(r)));
  }
  std::string path;
  for (std::size_t i = 0; i < core.size(); ++i) {
    const Vec2 a = core[i];
    const Vec2 b = core[(i + 1) % core.size()];
    const Vec2 out = (r / std::max(distance(a, b), 1e-12)) * -perpendicular(b - a);
    if (i > 0 && r > 0.0) {
      path += fmt::format("A{0} {0} 0 0 1 {1}", number(r), point(a + out));
    } else {
      path += fmt::format("{}{}", i == 0 ? 'M' : 'L', point(a + out));
    }
    if (r > 0.0) path += fmt::format("L{}", point(b + out));
  }
  if (r > 0.0) {
    const Vec2 out = (r / std::max(distance(core[0], core[1]), 1e-12)) * -perpendicular(core[1] - core[0]);
    path += fmt::format("A{0} {0} 0 0 1 {1}", number(r), point(core[0] + out));
  }
  return path + "Z";
}

// Low things dark, high things light.
std::string shade(double share) {
  const auto mix = [&](int low, int high) {
    return static_cast<int>(std::lround(low + (high - low) * share));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0x36, 0x94), mix(0x47, 0xa6), mix(0x55, 0xb4));
}

std::string grid(const Scene& scene) {
  const Box2& area = scene.area;
  const double across = std::max(area.size().x, area.size().y);
  const double step = std::max(1.0, std::pow(10.0, std::ceil(std::log10(across / 60.0))));
  std::string path;
  for (int i = 0; i <= 60; ++i) {
    const double x = (std::ceil(area.low.x / step) + i) * step;
    const double y = (std::ceil(area.low.y / step) + i) * step;
    if (x <= area.high.x) {
      path += fmt::format("M{} {}V{}", number(x), number(area.low.y), number(area.high.y));
    }
    if (y <= area.high.y) {
      path += fmt::format("M{} {}H{}", number(area.low.x), number(y), number(area.high.x));
    }
  }
  return fmt::format(R"svg(<path d="{}" stroke="#1c2a35" stroke-width="{}"/>)svg", path,
                     number(scene.pixels(1.0)));
}

std::string solids(const Scene& scene) {
  std::vector<std::pair<double, std::size_t>> order;  // from low to high, ties as in the report
  double highest = 1e-3;
  for (std::size_t i = 0; i < scene.report.solids.size(); ++i) {
    const ReportSolid& solid = scene.report.solids[i];
    if (solid.footprint.empty() || !std::isfinite(solid.high_z_m)) continue;
    order.emplace_back(solid.high_z_m, i);
    highest = std::max(highest, solid.high_z_m);
  }
  std::ranges::sort(order);
  std::string text;
  for (const auto& [top_m, index] : order) {
    const ReportSolid& solid = scene.report.solids[index];
    std::string path;
    for (const RoundedPolygon& piece : solid.footprint) path += outline(piece);
    const std::string tone = shade(std::sqrt(std::clamp(top_m / highest, 0.0, 1.0)));
    if (solid.blocks_driving) {
      text += fmt::format(R"svg(<path d="{}" fill="{}"/>)svg", path, tone);
    } else {
      text += fmt::format(
          R"svg(<path d="{}" fill="{tone}" fill-opacity=".22" stroke="{tone}" stroke-width="{}" stroke-dasharray="{dash} {dash}"/>)svg",
          path, number(scene.pixels(1.0)), fmt::arg("tone", tone),
          fmt::arg("dash", number(scene.pixels(3.0))));
    }
    text += '\n';
  }
  return text;
}

std::string mark(std::string_view status, double r) {
  const std::string ink = number(r * 0.34);
  const auto stroke = [&](std::string_view path) {
    return fmt::format(
        R"svg(<path d="{}" fill="none" stroke="#101820" stroke-width="{}" stroke-linecap="round" stroke-linejoin="round"/>)svg",
        path, ink);
  };
  if (status == "reached") {
    return fmt::format(R"svg(<circle r="{}" fill="{}"/>)svg", number(r), colour(status)) +
           stroke(fmt::format("M{} {}L{} {}L{} {}", number(-0.45 * r), number(0.0), number(-0.1 * r),
                              number(-0.38 * r), number(0.48 * r), number(0.38 * r)));
  }
  if (status == "failed") {
    const std::string d = number(1.25 * r);
    const std::string x = number(0.38 * r);
    return fmt::format(R"svg(<path d="M0 -{0}L{0} 0L0 {0}L-{0} 0Z" fill="{1}"/>)svg", d, colour(status)) +
           stroke(fmt::format("M-{0} -{0}L{0} {0}M-{0} {0}L{0} -{0}", x));
  }
  return fmt::format(R"svg(<rect x="-{0}" y="-{0}" width="{1}" height="{1}" fill="{2}"/>)svg",
                     number(0.95 * r), number(1.9 * r), colour(status)) +
         stroke(fmt::format("M-{0} 0H{0}", number(0.5 * r)));
}

/// The stay of an intruder: it comes from its entrance, and is gone a little after it was hit.
std::string visit(const Scene& scene, const ReportTarget& target) {
  const ReportVisit& stay = *target.visit;
  constexpr double lingers = 0.015;  // of the loop
  const auto when = [&](double time_s) { return std::isfinite(time_s) ? scene.share(time_s) : 0.0; };
  const double enters = when(stay.enters_s);
  const double settles = std::max(enters, when(stay.settles_s));
  const bool leaves = target.status == "reached" && std::isfinite(target.done_s);
  const double gone = leaves ? std::max(enters, when(target.done_s) + lingers) : 1.0;
  const std::string from = point(stay.from - xy(target.centre));
  Frames walk;
  for (const auto& [share, at] : {std::pair{0.0, from}, {enters, from}, {settles, "0 0"}, {1.0, "0 0"}}) {
    walk.add(share, at);
  }
  return fmt::format("<g{}>{}<g>{}", enters > 0.0 ? R"( opacity="0")" : "", scene.shown(enters, gone),
                     scene.transform("translate", walk));
}

std::string targets(const Scene& scene) {
  std::string text;
  const double r = scene.pixels(6.5);
  for (const ReportTarget& target : scene.report.targets) {
    const double done = std::isfinite(target.done_s) ? scene.share(target.done_s) : 1.0;
    text += fmt::format(R"svg(<g transform="translate({})"><title>{}</title>)svg", point(xy(target.centre)),
                        markup_text(target.name));
    if (target.visit) text += visit(scene, target);
    text += fmt::format(
        R"svg(<rect x="{}" y="{}" width="{}" height="{}" transform="rotate({})" fill="{}" fill-opacity=".35"/>)svg",
        number(-0.5 * target.size.x), number(-0.5 * target.size.y), number(target.size.x),
        number(target.size.y), number(degrees(target.yaw_rad)), waiting);
    if (done > 0.0) {
      text += fmt::format(
          R"svg(<circle r="{}" fill="#101820" fill-opacity=".6" stroke="{}" stroke-width="{}">{}</circle>)svg",
          number(0.85 * r), waiting, number(0.28 * r), scene.shown(0.0, done));
    }
    text += fmt::format("<g{}>{}{}</g>{}</g>\n", done > 0.0 ? R"( opacity="0")" : "", scene.shown(done, 1.0),
                        mark(target.status, r), target.visit ? "</g></g>" : "");
  }
  return text;
}

}  // namespace

std::string yard(const Scene& scene) { return grid(scene) + solids(scene) + targets(scene); }

}  // namespace outrider
