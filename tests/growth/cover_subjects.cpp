// Covering an area, as it grows: squares swept by lanes.
#include <cmath>
#include <stdexcept>

#include "outrider/jobs/cover/ground/coverage.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "subject.hpp"
#include "work.hpp"

namespace outrider::growth {
namespace {

constexpr double radius_m = 0.25;
constexpr double stride_m = 0.4;

/// Parallel lanes over a square of that area, cut into pieces of a stride: so their number is as the area.
std::vector<double> covered(int area_m2) {
  const double side = std::sqrt(area_m2);
  std::vector<Vec2> way;
  const int lanes = static_cast<int>(side / stride_m);
  for (int k = 0; k < lanes; ++k) {
    for (int i = 0; i < lanes; ++i)
      way.push_back(stride_m * Vec2{k % 2 == 0 ? i + 0.5 : lanes - i - 0.5, k + 0.5});
  }
  const Region area = region_of({{0, 0}, {side, 0}, {side, side}, {0, side}}, {});
  const Work work = work_of([&] { (void)coverage_of(way, radius_m, area); });
  return {work.blocks, work.allocations, work.peak_bytes};
}

CoverProblem square_of(int area_m2) {
  const double side = std::sqrt(area_m2);
  CoverProblem problem;
  problem.boundary = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  problem.width_m = 2.0 * radius_m;
  return problem;
}

std::vector<double> cover_planned(const std::string& method, int area_m2) {
  const CoverProblem problem = square_of(area_m2);
  const CoverMethod row = find_cover_method(method).value();
  Outcome<CoverPlan> plan;
  const Work work = work_of([&] { plan = row.plan(problem, {}, {}); });
  if (!plan) throw std::runtime_error(plan.error().sentence);
  return {static_cast<double>(plan->track.pieces.size()), work.allocations, work.peak_bytes};
}

double sorted_twice(double n) { return n * std::log(16.0 * n) * std::log(16.0 * n); }

}  // namespace

std::vector<Subject> cover_subjects() {
  const std::string coverage = "jobs/cover/ground/coverage.hpp";
  const std::string lapless = cover_methods().front().name.data();
  return {{"coverage_of",
           "area, m2",
           coverage,
           {16, 32, 64, 128, 256},
           {{"blocks", "O(n log^2 n) for n points of the path", sorted_twice},
            {"allocations", "the same", sorted_twice},
            {"peak bytes", "none is stated; held to the time", sorted_twice}},
           covered},
          {"cover " + lapless,
           "area, m2",
           "jobs/cover/strokes/plan.hpp",
           {16, 32, 64, 128, 256},
           {{"pieces", "none is stated; held to the area", linear},
            {"allocations", "the same", linear},
            {"peak bytes", "the same", linear}},
           [=](int area) { return cover_planned(lapless, area); }}};
}

}  // namespace outrider::growth
