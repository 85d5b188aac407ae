// AnytimePursuit: the search behind `optimal`, a piece at a time.
//
//   AnytimePursuit search(problem);
//   while (!search.proven()) {
//     if (Status worked = search.improve(budget); !worked) return worked;   // no_path, cancelled, ...
//     ... search.best(), search.lower_bound() ...
//   }
//
// improve() returns after each better catch, when the bound is as large as the cost, and when its budget
// ends, which is no fault: the next call goes on. best() never gets dearer, lower_bound() never falls.
// With budgets of expansions alone the same calls give the same answers. The first catch, the earliest one,
// stands after one flood of the cells that are as near; methods and memory are those of optimal.hpp. Wall
// time is kept but for laying out the map and for the moves of a way that the last step proved. To plan on
// from where the robot has come to, make a new one from the problem with that cell and that second.
#pragma once

#include <memory>
#include <optional>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/pursuit/plan.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider {

class AnytimePursuit {
 public:
  /// A problem that cannot be asked is refused by the first improve().
  explicit AnytimePursuit(PursuitProblem problem);
  AnytimePursuit(AnytimePursuit&&) noexcept;
  AnytimePursuit& operator=(AnytimePursuit&&) noexcept;
  ~AnytimePursuit();

  /// Faults: those of check(problem); no_path, with the reason of why_no_catch(), once it is proven that
  /// there is no catch; cancelled.
  Status improve(const Budget& budget);
  /// The same with a meter that goes on counting from call to call.
  Status improve(BudgetMeter& meter);

  /// The cheapest catch so far, with the bound as it is now.
  [[nodiscard]] const std::optional<PursuitPlan>& best() const;
  [[nodiscard]] std::uint64_t lower_bound() const;
  /// The first second in which a catch is possible, once it is known.
  [[nodiscard]] std::optional<int> earliest_catch_s() const;
  /// The best catch is the cheapest there is.
  [[nodiscard]] bool proven() const;
  [[nodiscard]] const PursuitCounters& counters() const;

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

struct AnytimePursuitOptions {};
std::vector<Option> describe(AnytimePursuitOptions& options);

/// The best catch when the budget ends. Faults: those of improve(); budget_exhausted when none was found.
Outcome<PursuitPlan> anytime_pursuit(const PursuitProblem& problem, const AnytimePursuitOptions& options,
                                     const Budget& budget, Workspace& workspace);

}  // namespace outrider
