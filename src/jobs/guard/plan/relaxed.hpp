// Relaxed: the guard mission without turns, aims and halts at bends, solved exactly over a few targets.
#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/path/grid/drive_lattice.hpp"

namespace outrider {

using Field = DriveLattice::Field;
inline constexpr std::uint16_t endless = DriveLattice::endless;

/// The mission without turns, aims and halts at bends, over the targets chosen so far. Times are in units.
/// On the move, drives have no halts and no ball is waited for.
class Relaxed {
 public:
  Relaxed(const GuardProblem& problem, const FiringMap& firing_map, const std::vector<std::size_t>& targets,
          bool on_the_move);

  /// Takes one more target in; false, and nothing done, when the budget ends first or the token is raised.
  bool choose(std::size_t index, BudgetMeter& meter, const std::stop_token& stop);
  /// The index of the target for which a best relaxed mission would have to do most besides its least flight.
  [[nodiscard]] std::optional<std::size_t> hardest() const;
  [[nodiscard]] double bound_s() const;
  [[nodiscard]] const std::vector<std::size_t>& chosen() const { return chosen_; }
  /// Returns for each set of chosen targets the least time to hit all of them from another start.
  [[nodiscard]] std::vector<double> values_from(Vec2 start) const;

 private:
  friend class RelaxedWindows;  // research/guard/heading_plan.cpp

  [[nodiscard]] Field arrived(std::size_t set) const;
  void drive(Field& value) const;
  [[nodiscard]] std::vector<std::size_t> stops() const;
  [[nodiscard]] double value_s(std::size_t set) const { return value_s(set, home_, to_home_s_); }
  [[nodiscard]] double value_s(std::size_t set, std::size_t home, double to_home_s) const;
  [[nodiscard]] double on_the_move_s(double driven_s) const;
  [[nodiscard]] bool is_chosen(std::size_t index) const {
    return std::find(chosen_.begin(), chosen_.end(), index) != chosen_.end();
  }

  GridFrame frame_;
  DriveLattice lattice_;
  Limits straight_;
  bool on_the_move_ = false;
  double aside_s_ = 0.0;  // on the move, to drive to the centre of a cell and back
  double unit_s_ = 0.0;
  std::uint32_t overhead_ = 0;                   // of a drive, to speed up and to slow down
  std::size_t home_ = 0;                         // the cell nearest to the start
  double to_home_s_ = 0.0;                       // no value there exceeds that at the start by more
  std::vector<GridPart<std::uint16_t>> flight_;  // by index: the least flight from each cell of the region
  std::vector<std::uint16_t> least_;             // by index: the least of these
  std::vector<std::size_t> chosen_;              // bit of a set -> index
  std::vector<Field> value_;                     // set -> by cell, the least time to hit it
};

/// Returns the relaxed mission over the hardest targets, chosen one by one: at most 8 of them (13 with
/// `options.prove`), and fewer if memory or budget end.
Relaxed relaxed_mission(const GuardProblem& problem, const FiringMap& firing_map,
                        const std::vector<std::size_t>& targets, const GuardOptions& options,
                        const Budget& budget);

/// Returns the memory that the fields of a bound may take: half of what there is where a proof is asked for.
double bound_memory_bytes(const GuardOptions& options);

}  // namespace outrider
