#include "outrider/pursuit/anytime.hpp"

#include <algorithm>
#include <utility>

#include "bounds/price_search.hpp"
#include "bounds/reach.hpp"
#include "detour.hpp"
#include "label_search.hpp"
#include "outrider/pursuit/miss.hpp"
#include "sweeps/box_sweep.hpp"
#include "sweeps/tube_search.hpp"

namespace outrider {
namespace {

constexpr std::size_t kept_relaxations = 4;
constexpr std::uint64_t label_work_per_cell = 8;  // after this work the sweep takes over

// A sweep over the boxes alone is quickest where they hold few cells for those of the map, since all else
// reads the map at least once. On the smallest maps neither takes long.
constexpr std::uint64_t box_share = 24;
constexpr std::uint64_t most_box_work = std::uint64_t{1} << 24U;  // 4 bytes each
constexpr std::uint64_t least_for_boxes = 4096;                   // cells of the map

// The work of the sweep is known beforehand, in cells. All else is limited by it, so that the sum is never
// much more than the sweep alone.
constexpr std::uint64_t cells_per_expansion = 128;  // swept in the time of one expansion
constexpr std::uint64_t cells_per_label_work = 64;  // and in that of one unit of the search of labels
constexpr std::uint64_t sweep_at_once = 8;  // so many relaxations: what is swept sooner is swept without any
constexpr std::uint64_t search_share = 16;  // 1/16 of the work for relaxations, and as much for labels
constexpr std::uint64_t tube_share = 32;
constexpr std::uint64_t least_for_tubes = std::uint64_t{1} << 27U;  // cells swept in some 40 ms
constexpr std::uint64_t way_share = 8;  // ways are extracted after eight times the work of extracting one

}  // namespace

struct AnytimePursuit::Search {
  enum class Stage { unasked, boxes, reach, prices, bound, tubes, labels, sweep, proven };

  explicit Search(PursuitProblem asked) : problem(std::move(asked)) {}

  Status begin();
  void begin_reach();
  Status improve(BudgetMeter& meter);
  bool keep_to(int second);

  /// Does a part of the work of the present stage, or of each stage. Returns false if the budget ended first.
  bool work(BudgetMeter& meter);
  bool sweep_boxes(BudgetMeter& meter);
  bool flood(BudgetMeter& meter);
  bool relax(BudgetMeter& meter);
  bool refine(BudgetMeter& meter);
  bool search_labels(BudgetMeter& meter);
  bool bound_from_start(BudgetMeter& meter);
  bool sweep_layers(BudgetMeter& meter);

  void offer(const TimedWay& way);
  void raise(std::uint64_t bound) { lower_bound = std::min(std::max(lower_bound, bound), best->cost); }
  void begin_search();
  void begin_tubes(Stage next);
  void begin_labels();
  void begin_bound();
  void begin_sweep();
  void extract_way();
  [[nodiscard]] std::uint64_t cost_ahead(std::size_t second) const;
  [[nodiscard]] TimedWay best_way() const;
  [[nodiscard]] std::uint64_t relaxation_work() const { return cells_per_expansion * reach->size(); }

  PursuitProblem problem;
  Stage stage = Stage::unasked;
  std::optional<PursuitPlan> best;
  std::uint64_t lower_bound = 0;
  std::optional<int> earliest_s;
  PursuitCounters counters;

  std::optional<BoxSweep> small;
  std::unique_ptr<PursuitField> field;  // none while `small` is asked, or if it had the answer
  std::uint64_t paid = 0;               // from the beginning to the start of the field
  bool moved_on = false;                // the start is no longer the first cell
  std::unique_ptr<Reach> reach;
  std::vector<CellBox> boxes;
  std::uint64_t sweep_work = 0;
  std::optional<AnySweepMap> map;
  std::unique_ptr<PriceSearch> prices;
  std::unique_ptr<TubeSearch> tubes;
  Stage after_tubes = Stage::sweep;
  std::unique_ptr<LabelSearch> labels;
  std::unique_ptr<ForwardBound> forward;
  std::unique_ptr<BackwardSweep> sweep;
  std::uint64_t extracted_at = 0;  // work of the sweep when a way was last extracted
};

/// Takes the plan along a way if it is cheaper. It waits in the first of the cheapest cells of the way, and
/// ends where it meets the target, even if that is earlier than intended.
void AnytimePursuit::Search::offer(const TimedWay& way) {
  const auto cheapest = std::min_element(way.cells.begin(), way.cells.end(), [&](CellIndex a, CellIndex b) {
    return field->costs[a] < field->costs[b];
  });
  const std::size_t waits = static_cast<std::size_t>(way.second - field->start_s) + 1 - way.cells.size();
  PursuitPlan plan;
  plan.cost = paid;
  if (field->start_s > 0) plan.path.assign(best->path.begin(), best->path.begin() + field->start_s);
  const auto begun = plan.path.size();
  const auto stay = [&](CellIndex i) {
    const std::size_t now = plan.path.size();
    if (now > begun + 1 && field->target[now - 1] == field->index(plan.path.back())) return;  // caught
    if (now > begun) plan.cost += field->costs[field->index(plan.path.back())];
    plan.path.push_back(field->cell(i));
  };
  for (auto i = way.cells.begin(); i != way.cells.end(); ++i) {
    stay(*i);
    for (std::size_t k = 0; i == cheapest && k < waits; ++k) stay(*i);
  }
  plan.catch_time_s = problem.start_s + static_cast<int>(plan.path.size()) - 1;
  if (!best || plan.cost < best->cost) best = std::move(plan);
}

/// Returns the cost of the best catch from that second on, which it reaches.
std::uint64_t AnytimePursuit::Search::cost_ahead(std::size_t second) const {
  std::uint64_t cost = 0;
  for (std::size_t s = second; s + 1 < best->path.size(); ++s)
    cost += field->costs[field->index(best->path[s])];
  return cost;
}

TimedWay AnytimePursuit::Search::best_way() const {
  TimedWay way{{}, static_cast<int>(best->path.size()) - 1};
  for (auto at = best->path.begin() + field->start_s; at != best->path.end(); ++at)
    way.cells.push_back(field->index(*at));
  return way;
}

/// Finds the cheapest catch at once where the boxes are small.
bool AnytimePursuit::Search::sweep_boxes(BudgetMeter& meter) {
  if (!small->run(meter)) return false;
  best = small->plan();
  small.reset();
  if (!best) {
    begin_reach();
    return true;
  }
  earliest_s = best->earliest_catch_s;
  raise(best->cost);
  return true;
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
    offer({reach->path_to(field->target[static_cast<std::size_t>(second)]), second});
    earliest_s = problem.start_s + second;
    raise(least_cost(second, field->cheapest));
    return true;
  }
  if (!reach->complete && least_cost(reach->catches.back(), field->cheapest) < best->cost) return true;
  raise(least_cost(reach->catches.front(), reach->cheapest));
  while (reach->catches.size() > 1 && least_cost(reach->catches.back(), reach->cheapest) >= best->cost) {
    reach->catches.pop_back();
  }
  begin_search();
  return true;
}

void AnytimePursuit::Search::begin_search() {
  boxes = pursuit_boxes(*field, reach->catches, field->start, field->start_s);
  for (const CellBox& box : boxes) sweep_work += box.area();
  map = sweep_map(*field, reach->catches.front(), best->cost, fastest_processor());
  if (sweep_work <= sweep_at_once * relaxation_work()) return begin_tubes(Stage::sweep);
  prices = std::make_unique<PriceSearch>(*field, reach->cells, reach->catches,
                                         price_parts * std::int64_t{reach->cheapest}, best_way());
  stage = Stage::prices;
}

/// Runs one relaxation. The first is followed by tubes, so that the best catch is soon a good one.
bool AnytimePursuit::Search::relax(BudgetMeter& meter) {
  if (!prices->run(meter)) return false;
  const std::int64_t parts = std::max<std::int64_t>(0, prices->bound() + price_parts - 1);
  raise(paid + static_cast<std::uint64_t>(parts / price_parts));
  if (const auto way = prices->take_way()) offer(*way);
  const bool enough = moved_on || (prices->count() + 1) * relaxation_work() > sweep_work / search_share;
  const bool finished = prices->finished() || enough;
  if (finished) prices->keep_best(kept_relaxations);
  if (finished) {
    begin_bound();
  } else if (prices->count() == 1) {
    begin_tubes(Stage::prices);
  }
  return true;
}

void AnytimePursuit::Search::begin_tubes(Stage next) {
  stage = Stage::tubes;
  after_tubes = next;
  const std::uint64_t most = sweep_work < least_for_tubes ? 0 : sweep_work / tube_share;
  tubes = std::make_unique<TubeSearch>(*map, *field, boxes, std::min(most, relaxation_work()));
}

bool AnytimePursuit::Search::refine(BudgetMeter& meter) {
  const std::optional<TimedWay> way = tubes->next_better(meter, best->path, best->cost - paid);
  if (way) offer(*way);
  if (!tubes->exhausted()) return way.has_value();
  tubes.reset();
  stage = after_tubes;
  if (stage == Stage::labels) begin_labels();
  if (stage == Stage::sweep) begin_sweep();
  return true;
}

void AnytimePursuit::Search::begin_labels() {
  stage = Stage::labels;
  const std::uint64_t most = sweep_work / search_share / cells_per_label_work;
  labels = std::make_unique<LabelSearch>(*field, prices->relaxations(), best->cost - paid,
                                         std::min(most, label_work_per_cell * reach->size()));
}

/// Switches to the sweep if there are too many labels.
bool AnytimePursuit::Search::search_labels(BudgetMeter& meter) {
  const std::uint64_t before = labels->labels();
  const std::optional<TimedWay> way = labels->next_better(meter);
  counters.labels += labels->labels() - before;
  if (way) offer(*way);
  raise(paid + labels->lower_bound());
  if (!labels->gave_up()) return way || labels->exhausted();
  begin_sweep();
  return true;
}

void AnytimePursuit::Search::begin_bound() {
  stage = Stage::bound;
  forward = std::make_unique<ForwardBound>(*field, reach->cells, field->start, field->start_s, paid,
                                           prices->best().price());
}

/// Bounds the way to each cell, which also shows where it is best to wait.
bool AnytimePursuit::Search::bound_from_start(BudgetMeter& meter) {
  if (!forward->run(meter)) return false;
  if (const auto way = best_detour(*field, *forward, prices->best())) offer(*way);
  begin_tubes(Stage::labels);
  return true;
}

void AnytimePursuit::Search::begin_sweep() {
  stage = Stage::sweep;
  labels.reset();
  prices.reset();
  map = sweep_map(*field, reach->catches.front(), best->cost,
                  fastest_processor());  // smaller numbers may do by now
  sweep = full_sweep(*map, boxes, forward.get());
}

/// Improves the end of the best catch from time to time, and all of it when the sweep has come to the start.
bool AnytimePursuit::Search::sweep_layers(BudgetMeter& meter) {
  if (sweep->second() > field->start_s && !sweep->advance(meter, best->cost)) return false;
  const bool done = sweep->second() <= field->start_s;
  if (done || sweep->work() - extracted_at >= way_share * sweep->way_work()) extract_way();
  if (done) raise(best->cost);
  return true;
}

/// Continues the best catch from the second of the sweep as cheaply as can be.
void AnytimePursuit::Search::extract_way() {
  const auto second = static_cast<std::size_t>(std::max(sweep->second(), field->start_s));
  if (second + 1 >= best->path.size()) return;
  const CellIndex from = field->index(best->path[second]);
  if (sweep->to_go(from) >= cost_ahead(second)) return;
  const TimedWay end = sweep->way_from(from);
  TimedWay way = best_way();
  way.cells.resize(second - static_cast<std::size_t>(field->start_s));
  way.cells.insert(way.cells.end(), end.cells.begin(), end.cells.end());
  way.second = end.second;
  offer(way);
  extracted_at = sweep->work();
}

/// The stages that know what can be reached, and from where the target can be, go on; those that search from
/// the start end or begin again.
bool AnytimePursuit::Search::keep_to(int second) {
  const int start_s = second - problem.start_s;
  if (!best || static_cast<std::size_t>(start_s) + 1 >= best->path.size()) return false;
  if (!field || start_s <= field->start_s) return true;
  moved_on = true;
  paid +=
      cost_ahead(static_cast<std::size_t>(field->start_s)) - cost_ahead(static_cast<std::size_t>(start_s));
  field->start_s = start_s;
  field->start = field->index(best->path[static_cast<std::size_t>(start_s)]);
  if (stage == Stage::tubes) begin_tubes(after_tubes);
  if (stage == Stage::bound) begin_bound();
  if (stage == Stage::labels) begin_sweep();
  return true;
}

bool AnytimePursuit::Search::work(BudgetMeter& meter) {
  if (stage == Stage::boxes) return sweep_boxes(meter);
  if (stage == Stage::reach) return flood(meter);
  if (stage == Stage::prices) return relax(meter);
  if (stage == Stage::tubes) return refine(meter);
  if (stage == Stage::labels) return search_labels(meter);
  if (stage == Stage::bound) return bound_from_start(meter);
  return sweep_layers(meter);
}

Status AnytimePursuit::Search::begin() {
  if (Status good = check(problem); !good) return good;
  const std::uint64_t cells = problem.costs->cells.size();
  if (cells >= least_for_boxes) small.emplace(problem);
  if (small && small->work() <= std::min(box_share * cells, most_box_work) && small->prepare()) {
    stage = Stage::boxes;
    return {};
  }
  small.reset();
  begin_reach();
  return {};
}

void AnytimePursuit::Search::begin_reach() {
  stage = Stage::reach;
  field = std::make_unique<PursuitField>(problem);
  reach = std::make_unique<Reach>(*field);
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
    if (!best && reach && reach->complete) return fault(FaultCode::no_path, why_no_catch(problem)->sentence);
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
bool AnytimePursuit::keep_to(int second) { return search_->keep_to(second); }
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
