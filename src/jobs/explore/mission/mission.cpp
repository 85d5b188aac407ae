#include "outrider/jobs/explore/mission/mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "outrider/jobs/explore/choose/catalog.hpp"
#include "outrider/jobs/explore/choose/view.hpp"
#include "outrider/jobs/explore/map/map_doubt.hpp"
#include "outrider/path/catalog.hpp"

namespace outrider {

ExploreMission::ExploreMission(ExploreTask task, PlannerOutage outage, ScanLocaliser& where,
                               Navigator navigator)
    : task_(std::move(task)),
      outage_(outage),
      navigator_(std::move(navigator)),
      where_(&where),
      frontiers_(task_.explore.frontier, task_.robot.radius_m),
      touches_(task_.robot.radius_m) {
  blacklist_.ban_s = task_.explore.ban_s;
}

Outcome<ExploreMission> begin(const ExploreTask& task, const PlannerOutage& outage) {
  if (auto known = find_explore_strategy(task.explore.strategy); !known) return pass_on(known);
  const auto planners = names_of_planners_in_place(GridModel::cells);
  if (std::ranges::count(planners, task.explore.planner) == 0)
    return no_such_row("planner", task.explore.planner, planners, "planner");
  auto slam = LaserSlam::begin(task.slam, task.start);
  if (!slam) return pass_on(slam);
  auto localiser =
      std::make_unique<ScanLocaliser>(std::move(*slam), task.slam, task.start, task.rules.lost_m);
  ScanLocaliser& where = *localiser;
  NavigatorSetup setup;
  setup.robot = task.robot;
  setup.footprint = Footprint::disk(task.robot.radius_m);
  setup.robot_T_laser = task.slam.robot_T_laser;
  setup.options = task.navigator;
  setup.options.period_s = task.rules.period_s;
  setup.map = task.live_map;
  setup.motion = task.motion;
  auto navigator = Navigator::make(std::move(setup), std::move(localiser));
  if (!navigator) return pass_on(navigator);
  return ExploreMission(task, outage, where, std::move(*navigator));
}

void ExploreMission::add_event(std::string kind, std::string text) {
  events_.push_back({where_->time_s(), std::move(kind), std::move(text)});
}

void ExploreMission::follow(std::vector<Vec2> points) {
  path_ = PathProgress{std::move(points), 0.0};
  gaps_.forget_path();
}

ExploreState ExploreMission::state() {
  return {frontiers_,        blacklist_,       task_.robot,
          where_->range_m(), where_->pose(),   task_.start,
          where_->time_s(),  decision_.choice, outage_.budget(where_->time_s())};
}

/// Notes when the known ground grew by more than noise makes of it.
void ExploreMission::note_new_ground() {
  constexpr double noise_m2 = 0.05;
  const TraversabilityGrid& ground = frontiers_.ground();
  const double known_m2 =
      static_cast<double>(ground.known_cells()) * ground.frame().resolution_m * ground.frame().resolution_m;
  if (learned_s_ >= where_->started_s() && known_m2 <= known_m2_ + noise_m2) return;
  known_m2_ = std::max(known_m2_, known_m2);
  learned_s_ = where_->time_s();
}

/// Tells the frontiers. A map of which much has changed is thought over with the next scan.
void ExploreMission::update_frontiers() {
  const bool first = decisions_ == 0;
  const bool keeps = where_->changed().redrawn && !first && !forgets_;
  forgets_ = false;
  const bool much = keeps ? frontiers_.update(explored_map(), where_->changed())
                          : frontiers_.update(where_->slam().map().occupancy(), where_->changed());
  touches_.mark(frontiers_.ground(), where_->slam());
  gaps_.shut_gaps(frontiers_.ground());
  navigator_.note_touched(touches_.points());
  note_new_ground();
  if (!much || first) return;
  prepare(frontiers_, task_.explore);
  where_->forget_news();
}

Grid<std::uint8_t> ExploreMission::explored_map() const {
  Grid<std::uint8_t> map = where_->slam().map().occupancy();
  const Grid<std::uint8_t>& known = frontiers_.ground().known();
  if (known.cells.empty()) return map;
  const Cell offset = known.frame.cell_at(map.frame.centre({0, 0}));
  for (int y = 0; y < map.frame.height; ++y) {
    for (int x = 0; x < map.frame.width; ++x) {
      const Cell there{x + offset.x, y + offset.y};
      if (map[{x, y}] == unknown_cell && known.contains(there) && known[there] == free_cell)
        map[{x, y}] = free_cell;
    }
  }
  return map;
}

void ExploreMission::perceive(const Observation& seen) {
  if (stage_ == ExploreStage::over) return;
  if (!where_->begun()) sighted_s_ = seen.time_s;
  const bool touched_before = std::exchange(touching_, seen.touching);
  const Localised now = where_->note(seen);
  now_ = navigator_.perceive(seen);
  forgets_ = forgets_ || now.corrected;
  if (now.redrawn) touches_.redraw();
  if (now.closed_loop) {
    ++loops_;
    path_.reset();
    add_event(
        "loop",
        now.undid_loop
            ? "a loop that was closed before contradicts the scans: it is undone, and the map was redrawn"
            : "a place was recognised, and the map was redrawn");
  }
  if (!now.lost.empty()) end("lost", now.lost);
  if (!touching_ || touched_before) return;
  touches_.note(seen, *where_, frontiers_.ground());
  navigator_.note_touched(touches_.points());
  give_up_goal("something was touched");
}

/// Asks whether the range finder can be believed. Ends the mission if it cannot.
bool ExploreMission::believes_range_finder() {
  const std::string doubt = where_->doubt_of_range_finder();
  if (!doubt.empty()) end("lost", "lost: " + doubt);
  return doubt.empty();
}

std::string ExploreMission::why_blind(double blind_s) const {
  if (blind_s > 10.0 * task_.rules.blind_s || !where_->any_usable())
    return fmt::format("no scan that could be used came for {:.1f} s", blind_s);
  return fmt::format("its scans come too late to drive by: the newest is {:.1f} s old", blind_s);
}

std::optional<Command> ExploreMission::respond() {
  if (stage_ == ExploreStage::over) return std::nullopt;
  const double time_s = where_->time_s();
  const double blind_s = where_->blind_s();
  if (blind_s > task_.rules.blind_s || !where_->any_usable()) {
    if (std::max(blind_s, time_s - sighted_s_) <= 10.0 * task_.rules.blind_s) return navigator_.act(Hold{});
    end("blind", why_blind(blind_s));
    return std::nullopt;
  }
  sighted_s_ = time_s;
  if (where_->has_news()) update_frontiers();
  const Order order = believes_range_finder() ? drive() : Order{Hold{}};
  where_->forget_news();
  if (stage_ != ExploreStage::over) return navigator_.act(order);
  where_->finish();
  return std::nullopt;
}

std::optional<Command> ExploreMission::step(const Observation& seen) {
  perceive(seen);
  return respond();
}

/// Returns the reason not to believe that the robot is home; empty if it is not there, or sees there what it
/// saw first.
std::string ExploreMission::home_doubt() {
  constexpr double most_contradicted = 0.1;  // people who stand there make some
  const auto contradicted = home_.is_there ? where_->contradiction_of_first_scan() : std::nullopt;
  if (!contradicted) return {};
  home_.contradiction = *contradicted;
  if (*contradicted <= most_contradicted) return {};
  return fmt::format(
      "it should be home, but {:.0f} % of what it sees there contradicts what it saw there first; was "
      "it moved?",
      100.0 * *contradicted);
}

/// Judges what is left over on the map as it is in the end.
void ExploreMission::judge_what_is_left() {
  if (frontiers_.frame().size() == 0) return;
  const auto decision = explored() ? decide_with_tries() : decide(state(), task_.explore, workspace_);
  if (decision) decision_.refused = decision->refused;
  left_ = left_over(state(), task_.explore, decision_.refused, true, gaps_.places());
  if (!explored()) return;
  std::string doubt = map_doubt(where_->slam());
  if (doubt.empty()) doubt = home_doubt();
  if (!doubt.empty()) {
    stop_reason_ = "lost";
    reason_ = "lost: " + doubt;
    return;
  }
  std::tie(stop_reason_, reason_) = verdict();
}

void ExploreMission::end(std::string stop_reason, std::string reason) {
  stage_ = ExploreStage::over;
  path_.reset();
  stop_reason_ = std::move(stop_reason);
  reason_ = std::move(reason);
  judge_what_is_left();
  add_event("end", reason_);
}

}  // namespace outrider
