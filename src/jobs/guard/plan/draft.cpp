#include "plan/draft.hpp"

#include <algorithm>
#include <limits>

#include "outrider/core/parallel.hpp"
#include "outrider/jobs/guard/plan/plan.hpp"

namespace outrider {
namespace {

constexpr std::size_t stops_at_first = 300;  // the first rounds offer no more, so that more never harm

/// How closely better stops are looked for around those of a tour.
struct Closeness {
  double near_m;      // distance from a stop
  double tile_cells;  // side of the tiles, by cells of the firing map
  std::size_t most;   // stops that are offered
};

/// One after another: all around, closely, and both again where more stops are wanted.
std::vector<Closeness> rounds(std::size_t most) {
  const std::size_t first = std::min(most, stops_at_first);
  std::vector<Closeness> all{{1.2, 2.0, first}, {0.4, 1.0, first}};
  if (most > first) all.insert(all.end(), {{1.2, 2.0, most}, {0.4, 1.0, most}});
  return all;
}
constexpr double coarse_tile_m = 0.8;
constexpr std::size_t most_alone = 40;  // targets, beyond which one search for a tour finds too little
constexpr std::size_t searches = 4;     // for so many
constexpr double told_gain = 0.01;      // part by which a tour is faster than the one that was told before

/// Everything that solving over one set of cells after another has in common.
struct Drafting {
  const GuardProblem& problem;
  const FiringMap& firing_map;
  const GuardOptions& options;
  const Budget& budget;
  ShotBook& book;
  const DraftObserver& observe;
  SureHits hits;
  std::vector<std::size_t> targets;  // by goal
  std::vector<std::size_t> needed;   // cells that are always among the stops
  std::int64_t exact_goals = 0;      // as in DraftTask
};

tl::unexpected<Fault> cancelled() {
  return fault(FaultCode::cancelled, "it was cancelled while it drafted the tour");
}

/// Finds the shots of these cells that are not in the book yet.
/// Fault: cancelled; then shots are missing.
Status fill(const Drafting& drafting, const std::vector<std::size_t>& cells) {
  std::vector<ShotBook::iterator> missing;
  for (const std::size_t cell : cells) {
    for (const std::size_t t : drafting.targets) {
      if (!drafting.hits.has(cell, t)) continue;
      const auto [entry, added] = drafting.book.try_emplace({cell, t});
      if (added) missing.push_back(entry);
    }
  }
  const FiringMap& firing_map = drafting.firing_map;
  const auto pitches = pitch_lattice(firing_map.rules);
  const bool done = parallel_for(missing.size(), drafting.budget.stop, [&](std::size_t i) {
    const auto [cell, t] = missing[i]->first;
    missing[i]->second = shot_from(drafting.problem, firing_map, t, firing_map.place(cell),
                                   pitches[firing_map.regions[t].pitch[cell]]);
  });
  return done ? Status{} : Status(cancelled());
}

/// The cell of a target's region with the least error_ratio from which it has an exact shot, which joins the
/// book.
std::optional<std::size_t> any_cell_with_shot(Drafting& drafting, std::size_t t) {
  const FiringRegion& region = drafting.firing_map.regions[t];
  std::vector<std::size_t> cells;
  region.pitch.each([&](std::size_t i, std::uint8_t pitch) {
    if (pitch != FiringRegion::no_shot) cells.push_back(i);
  });
  std::stable_sort(cells.begin(), cells.end(), [&](std::size_t a, std::size_t b) {
    return region.error_ratio[a] < region.error_ratio[b];
  });
  for (const std::size_t cell : cells) {
    if (drafting.budget.stop.stop_requested()) return std::nullopt;
    const auto shot =
        shot_from(drafting.problem, drafting.firing_map, t, drafting.firing_map.place(cell), 0.0);
    if (!shot) continue;
    drafting.book[{cell, t}] = shot;
    drafting.hits.add(cell, t);
    return cell;
  }
  return std::nullopt;
}

/// Adds a cell for each target that has no exact shot from the given ones; drops it when none has.
Status cover_all(Drafting& drafting, std::vector<std::size_t>& cells) {
  if (auto ok = fill(drafting, cells); !ok) return ok;
  std::erase_if(drafting.targets, [&](std::size_t t) {
    const bool covered = std::any_of(cells.begin(), cells.end(), [&](std::size_t cell) {
      const auto entry = drafting.book.find({cell, t});
      return entry != drafting.book.end() && entry->second;
    });
    if (covered) return false;
    const auto cell = any_cell_with_shot(drafting, t);
    if (cell) drafting.needed.push_back(*cell);
    return !cell;
  });
  cells.insert(cells.end(), drafting.needed.begin(), drafting.needed.end());
  return drafting.budget.stop.stop_requested() ? Status(cancelled()) : Status{};
}

/// The shots known from the cells. The first of the cells stands for the start, where none is offered.
std::vector<ShotOffer> offers_from(const Drafting& drafting, const std::vector<std::size_t>& cells) {
  std::vector<ShotOffer> offers;
  for (std::size_t goal = 0; goal < drafting.targets.size(); ++goal) {
    for (std::size_t i = 1; i < cells.size(); ++i) {
      const auto entry = drafting.book.find({cells[i], drafting.targets[goal]});
      if (entry != drafting.book.end()) offers.push_back({i, goal, entry->second});
    }
  }
  return offers;
}

/// Tells the observer of tours over the stops of a draft, when they are faster than those before. `told_s` is
/// the time of the last one told.
TourObserver teller(const Drafting& drafting, const Draft& draft, double& told_s) {
  if (!drafting.observe) return {};
  return [&drafting, &draft, &told_s](const std::vector<Visit>& visits, double cost_s) {
    if (cost_s > (1.0 - told_gain) * told_s) return;
    told_s = cost_s;
    TourDraft told{{}, {drafting.problem.start.position}, cost_s, 0.0};
    std::size_t at = 0;
    for (const Visit& visit : visits) {
      DraftStop& stop = told.stops.emplace_back(DraftStop{draft.offered.stops[visit.stop], {}});
      for (const std::uint32_t goal : visit.goals) stop.targets.push_back(draft.targets[goal]);
      const auto leg = draft.offered.routes.waypoints(at, visit.stop);
      told.way.insert(told.way.end(), leg.begin(), leg.end());
      at = visit.stop;
    }
    drafting.observe(told);
  };
}

Outcome<Draft> solve_over(const Drafting& drafting, const std::vector<std::size_t>& cells, double& told_s) {
  const GuardProblem& problem = drafting.problem;
  if (auto ok = fill(drafting, cells); !ok) return pass_on(ok);
  Draft draft{{0}, drafting.targets, {}, {}};
  draft.cells.insert(draft.cells.end(), cells.begin(), cells.end());
  std::vector<Vec2> places{problem.start.position};
  for (const std::size_t cell : cells) places.push_back(drafting.firing_map.place(cell));
  auto offered =
      stop_table(problem, drafting.firing_map, std::move(places), drafting.targets.size(),
                 offers_from(drafting, draft.cells), drafting.options.shoot_on_the_move, drafting.budget);
  if (!offered) return pass_on(offered);
  draft.offered = std::move(*offered);
  TourOptions tour_options;
  tour_options.exact_goals = drafting.exact_goals;
  tour_options.iterations = drafting.options.iterations;
  tour_options.gap = 1.0;
  auto solved = solve(draft.offered.table, tour_options, drafting.budget, teller(drafting, draft, told_s));
  if (!solved) return pass_on(solved);
  draft.tour = std::move(*solved);
  return draft;
}

/// The best tour of a few longer searches over the same stops, each with a seed of its own.
Status search_on(const Drafting& drafting, Draft& draft) {
  std::vector<std::optional<Outcome<Tour>>> found(searches);
  parallel_for(searches, [&](std::size_t i) {
    TourOptions options;
    options.exact_goals = drafting.exact_goals;
    options.iterations = 16 * drafting.options.iterations;
    options.gap = 1.0;
    options.seed = static_cast<std::int64_t>(i) + 1;
    found[i] = solve_from(draft.offered.table, draft.tour, options, drafting.budget);
  });
  for (std::optional<Outcome<Tour>>& tour : found) {
    if (!*tour) return pass_on(*tour);
    if ((*tour)->cost_s < draft.tour.cost_s) draft.tour = std::move(**tour);
  }
  return {};
}

/// Improves the tour once more over the same stops, and bounds or proves it.
Status settle(const Drafting& drafting, Draft& draft, double& told_s) {
  TourOptions options;
  options.exact_goals = drafting.exact_goals;
  options.iterations = 4 * drafting.options.iterations;
  options.gap = drafting.options.gap;
  options.expansions = 300'000;
  if (draft.targets.size() > most_alone && options.gap < 1.0) {
    if (auto ok = search_on(drafting, draft); !ok) return ok;
    options.iterations = 0;
  }
  // A proof would hold only for a gun that rests during drives.
  if (drafting.options.shoot_on_the_move) options.gap = 1.0;
  if (drafting.options.prove) {
    options.gap = 0.0;
    options.operations = 1'000'000'000'000;
    options.expansions = 2 * drafting.options.memory_mib * 1024;  // of some 250 bytes: half of the cap
  }
  auto solved =
      solve_from(draft.offered.table, draft.tour, options, drafting.budget, teller(drafting, draft, told_s));
  if (!solved) return pass_on(solved);
  draft.tour = std::move(*solved);
  return {};
}

/// The stops of a tour and the cells around them.
std::vector<std::size_t> cells_near(const Drafting& drafting, const Draft& draft, Closeness within) {
  std::vector<std::size_t> cells = drafting.needed;
  std::vector<Vec2> around;
  for (const Visit& visit : draft.tour.visits) {
    cells.push_back(draft.cells[visit.stop]);
    around.push_back(drafting.firing_map.place(cells.back()));
  }
  const double tile = within.tile_cells * drafting.firing_map.frame.resolution_m;
  for (const std::size_t cell :
       choose_stops(drafting.firing_map, drafting.hits, tile, within.most, around, within.near_m)) {
    cells.push_back(cell);
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace

Outcome<Draft> draft_tour(const GuardProblem& problem, const FiringMap& firing_map, const DraftTask& task,
                          const GuardOptions& options, const Budget& budget, ShotBook& book,
                          const DraftObserver& observe) {
  Drafting drafting{problem,
                    firing_map,
                    options,
                    budget,
                    book,
                    observe,
                    sure_hits(problem, firing_map, task.targets),
                    task.targets,
                    {},
                    task.exact_goals};
  double told_s = std::numeric_limits<double>::infinity();
  const auto wanted = static_cast<std::size_t>(options.stops);
  std::size_t most = std::min(wanted, stops_at_first);
  // Among fewer stops a search finds better which parts of the yard to go to; near these it then gets all.
  if (drafting.targets.size() > most_alone) most = most * 2 / 5;
  auto cells = choose_stops(firing_map, drafting.hits, coarse_tile_m, most, {}, 0.0);
  if (auto ok = cover_all(drafting, cells); !ok) return pass_on(ok);
  auto best = solve_over(drafting, cells, told_s);
  if (!best) return best;
  choose_shots(problem, firing_map, options, book, *best);
  for (const Closeness& within : rounds(wanted)) {
    for (std::int64_t i = 0; i < options.refinements; ++i) {
      auto closer = solve_over(drafting, cells_near(drafting, *best, within), told_s);
      if (!closer) return closer;
      if (closer->tour.cost_s >= best->tour.cost_s) break;
      best = std::move(closer);
      choose_shots(problem, firing_map, options, book, *best);
    }
  }
  if (auto settled = settle(drafting, *best, told_s); !settled) return pass_on(settled);
  return best;
}

}  // namespace outrider
