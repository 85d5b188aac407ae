#include "outrider/jobs/cover/mission/orders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "ground/tool_coverage.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/polyline.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

constexpr double bend_m = 0.1, bend_rad = radians(2.0);  // between two points of the way
constexpr double speck_m = 0.015;  // half the width of places that are left and do not count
constexpr double spot_m = 1.0, circling_rad = 10.0 * pi;  // five turns in one place
constexpr double stand_s = 10.0;
constexpr int most_stands = 8;
constexpr int most_rounds = 6;
constexpr double least_gain = 0.1;  // of what was left, that a round has to cover
constexpr int corners = 8;          // of what stands around a mark
constexpr double chord_m = 0.003;   // between an arc and its chords
constexpr double simpler_m = 0.01;  // by which what stands there may seem larger or smaller

/// Returns the polygon that contains a place, or else the nearest.
const RingedPolygon& part_around(const Region& region, Vec2 place) {
  return *std::ranges::min_element(region, {}, [&](const RingedPolygon& part) {
    return contains(part, place) ? 0.0 : distance_to_border(part, place);
  });
}

/// Returns the region with fewer corners: each ring within `off_m` of what it was.
Region simpler(const Region& region, double off_m) {
  const auto ring_of = [off_m](std::vector<Vec2> ring) {
    ring.push_back(ring.front());
    ring = simplified(ring, off_m);
    ring.pop_back();
    return ring;
  };
  std::vector<Region> parts;
  for (const RingedPolygon& part : region) {
    std::vector<std::vector<Vec2>> holes;
    std::ranges::transform(part.holes, std::back_inserter(holes), ring_of);
    std::erase_if(holes, [](const auto& hole) { return hole.size() < 3; });
    parts.push_back(region_of(ring_of(part.outer), holes));
  }
  return united(parts);
}

void add_place(PieceDrive& drive, double time_s, Vec2 place) {
  drive.way.push_back(place);
  drive.times_s.push_back(time_s);
}

}  // namespace

Region without_specks(const Region& left) { return opened(left, speck_m, chord_m); }

bool is_leap(Vec2 from, Vec2 to, double within_s, const Pace& pace) {
  constexpr double slack_m = 0.02;
  return distance(from, to) > 2.0 * pace.speed_mps * within_s + slack_m;
}

CoverOrders::CoverOrders(const CoverProblem& problem, const CoverMethod& method, const CoverOptions& options,
                         const CoverPlan& plan, double rim_m, Budget budget)
    : problem_(problem),
      method_(method),
      options_(options),
      plan_(plan),
      rim_m_(rim_m),
      budget_(std::move(budget)),
      tracks_{std::make_shared<const TrackPieces>(plan.track.pieces)} {
  options_.order.gap = 1.0;  // a rest is driven in a good order, of which nothing has to be proven
}

double CoverOrders::driven_part(const Navigator& navigator) const {
  const auto behind = static_cast<double>(all_tracks_ - tracks_.size());
  const TrackFollower* track = navigator.track();
  const bool follows = track != nullptr && !tracks_.empty() && track->track() == tracks_.front();
  const double part =
      follows ? static_cast<double>(track->at().piece) / static_cast<double>(track->track()->size()) : 0.0;
  return (behind + part) / static_cast<double>(all_tracks_);
}

/// Notes the way: its points are where it bends, so that chords are at most 2 mm beside it. While it is
/// carried, the robot covers nothing.
void CoverOrders::note(double time_s, const Pose2& pose) {
  std::vector<Vec2>& way = believed_.way;
  const bool leaps = !way.empty() && is_leap(here_.position, pose.position, time_s - time_s_, problem_.pace);
  if (leaps) add_place(believed_, time_s_, here_.position);
  if (leaps) believed_.carried.push_back({time_s_, time_s});
  note_circling(time_s, pose);
  here_ = pose;
  time_s_ = time_s;
  const bool bends = std::abs(wrap_angle(pose.heading_rad - heading_rad_)) > bend_rad;
  if (!leaps && !way.empty() && distance(way.back(), pose.position) < (bends ? 1e-3 : bend_m)) return;
  add_place(believed_, time_s, pose.position);
  heading_rad_ = pose.heading_rad;
}

/// Notes how far the robot has turned on the spot: with a wheel that sticks it circles about that. It stands
/// for a while then, and gives up after a number of times.
void CoverOrders::note_circling(double time_s, const Pose2& pose) {
  if (believed_.way.empty() || distance(pose.position, spot_) > spot_m) {
    spot_ = pose.position;
    turned_rad_ = 0.0;
    stands_ = 0;
  } else {
    turned_rad_ += std::abs(wrap_angle(pose.heading_rad - here_.heading_rad));
  }
  if (turned_rad_ < circling_rad) return;
  turned_rad_ = 0.0;
  stands_until_s_ = time_s + stand_s;
  if (++stands_ > most_stands) reason_ = "the robot circles and does not get on; does a wheel stick?";
}

std::optional<Order> CoverOrders::next(const Situation& now, const Navigator& navigator) {
  note(now.time_s, now.pose);
  if (complete_ || !reason_.empty()) return std::nullopt;
  if (now.progress.state == Progress::State::lost) {
    reason_ = now.progress.why;
    return std::nullopt;
  }
  if (now.time_s < stands_until_s_) return Hold{};
  const TrackFollower* track = navigator.track();
  const bool ended = track != nullptr && track->track() == tracks_.front() && track->is_done();
  if (ended) {
    tracks_.pop_front();
    if (tracks_.empty() && !plan_rest(navigator)) return std::nullopt;
  }
  return Follow{tracks_.front(), std::max(0.02, 2.0 * problem_.tracking_error_m)};
}

/// Returns what stands in the area for sure, with a rim, and where the robot does not fit in. Stray readings
/// are seen once or twice in a place; the robot drives around them, but they are no reason to leave ground
/// out.
Region CoverOrders::things(const Navigator& navigator) const {
  std::vector<Region> all;
  const auto add = [&](Vec2 place) {
    std::vector<Vec2> around;
    for (int i = 0; i < corners; ++i)
      around.push_back(place + rim_m_ / std::cos(pi / corners) * direction(2.0 * pi * i / corners));
    all.push_back(region_of(around, {}));
  };
  for (const Mark& mark : navigator.map().marks()) {
    if (mark.stands() && mark.sure) add(mark.place);
  }
  const GridFrame& frame = navigator.map().frame();
  for (const Mark& mark : navigator.map().behind()) {
    if (!frame.contains(frame.cell_at(mark.place))) add(mark.place);
  }
  const double radius_m = problem_.body_radius_m() + simpler_m;
  return simpler(shrunk(grown(united(all), radius_m, chord_m), radius_m - simpler_m, chord_m), simpler_m);
}

/// Plans the area without what was seen in it; where it falls apart, the part where the robot is. A passage
/// that is hardly wider than the robot counts as none: the navigator plans on cells.
Outcome<CoverPlan> CoverOrders::plan_here(const Region& things) const {
  const Region ground = without(plan_.ground.area, things);
  Outcome<CoverPlan> plan = fault(FaultCode::no_path, "nowhere in the area is room among what stands there");
  for (const double wider_m : {0.025, 0.04}) {
    const double radius_m = problem_.body_radius_m() + wider_m;
    const Region standing = shrunk(ground, radius_m, chord_m);
    if (standing.empty()) break;
    const Region room = grown({part_around(standing, here_.position)}, radius_m, chord_m);
    const Region here = simpler(common(room, ground), chord_m);
    CoverProblem rest = problem_;
    rest.boundary = here.front().outer;
    rest.holes = here.front().holes;
    rest.start.reset();
    plan = method_.plan(rest, options_, budget_);
    if (plan || plan.error().code == FaultCode::cancelled) break;
  }
  return plan;
}

/// Plans how to cover what is left. Returns false if that is nothing, or no more can be done.
bool CoverOrders::plan_rest(const Navigator& navigator) {
  const auto plan = plan_here(things(navigator));
  if (!plan) {
    reason_ = fmt::format("what is left cannot be planned: {}", plan.error().sentence);
    return false;
  }
  const Region reach = common(plan->ground.reach, plan_.ground.reach);
  const Coverage so_far = cover::coverage_of_drive(believed_, problem_, reach, budget_.stop);
  const double before_m2 = rounds_ == 0 ? std::numeric_limits<double>::infinity() : area_of(left_);
  left_ = without_specks(so_far.missed);
  const double left_m2 = area_of(left_);
  complete_ = left_m2 <= problem_.uncovered * area_of(reach);
  if (complete_) return false;
  if (rounds_ == most_rounds || left_m2 > (1.0 - least_gain) * before_m2) {
    reason_ = fmt::format("{:.3g} m2 are left that no round more covers", left_m2);
    return false;
  }
  ++rounds_;
  take_needed(*plan);
  if (tracks_.empty()) reason_ = fmt::format("no track covers the {:.3g} m2 that are left", left_m2);
  return !tracks_.empty();
}

/// Takes the sections of the track that cover something that is left, each chain of them as a track.
void CoverOrders::take_needed(const CoverPlan& plan) {
  const double radius_m = problem_.body_radius_m();
  Region left = left_;
  TrackPieces chain;
  const auto end_chain = [&] {
    if (!chain.empty()) tracks_.push_back(std::make_shared<const TrackPieces>(std::exchange(chain, {})));
  };
  for (const PathPiece& piece : plan.track.pieces) {
    const Region strip = coverage_of(points_along(piece.from, {piece}, bend_rad), radius_m, left).covered;
    if (shrunk(strip, 0.5 * speck_m, chord_m).empty()) {
      end_chain();
      continue;
    }
    double from = 1.0, to = 0.0;
    for (const RingedPolygon& part : strip) {
      for (const Vec2 corner : part.outer) {
        const double at = nearest_part(piece, corner);
        from = std::min(from, at);
        to = std::max(to, at);
      }
    }
    const double reach = radius_m / std::max(length_of(piece), 1e-9);
    const PathPiece section =
        section_of(piece, std::max(0.0, from - 0.5 * reach), std::min(1.0, to + 0.5 * reach));
    if (!chain.empty() && distance(chain.back().to, section.from) > 1e-6) end_chain();
    chain.push_back(section);
    left = without(left, strip);
  }
  end_chain();
  all_tracks_ = std::max<std::size_t>(tracks_.size(), 1);
}

}  // namespace outrider
