#include <limits>
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

/// Ground too steep to drive on, and lines of equal height, the higher the brighter.
std::string terrain(const Scene& scene) {
  if (!scene.report.terrain) return {};
  const ReportTerrain& ground = *scene.report.terrain;
  std::string steep;
  for (const RoundedPolygon& patch : ground.steep) steep += outline(patch);
  std::string text;
  if (!steep.empty()) text += fmt::format(R"svg(<path d="{}" fill="#5a3a3a" fill-opacity=".55"/>)svg", steep);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const ReportContour& line : ground.contours) {
    low = std::min(low, line.height_m);
    high = std::max(high, line.height_m);
  }
  for (const ReportContour& line : ground.contours) {
    std::string path;
    for (const Vec2 p : line.points) path += fmt::format("{}{}", path.empty() ? 'M' : 'L', point(p));
    const double share = high > low ? (line.height_m - low) / (high - low) : 1.0;
    text += fmt::format(
        R"svg(<path d="{}" fill="none" stroke="#7d9a6a" stroke-opacity="{}" stroke-width="{}"><title>{} m</title></path>)svg",
        path, number(0.35 + 0.5 * share), number(scene.pixels(1.2)), number(line.height_m));
    text += '\n';
  }
  return text;
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

/// The moves of a target in the loop's time, simplified.
std::vector<Key> keys_of(const Scene& scene, const std::vector<ReportMove>& moves, Vec2 ReportMove::* what) {
  std::vector<Key> keys;
  for (const ReportMove& move : moves) {
    if (std::isfinite(move.time_s)) keys.push_back({scene.share(move.time_s), move.*what});
  }
  return simplified(keys, scene.tolerance);
}

/// A ring where the robot believed somebody to be, while that was not where it was.
std::string belief(const Scene& scene, const ReportTarget& target) {
  const auto& moves = *target.moves;
  const auto right = [](const ReportMove& move) { return move.position == move.believed; };
  if (std::ranges::all_of(moves, right)) return {};
  Frames way;
  double last = 0.0;
  for (const Key& key : keys_of(scene, moves, &ReportMove::believed)) {
    if (way.times.empty()) way.add(0.0, point(key.value));
    last = std::max(last, key.time);
    way.add(last, point(key.value));
  }
  if (way.times.empty()) return {};
  way.add(1.0, point(moves.back().believed));
  const double end = std::isfinite(target.done_s) ? scene.share(target.done_s) : 1.0;
  return fmt::format(
      R"svg(<g>{}<circle r="{}" fill="none" stroke="{}" stroke-opacity=".8" stroke-width="{}" stroke-dasharray="{d} {d}">{}</circle></g>)svg",
      scene.transform("translate", way), number(scene.pixels(10.0)), waiting, number(scene.pixels(1.2)),
      scene.shown(0.0, end), fmt::arg("d", number(scene.pixels(3.0))));
}

/// The stay of an intruder: it comes from its entrance, moves about, and is gone a little after it was hit.
/// One that was there from the start is not gone.
std::string stay(const Scene& scene, const ReportTarget& target) {
  constexpr double lingers = 0.015;  // of the loop
  const auto when = [&](double time_s) { return std::isfinite(time_s) ? scene.share(time_s) : 0.0; };
  Frames walk;
  double last = 0.0;
  const auto add = [&](double share, Vec2 at) {
    last = std::max(last, share);
    walk.add(last, point(at - xy(target.centre)));
  };
  double enters = 0.0;
  double gone = 1.0;
  const Vec2 first =
      target.moves && !target.moves->empty() ? target.moves->front().position : xy(target.centre);
  if (target.visit) {
    enters = when(target.visit->enters_s);
    const bool leaves = target.status == "reached" && std::isfinite(target.done_s);
    gone = leaves ? std::max(enters, when(target.done_s) + lingers) : 1.0;
    add(0.0, target.visit->from);
    add(enters, target.visit->from);
    add(when(target.visit->settles_s), first);
  } else {
    add(0.0, first);
  }
  if (target.moves) {
    for (const Key& key : keys_of(scene, *target.moves, &ReportMove::position)) add(key.time, key.value);
  }
  add(1.0, xy(target.centre));
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
    const bool moves = target.visit || target.moves;
    if (moves) text += stay(scene, target);
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
                        mark(target.status, r), moves ? "</g></g>" : "");
    if (target.moves) text += belief(scene, target) + "\n";
  }
  return text;
}

/// Water is blue, charge amber, a station that gives both half and half.
std::string stations(const Scene& scene) {
  if (!scene.report.supplies) return {};
  std::string text;
  const double half = scene.pixels(7.0);
  for (const ReportStation& station : scene.report.supplies->stations) {
    text += fmt::format(
        R"svg(<g transform="translate({0})"><title>{1}</title><rect x="-{2}" y="-{2}" width="{3}" height="{3}" fill="{4}"/>)svg",
        point(station.position), markup_text(station.name), number(half), number(2.0 * half),
        station.gives_water ? water : robot_colour);
    if (station.gives_water && station.gives_charge) {
      text += fmt::format(R"svg(<rect y="-{0}" width="{0}" height="{1}" fill="{2}"/>)svg", number(half),
                          number(2.0 * half), robot_colour);
    }
    text += "</g>\n";
  }
  return text;
}

}  // namespace

std::string yard(const Scene& scene) {
  return grid(scene) + terrain(scene) + solids(scene) + stations(scene) + targets(scene);
}

}  // namespace outrider
