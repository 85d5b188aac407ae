#include "cover_areas.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/io/map/cover_area.hpp"

namespace outrider::bench {
namespace {

using Ring = std::vector<Vec2>;

CoverProblem problem_of(Ring boundary, std::vector<Ring> holes = {}) {
  CoverProblem problem;
  problem.boundary = std::move(boundary);
  problem.holes = std::move(holes);
  problem.width_m = 0.8;
  problem.tracking_error_m = 0.5 * problem.overlap * problem.width_m;
  return problem;
}

Ring box(Vec2 low, Vec2 size) { return {low, low + Vec2{size.x, 0.0}, low + size, low + Vec2{0.0, size.y}}; }

CoverProblem rectangle(Rng& rng) {
  return problem_of(box({}, {rng.uniform(8.0, 25.0), rng.uniform(5.0, 20.0)}));
}

CoverProblem needle(Rng& rng) {
  const double length = rng.uniform(20.0, 40.0);
  return problem_of({{0, 0}, {length, rng.uniform(-1.0, 1.0)}, {length, rng.uniform(3.0, 6.0)}});
}

CoverProblem comb(Rng& rng) {
  const double tooth = rng.uniform(1.5, 3.0), gap = rng.uniform(1.0, 3.0), high = rng.uniform(6.0, 12.0);
  const double spine = rng.uniform(2.0, 4.0);
  const int teeth = 3 + static_cast<int>(rng.below(3));
  const double across = teeth * tooth + (teeth - 1) * gap;
  Ring ring{{0, 0}, {across, 0}};
  for (int i = teeth; i-- > 0;) {
    const double left = i * (tooth + gap);
    ring.push_back({left + tooth, high});
    ring.push_back({left, high});
    if (i == 0) break;
    ring.push_back({left, spine});
    ring.push_back({left - gap, spine});
  }
  return problem_of(ring);
}

CoverProblem star(Rng& rng) {
  const int points = 4 + static_cast<int>(rng.below(4));
  const double inner = rng.uniform(3.0, 6.0);
  Ring ring;
  for (int i = 0; i < 2 * points; ++i)
    ring.push_back((i % 2 == 0 ? 10.0 : inner) * direction(pi * i / points));
  return problem_of(ring);
}

CoverProblem islands(Rng& rng) {
  std::vector<Ring> holes;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vec2 low{3.0 + 6.5 * i + rng.uniform(0.0, 2.0), 2.5 + 5.5 * k + rng.uniform(0.0, 1.5)};
      holes.push_back(box(low, {rng.uniform(0.8, 2.2), rng.uniform(0.8, 2.2)}));
    }
  }
  return problem_of(box({}, {30.0, 19.0}), holes);
}

CoverProblem angle(Rng& rng) {
  const double a = rng.uniform(3.0, 8.0), b = rng.uniform(3.0, 8.0);
  return problem_of({{0, 0}, {18, 0}, {18, a}, {b, a}, {b, 15}, {0, 15}});
}

CoverProblem horseshoe(Rng& rng) {
  const double a = rng.uniform(2.5, 5.0), b = rng.uniform(2.5, 5.0), floor = rng.uniform(2.5, 5.0);
  return problem_of({{0, 0}, {16, 0}, {16, 14}, {16 - a, 14}, {16 - a, floor}, {b, floor}, {b, 14}, {0, 14}});
}

CoverProblem zigzag(Rng& rng) {
  const double thick = rng.uniform(2.5, 5.0);
  Ring low, high;
  for (int i = 0; i <= 4; ++i) {
    const Vec2 p{6.0 * i, (i % 2) * rng.uniform(2.0, 6.0)};
    low.push_back(p);
    high.insert(high.begin(), p + Vec2{0.0, thick});
  }
  low.insert(low.end(), high.begin(), high.end());
  return problem_of(low);
}

Ring round(Vec2 centre, double radius, int corners, Rng& rng, double rough) {
  Ring ring;
  for (int i = 0; i < corners; ++i)
    ring.push_back(centre + radius * rng.uniform(1.0 - rough, 1.0) * direction(2.0 * pi * i / corners));
  return ring;
}

CoverProblem ring(Rng& rng) {
  const double radius = rng.uniform(7.0, 10.0);
  return problem_of(round({}, radius, 24, rng, 0.0),
                    {round({}, rng.uniform(0.2, 0.6) * radius, 24, rng, 0.0)});
}

CoverProblem rough(Rng& rng) {
  return problem_of(round({}, rng.uniform(8.0, 12.0), 10 + static_cast<int>(rng.below(8)), rng, 0.35));
}

/// A field in UTM coordinates, read as a file: four long sides, one of them bent.
CoverProblem utm_field(Rng& rng) {
  const Vec2 at{rng.uniform(2e5, 8e5), rng.uniform(4e6, 6e6)};
  const double heading = rng.uniform(0.0, pi), length = rng.uniform(15.0, 25.0);
  std::string text;
  for (const Vec2 p : Ring{{0, 0},
                           {0.5 * length, rng.uniform(-2.0, 0.0)},
                           {length, 0},
                           {length + rng.uniform(-3.0, 3.0), rng.uniform(8.0, 14.0)},
                           {rng.uniform(-3.0, 3.0), rng.uniform(8.0, 14.0)}}) {
    const Vec2 corner = at + rotated(heading, p);
    text += fmt::format("{}[{},{}]", text.empty() ? "" : ",", corner.x, corner.y);
  }
  auto area = cover_area_from_text(R"({"type":"Polygon","coordinates":[[)" + text + "]]}", "field.geojson",
                                   Units::told_by_size);
  return problem_of(area ? area->polygons.front().boundary.corners : Ring{});
}

CoverProblem two_areas(Rng& rng) {
  CoverProblem problem = angle(rng);
  problem.others = {{round({26.0, rng.uniform(4.0, 8.0)}, rng.uniform(4.0, 6.0), 9, rng, 0.2), {}}};
  problem.transfers = true;
  return problem;
}

}  // namespace

const std::vector<CoverKind>& cover_kinds() {
  static const std::vector<CoverKind> kinds = {
      {"rectangle", rectangle}, {"needle", needle}, {"comb", comb},           {"star", star},
      {"islands", islands},     {"angle", angle},   {"horseshoe", horseshoe}, {"zigzag", zigzag},
      {"ring", ring},           {"rough", rough},   {"utm field", utm_field}, {"two areas", two_areas}};
  return kinds;
}

}  // namespace outrider::bench
