#include "outrider/pursuit/anytime.hpp"

#include <algorithm>
#include <utility>

#include "label_search.hpp"
#include "layered_search.hpp"
#include "outrider/pursuit/miss.hpp"
#include "reach.hpp"
#include "relaxation.hpp"

namespace outrider {
namespace {

/// Returns the plan along a path. It waits in the first of its cheapest cells, and ends where it meets the
/// target, even if that is earlier than intended.
PursuitPlan plan_of(const PursuitProblem& problem, const PursuitField& field,
                    const std::vector<CellIndex>& cells, int second) {
  const auto cheapest = std::min_element(
      cells.begin(), cells.end(), [&](CellIndex a, CellIndex b) { return field.costs[a] < field.costs[b]; });
  const std::size_t waits = static_cast<std::size_t>(second) + 1 - cells.size();
  PursuitPlan plan;
  const auto stay = [&](CellIndex i) {
    const std::size_t now = plan.path.size();
    if (now > 1 && field.target[now - 1] == field.index(plan.path.back())) return;  // caught
    if (now > 0) plan.cost += field.costs[field.index(plan.path.back())];
    plan.path.push_back(field.cell(i));
  };
  for (auto i = cells.begin(); i != cells.end(); ++i) {
    stay(*i);
    for (std::size_t k = 0; i == cheapest && k < waits; ++k) stay(*i);
  }
  plan.catch_time_s = problem.start_s + static_cast<int>(plan.path.size()) - 1;
  return plan;
}

constexpr std::size_t most_relaxations = 12;  // maximum number tried
constexpr std::size_t kept_relaxations = 4;
constexpr std::uint64_t label_work_per_cell = 8;             // after this work the layered search takes over
constexpr std::int64_t most_total = std::int64_t{1} << 61U;  // prices with larger totals are not used

/// The relaxed cost of a path as a linear function of the price of a second that it has left (or lacks).
struct Line {
  std::int64_t cost = 0;
  std::int64_t slack_s = 0;
  [[nodiscard]] std::int64_t at(std::int64_t price) const { return cost + price * slack_s; }
};

/// Returns the price, rounded down, at which the rising line meets the falling one.
std::int64_t crossing(const Line& rising, const Line& falling) {
  const std::int64_t apart = rising.cost - falling.cost, run = rising.slack_s - falling.slack_s;
  return -(apart / run) - (apart % run > 0 ? 1 : 0);
}

}  // namespace

struct AnytimePursuit::Search {
  enum class Stage { unasked, reach, prices, labels, layers, proven };

  explicit Search(PursuitProblem asked) : problem(std::move(asked)) {}

  Status begin();
  Status improve(BudgetMeter& meter);

  /// Does a part of the work of the present stage, or of each stage. Returns false if the budget ended first.
  bool work(BudgetMeter& meter);
  bool flood(BudgetMeter& meter);
  bool relax(BudgetMeter& meter);
  bool search_labels(BudgetMeter& meter);
  bool search_layers(BudgetMeter& meter);

  void offer(const std::vector<CellIndex>& cells, int second);
  void raise(std::uint64_t bound) { lower_bound = std::min(std::max(lower_bound, bound), best->cost); }
  void raise_parts(std::int64_t parts);
  [[nodiscard]] Line line_of(const std::vector<CellIndex>& cells, int second) const;
  void relax_at(std::int64_t price);
  void search_in_time();

  PursuitProblem problem;
  Stage stage = Stage::unasked;
  std::optional<PursuitPlan> best;
  std::uint64_t lower_bound = 0;
  std::optional<int> earliest_s;
  PursuitCounters counters;

  std::unique_ptr<PursuitField> field;
  std::unique_ptr<Reach> reach;
  std::unique_ptr<Relaxation> running;
  std::vector<std::unique_ptr<Relaxation>> relaxations;  // relaxations that have run
  Line in_time, too_late;                                // the latest relaxed ways of either kind
  std::unique_ptr<LabelSearch> labels;
  std::unique_ptr<LayeredSearch> layers;
};

void AnytimePursuit::Search::offer(const std::vector<CellIndex>& cells, int second) {
  PursuitPlan plan = plan_of(problem, *field, cells, second);
  if (!best || plan.cost < best->cost) best = std::move(plan);
}

void AnytimePursuit::Search::raise_parts(std::int64_t parts) {
  raise(static_cast<std::uint64_t>(std::max<std::int64_t>(0, parts + price_parts - 1) / price_parts));
}

Line AnytimePursuit::Search::line_of(const std::vector<CellIndex>& cells, int second) const {
  Line line;
  for (std::size_t i = 0; i + 1 < cells.size(); ++i)
    line.cost += price_parts * std::int64_t{field->costs[cells[i]]};
  line.slack_s = second - static_cast<std::int64_t>(cells.size() - 1);
  return line;
}

/// Finds the earliest catch, then all other seconds in which a catch may be cheaper.
bool AnytimePursuit::Search::flood(BudgetMeter& meter) {
  if (!reach->next_catch(meter)) return false;
  if (reach->catches.empty()) return true;
  const auto least_cost = [](int second, std::uint32_t price) {
    return static_cast<std::uint64_t>(second) * price;
  };
  if (!best) {
    const int second = reach->catches.front();
    const std::vector<CellIndex> way = reach->path_to(field->target[static_cast<std::size_t>(second)]);
    offer(way, second);
    in_time = line_of(way, second);
    earliest_s = problem.start_s + second;
    raise(least_cost(second, field->cheapest));
    return true;
  }
  if (!reach->complete && least_cost(reach->catches.back(), field->cheapest) < best->cost) return true;
  raise(least_cost(reach->catches.front(), reach->cheapest));
  while (reach->catches.size() > 1 && least_cost(reach->catches.back(), reach->cheapest) >= best->cost) {
    reach->catches.pop_back();
  }
  relax_at(price_parts * std::int64_t{reach->cheapest});
  return true;
}

/// Maximises the concave, piecewise linear dual function: evaluates it at the price where the lines of the
/// best path in time and of the best late path meet, until neither improves.
bool AnytimePursuit::Search::relax(BudgetMeter& meter) {
  if (!running->run(meter)) return false;
  const std::int64_t parts = running->bound(field->start, 0);
  const TimedWay way = running->way();
  const Line line = line_of(way.cells, way.second);
  const bool first = relaxations.empty();
  const bool tight = !first && std::min(in_time.at(running->price()), too_late.at(running->price())) <= parts;
  raise_parts(parts);
  relaxations.push_back(std::move(running));
  if (line.slack_s >= 0) offer(way.cells, way.second);
  (line.slack_s >= 0 ? in_time : too_late) = line;
  if (tight || (first && line.slack_s >= 0) || relaxations.size() == most_relaxations) {
    search_in_time();
  } else {
    relax_at(std::min(crossing(in_time, too_late), relaxations.front()->price()));
  }
  return true;
}

void AnytimePursuit::Search::relax_at(std::int64_t price) {
  stage = Stage::prices;
  price = std::max(price, -most_total / (4 * std::int64_t{field->last_s} + 4));
  running = std::make_unique<Relaxation>(*field, reach->cells, reach->catches, price);
}

/// Keeps the relaxation that is exact if time does not matter, and those with the best bounds.
void AnytimePursuit::Search::search_in_time() {
  stage = Stage::labels;
  std::sort(relaxations.begin() + 1, relaxations.end(), [&](const auto& a, const auto& b) {
    const std::int64_t bound_a = a->bound(field->start, 0), bound_b = b->bound(field->start, 0);
    return bound_a != bound_b ? bound_a > bound_b : a->price() > b->price();
  });
  if (relaxations.size() > kept_relaxations) relaxations.resize(kept_relaxations);
  labels =
      std::make_unique<LabelSearch>(*field, relaxations, best->cost, label_work_per_cell * reach->size());
}

/// Switches to the layered search if there are too many labels.
bool AnytimePursuit::Search::search_labels(BudgetMeter& meter) {
  const std::optional<TimedWay> way = labels->next_better(meter);
  counters.labels = labels->labels();
  if (way) offer(way->cells, way->second);
  raise(labels->lower_bound());
  if (labels->gave_up()) {
    labels.reset();
    stage = Stage::layers;
    layers = std::make_unique<LayeredSearch>(*field, relaxations, best->cost);
    return true;
  }
  return way || labels->exhausted();
}

bool AnytimePursuit::Search::search_layers(BudgetMeter& meter) {
  const std::optional<TimedWay> way = layers->next_better(meter);
  if (way) offer(way->cells, way->second);
  raise(layers->lower_bound());
  return way || layers->exhausted();
}

bool AnytimePursuit::Search::work(BudgetMeter& meter) {
  if (stage == Stage::reach) return flood(meter);
  if (stage == Stage::prices) return relax(meter);
  if (stage == Stage::labels) return search_labels(meter);
  return search_layers(meter);
}

Status AnytimePursuit::Search::begin() {
  if (Status good = check(problem); !good) return good;
  field = std::make_unique<PursuitField>(problem);
  reach = std::make_unique<Reach>(*field);
  stage = Stage::reach;
  return {};
}

Status AnytimePursuit::Search::improve(BudgetMeter& meter) {
  if (stage == Stage::unasked) {
    if (Status good = begin(); !good) return good;
  }
  const std::uint64_t spent_before = meter.spent();
  const std::uint64_t cost_before = best ? best->cost : unreachable;
  bool worked = true;
  while (worked && stage != Stage::proven && (!best || best->cost == cost_before)) {
    worked = work(meter);
    if (!best && reach->complete) return fault(FaultCode::no_path, why_no_catch(problem)->sentence);
    if (best && best->cost == lower_bound) stage = Stage::proven;
  }
  counters.expansions += meter.spent() - spent_before;
  if (best) {
    best->lower_bound = lower_bound;
    best->earliest_catch_s = *earliest_s;
    best->counters = counters;
  }
  if (worked || stage == Stage::proven) return {};
  tl::unexpected<Fault> refusal = meter.refusal();
  if (refusal.value().code == FaultCode::cancelled) return refusal;
  return {};
}

AnytimePursuit::AnytimePursuit(PursuitProblem problem)
    : search_(std::make_unique<Search>(std::move(problem))) {}
AnytimePursuit::AnytimePursuit(AnytimePursuit&&) noexcept = default;
AnytimePursuit& AnytimePursuit::operator=(AnytimePursuit&&) noexcept = default;
AnytimePursuit::~AnytimePursuit() = default;

Status AnytimePursuit::improve(BudgetMeter& meter) { return search_->improve(meter); }
Status AnytimePursuit::improve(const Budget& budget) {
  BudgetMeter meter(budget);
  return search_->improve(meter);
}
const std::optional<PursuitPlan>& AnytimePursuit::best() const { return search_->best; }
std::uint64_t AnytimePursuit::lower_bound() const { return search_->lower_bound; }
std::optional<int> AnytimePursuit::earliest_catch_s() const { return search_->earliest_s; }
bool AnytimePursuit::proven() const { return search_->stage == Search::Stage::proven; }
const PursuitCounters& AnytimePursuit::counters() const { return search_->counters; }

std::vector<Option> describe(AnytimePursuitOptions&) { return {}; }

Outcome<PursuitPlan> anytime_pursuit(const PursuitProblem& problem, const AnytimePursuitOptions&,
                                     const Budget& budget, Workspace&) {
  AnytimePursuit search(problem);
  BudgetMeter meter(budget);
  std::uint64_t before = 0;
  do {
    before = search.counters().expansions;
    if (Status worked = search.improve(meter); !worked) return pass_on(worked);
  } while (!search.proven() && search.counters().expansions > before);
  if (!search.best()) return meter.refusal();
  return *search.best();
}

}  // namespace outrider
