#include "strokes/field_work.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider::cover {
namespace {

constexpr double slack_part = 1e-3;  // of the stride: more than all rounding and chords

/// Time of getting from one lane to the next.
double change_time_s(const CoverProblem& problem) {
  return 2.0 * (duration(0.5 * pi, problem.pace.turning()) + problem.pace.pause_s) +
         duration(problem.stride_m(), problem.pace.straight());
}

/// Time of the lanes and of getting from one to the next.
double sweep_time_s(const std::vector<SweepCell>& cells, const CoverProblem& problem) {
  const double change = change_time_s(problem);
  double time = 0.0;
  for (const SweepCell& cell : cells) {
    for (const Segment& lane : cell.lanes) {
      time += change + duration(distance(lane.a, lane.b), problem.pace.straight());
    }
  }
  return time;
}

}  // namespace

Strides::Strides(const CoverProblem& problem)
    : slab_m((1.0 - 4.0 * slack_part) * problem.stride_m()), slack_m(slack_part * problem.stride_m()) {}

Region core_of(const CoverProblem& problem, const CoverField& field, double depth_m) {
  const Strides strides(problem);
  const Region deep =
      shrunk(field.area, problem.radius_m() + depth_m + strides.slack_m, 0.25 * strides.slack_m);
  Region core;
  for (const RingedPolygon& polygon : deep) {
    if (contains(field.standing, polygon.outer.front())) core.push_back(polygon);
  }
  return core;
}

std::vector<Lap> laps_within(const PolygonGround& ground, const Region& standing, double arc_m) {
  std::vector<Lap> laps = laps_of(ground);
  std::erase_if(laps, [&](const Lap& lap) {
    const Vec2 p = lap.front().from;
    return std::none_of(standing.begin(), standing.end(), [&](const RingedPolygon& part) {
      return contains(part, p) || distance_to_border(part, p) <= 2.0 * arc_m;
    });
  });
  return laps;
}

std::vector<double> sweep_headings(const CoverField& field, std::int64_t count) {
  std::vector<std::pair<double, double>> edges;  // minus the length, heading in [0, pi/2)
  const auto add_edges = [&](const std::vector<Vec2>& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
      const double heading = std::fmod(heading_of(edge) + 2.0 * pi, 0.5 * pi);
      edges.emplace_back(-norm(edge), heading);
    }
  };
  add_edges(field.ground->boundary);
  for (const auto& obstacle : field.ground->obstacles) add_edges(obstacle);
  std::stable_sort(edges.begin(), edges.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> headings;
  for (const auto& [length, heading] : edges) {
    if (static_cast<std::int64_t>(headings.size()) >= count) break;
    const bool known = std::any_of(headings.begin(), headings.end(), [&, h = heading](double other) {
      return std::abs(std::remainder(h - other, 0.5 * pi)) < radians(2.0);
    });
    if (known) continue;
    headings.push_back(heading);
    headings.push_back(heading + 0.5 * pi);
  }
  return headings;
}

CellChoices cells_of(const Region& core, const CoverProblem& problem, const std::vector<double>& headings,
                     const std::stop_token& stop) {
  const Strides strides(problem);
  const double change_m = problem.pace.speed_mps * change_time_s(problem);
  const auto cut = [&](const Region& region, double heading) {
    return sweep_cells(region, heading, strides.slab_m, strides.slack_m, change_m, stop);
  };
  std::vector<SweepCell> best;
  for (const RingedPolygon& part : core) {
    std::vector<SweepCell> least;
    for (const double heading : headings) {
      if (stop.stop_requested()) return {};
      auto cells = cut({part}, heading);
      if (least.empty() || sweep_time_s(cells, problem) < sweep_time_s(least, problem))
        least = std::move(cells);
    }
    std::move(least.begin(), least.end(), std::back_inserter(best));
  }
  CellChoices choices;
  for (const SweepCell& cell : best) {
    std::vector<SweepCell> choice{cell};
    for (const double heading : headings) {
      if (stop.stop_requested()) return choices;
      auto other = cut(cell.area, heading);
      if (other.size() == 1) choice.push_back(std::move(other.front()));
    }
    std::stable_sort(choice.begin(), choice.end(), [&](const SweepCell& a, const SweepCell& b) {
      return sweep_time_s({a}, problem) < sweep_time_s({b}, problem);
    });
    choices.push_back(std::move(choice));
  }
  return choices;
}

double leave_uncovered(CellChoices& cells, double most_m2) {
  std::stable_sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) {
    return area_of(a.front().area) > area_of(b.front().area);
  });
  double removed = 0.0;
  while (!cells.empty() && removed + area_of(cells.back().front().area) <= most_m2) {
    removed += area_of(cells.back().front().area);
    cells.pop_back();
  }
  return removed;
}

}  // namespace outrider::cover
