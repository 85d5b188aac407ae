// Jobs: what one field is made of before it is ordered: laps along its borders and cells of lanes.
#pragma once

#include <stop_token>

#include "ground/sweep_cells.hpp"
#include "outrider/jobs/cover/ground/problem.hpp"
#include "strokes/laps.hpp"

namespace outrider::cover {

/// The widest slab, a little less than a stride, and how much farther than half of it the core keeps from the
/// border of the standing room, so that lanes are free in spite of rounding.
struct Strides {
  double slab_m;
  double slack_m;
  explicit Strides(const CoverProblem& problem);
};

/// Returns the points of the standing room whose distance from a lap along its border is at least `depth_m`.
Region core_of(const CoverProblem& problem, const CoverField& field, double depth_m);

/// Returns the laps of a ground that belong to the part where the robot starts.
std::vector<Lap> laps_within(const PolygonGround& ground, const Region& standing, double arc_m);

/// Returns the headings of the longest edges of the field, and across them, each once.
std::vector<double> sweep_headings(const CoverField& field, std::int64_t count);

/// Cells of each connected part of the region in the heading that takes the least time, and for each cell
/// other headings of its own that cover it in one back-and-forth, best first. Fewer once the token is raised.
using CellChoices = std::vector<std::vector<SweepCell>>;
CellChoices cells_of(const Region& core, const CoverProblem& problem, const std::vector<double>& headings,
                     const std::stop_token& stop);

/// Removes the smallest cells, as long as their area together is at most `most_m2`. Returns that area, m2.
double leave_uncovered(CellChoices& cells, double most_m2);

}  // namespace outrider::cover
