// AnytimePursuit: the search behind `optimal`, in steps.
//
//   AnytimePursuit search(problem);
//   while (!search.proven()) {
//     if (Status worked = search.improve(budget); !worked) return worked;   // no_path, cancelled, ...
//     ... search.best(), search.lower_bound() ...
//   }
//
// improve() returns after each better catch, when the bound equals the cost, and when its budget ends, which
// is no fault: the next call continues. The cost of best() never increases, and lower_bound() never
// decreases. With budgets of expansions alone, the same calls give the same answers. The first catch is the
// earliest one, after one flood of the cells that are as near; where few cells can matter, it is the cheapest
// one (stage 0 of optimal.hpp). Methods and memory are those of optimal.hpp. Limits of wall time hold except
// while the map is prepared and while the path of the last step is extracted. keep_to() is for a robot that
// goes on meanwhile. To plan from a place elsewhere, construct a new search from the problem with that cell
// and that second.
#pragma once

#include <memory>
#include <optional>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/pursuit/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

/// An anytime search for the cheapest catch.
class AnytimePursuit {
 public:
  /// Never fails. The first improve() refuses an invalid problem.
  explicit AnytimePursuit(PursuitProblem problem);
  AnytimePursuit(AnytimePursuit&&) noexcept;
  AnytimePursuit& operator=(AnytimePursuit&&) noexcept;
  ~AnytimePursuit();

  /// Searches on. Faults: those of check(problem); no_path, with the reason of why_no_catch(), once it is
  /// proven that there is no catch; cancelled.
  Status improve(const Budget& budget);
  /// The same with a meter that counts over several calls.
  Status improve(BudgetMeter& meter);

  /// Fixes the path of best() up to that second of the problem, for a robot that goes on along it while the
  /// search works. All later answers begin with that part, and lower_bound() and proven() are about such
  /// catches. The search keeps its knowledge. Returns false, and does nothing, if there is no best() or it
  /// has caught the target by then.
  bool keep_to(int second);

  /// Returns the cheapest catch so far with the current bound.
  [[nodiscard]] const std::optional<PursuitPlan>& best() const;
  /// Returns the proven lower bound of the cost.
  [[nodiscard]] std::uint64_t lower_bound() const;
  /// Returns the first second in which a catch is possible, if it is known yet.
  [[nodiscard]] std::optional<int> earliest_catch_s() const;
  /// Returns true if best() is optimal.
  [[nodiscard]] bool proven() const;
  /// Returns the work done so far.
  [[nodiscard]] const PursuitCounters& counters() const;

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

/// The planner has no options.
struct AnytimePursuitOptions {};
std::vector<Option> describe(AnytimePursuitOptions& options);

/// Returns the best catch when the budget ends. Faults: those of improve(); budget_exhausted when none was
/// found.
Outcome<PursuitPlan> anytime_pursuit(const PursuitProblem& problem, const AnytimePursuitOptions& options,
                                     const Budget& budget, Workspace& workspace);

}  // namespace outrider
