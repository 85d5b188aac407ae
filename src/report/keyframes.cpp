#include "keyframes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double least_flight_s = 0.4;
constexpr double most_flying = 0.45;
constexpr double still_end = 0.06;

double mix(double a, double b, double share) { return a + (b - a) * share; }

double turn(double a, double b, double share) { return a + wrap_angle(b - a) * share; }

double share_of(double low, double high, double value) {
  return high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.0;
}

struct Span {
  double start_s = 0.0;
  double end_s = 0.0;
};

// The flights in order, overlapping ones joined.
std::vector<Span> flights(const PageReport& report) {
  std::vector<Span> spans;
  for (const ReportShot& shot : report.shots) {
    if (shot.time_s >= 0.0 && shot.flight_s > 0.0 && std::isfinite(shot.time_s + shot.flight_s)) {
      spans.push_back({shot.time_s, shot.time_s + shot.flight_s});
    }
  }
  std::ranges::sort(spans, {}, &Span::start_s);
  std::vector<Span> joined;
  for (const Span& span : spans) {
    if (!joined.empty() && span.start_s <= joined.back().end_s) {
      joined.back().end_s = std::max(joined.back().end_s, span.end_s);
    } else {
      joined.push_back(span);
    }
  }
  return joined;
}

double end_of(const PageReport& report, const std::vector<Span>& spans) {
  double end_s = report.track.empty() ? 0.0 : report.track.back().time_s;
  if (!spans.empty()) end_s = std::max(end_s, spans.back().end_s);
  return std::max(end_s, 1e-3);
}

}  // namespace

std::vector<Key> simplified(const std::vector<Key>& keys, double tolerance) {
  if (keys.size() < 3) return keys;
  std::vector<char> kept(keys.size(), 0);
  kept.front() = kept.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, keys.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double worst = tolerance;
    std::size_t split = 0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double share = share_of(keys[first].time, keys[last].time, keys[i].time);
      const double error =
          distance(keys[i].value, keys[first].value + share * (keys[last].value - keys[first].value));
      if (error > worst) {
        worst = error;
        split = i;
      }
    }
    if (split == 0) continue;
    kept[split] = 1;
    open.emplace_back(first, split);
    open.emplace_back(split, last);
  }
  std::vector<Key> few;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (kept[i] != 0) few.push_back(keys[i]);
  }
  return few;
}

TrackSample sample_at(const std::vector<TrackSample>& track, double time_s) {
  const auto after = std::ranges::upper_bound(track, time_s, {}, &TrackSample::time_s);
  if (after == track.begin()) return track.front();
  if (after == track.end()) return track.back();
  const TrackSample& a = *(after - 1);
  const TrackSample& b = *after;
  const double share = share_of(a.time_s, b.time_s, time_s);
  return {.time_s = time_s,
          .pose = {a.pose.position + share * (b.pose.position - a.pose.position),
                   turn(a.pose.heading_rad, b.pose.heading_rad, share)},
          .gun_yaw_rad = turn(a.gun_yaw_rad, b.gun_yaw_rad, share),
          .gun_pitch_rad = mix(a.gun_pitch_rad, b.gun_pitch_rad, share)};
}

LoopClock::LoopClock(const PageReport& report, double loop_s) : loop_s_(loop_s) {
  const std::vector<Span> spans = flights(report);
  const double end_s = end_of(report, spans);
  const double moving_s = loop_s * (1.0 - still_end);
  const double natural = moving_s / end_s;  // loop seconds for a second of the run
  const double least_s =
      spans.empty() ? 0.0
                    : std::min(least_flight_s, most_flying * moving_s / static_cast<double>(spans.size()));
  double flying_run_s = 0.0;
  double flying_loop_s = 0.0;
  for (const Span& span : spans) {
    flying_run_s += span.end_s - span.start_s;
    flying_loop_s += std::max(least_s, natural * (span.end_s - span.start_s));
  }
  const double calm_run_s = end_s - flying_run_s;
  const double calm = calm_run_s > 0.0 ? std::max(0.0, moving_s - flying_loop_s) / calm_run_s : 0.0;

  knots_.push_back({0.0, 0.0});
  const auto advance = [&](double run_s, double loop_duration_s) {
    knots_.push_back({run_s, knots_.back().loop_s + loop_duration_s});
  };
  for (const Span& span : spans) {
    advance(span.start_s, calm * (span.start_s - knots_.back().run_s));
    advance(span.end_s, std::max(least_s, natural * (span.end_s - span.start_s)));
  }
  advance(end_s, calm * (end_s - knots_.back().run_s));
  const double scale = moving_s / knots_.back().loop_s;  // 1 but for rounding and runs that only fly
  for (Knot& knot : knots_) knot.loop_s *= scale;
}

double LoopClock::to_loop(double run_s) const {
  const auto after = std::ranges::upper_bound(knots_, run_s, {}, &Knot::run_s);
  if (after == knots_.begin()) return 0.0;
  if (after == knots_.end()) return knots_.back().loop_s;
  const Knot& a = *(after - 1);
  return mix(a.loop_s, after->loop_s, share_of(a.run_s, after->run_s, run_s));
}

double LoopClock::to_run(double loop_s) const {
  const auto after = std::ranges::upper_bound(knots_, loop_s, {}, &Knot::loop_s);
  if (after == knots_.begin()) return 0.0;
  if (after == knots_.end()) return knots_.back().run_s;
  const Knot& a = *(after - 1);
  return mix(a.run_s, after->run_s, share_of(a.loop_s, after->loop_s, loop_s));
}

std::vector<double> LoopClock::changes() const {
  std::vector<double> times;
  times.reserve(knots_.size());
  for (const Knot& knot : knots_) times.push_back(knot.run_s);
  return times;
}

}  // namespace outrider
