// Sweep: tours relaxed to some of the goals, by a dynamic program over the sets of these that are served.
//
// A visit is a drive and then a bundle of goals at its least time. Headings are known by sector; how the
// gun points is forgotten between visits. Visits that serve none of the chosen goals are free but for their
// drives, and each goal that was not chosen adds its least duration. So no value exceeds that of a true tour.
//
// A sweep goes forward from the start, by the goals served, or backward from the end, by the goals left.
// Each prunes the next, which goes the other way and over more goals: where the time to come to a
// state in one and the time to go on from it in the other are together at least the limit, no tour below
// the limit passes. So sets, stops, headings and bundles fall away while goals are added.
// Sources: Held and Karp (1962); bounding from both ends by state space relaxations, Baldacci, Mingozzi
// and Roberti, Operations Research 59(5), 2011; goals added one by one, Righini and Salani (2008).
#pragma once

#include <map>

#include "outrider/core/budget.hpp"
#include "proof/bundles.hpp"
#include "proof/relaxation.hpp"

namespace outrider::tour {

/// Values by stop and sector, for a few of the stops.
class SweepRow {
 public:
  SweepRow(std::uint32_t stops, std::uint32_t sectors) : sectors_(sectors), block_(stops, absent) {}

  /// The values at the stop, by sector; null where there are none.
  [[nodiscard]] const float* find(std::uint32_t stop) const {
    return block_[stop] == absent ? nullptr : &values_[std::size_t{block_[stop]} * sectors_];
  }
  /// The same; infinite where there were none.
  float* at(std::uint32_t stop);
  [[nodiscard]] const std::vector<std::uint32_t>& stops() const { return stops_; }

 private:
  static constexpr std::uint16_t absent = 0xffff;
  std::uint32_t sectors_;
  std::vector<std::uint16_t> block_;  // stop -> its place in `stops_` and, times sectors, in `values_`
  std::vector<std::uint32_t> stops_;
  std::vector<float> values_;
};

using Rows = std::map<GoalSet, SweepRow>;

/// The tours that matter, and what the sweeps share.
struct SweepContext {
  const Instance& instance;
  RelaxedDrives drives;
  std::vector<double> durations;  // goal -> the least
  double limit = 0.0;             // tours of this time or more do not matter
  std::uint64_t operations = 0;   // that are left: drives and bundles tried
};

struct Sweep {
  bool forward = true;
  std::vector<std::uint32_t> goals;  // bit -> goal
  double outside = 0.0;              // least durations of the other goals
  double bound = 0.0;                // of every tour, at most the limit
  bool finished = false;             // or else nothing here holds
  /// Forward: set served -> time from the start until arrived at the stop. Backward: set left -> time to the
  /// end after the last service at the stop. Only where a tour that matters may pass.
  Rows rows;
  Rows ahead;  ///< backward only: set left -> time to the end when just arrived at the stop to serve there
};

/// A sweep over no goals, to begin with; the first true one goes the other way.
Sweep nothing_swept(const SweepContext& context, bool forward);

/// Sweeps over `goals`, the first of which are those of `before`, against its direction, and marks the
/// bundles that are needed. O(sets * (stops^2 * sectors + ways)) in time, where sets are those that stay.
Sweep sweep(SweepContext& context, const Sweep& before, std::vector<std::uint32_t> goals, Bundles& bundles,
            BudgetMeter& meter);

}  // namespace outrider::tour
