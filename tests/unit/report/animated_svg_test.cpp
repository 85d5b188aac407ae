#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "keyframes.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/report/pictures.hpp"
#include "sample_report.hpp"

namespace outrider {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, ';');) parts.push_back(part);
  return parts;
}

std::string attribute(const std::string& tag, const std::string& name) {
  const std::string open = " " + name + "=\"";
  const std::size_t start = tag.find(open);
  if (start == std::string::npos) return {};
  const std::size_t from = start + open.size();
  return tag.substr(from, tag.find('"', from) - from);
}

// The tags in order; a failure when they do not nest.
std::vector<std::string> tags(const std::string& svg) {
  std::vector<std::string> all;
  std::vector<std::string> open;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at)) {
    const std::size_t end = svg.find('>', at);
    if (end == std::string::npos) {
      ADD_FAILURE() << "a tag is not closed";
      break;
    }
    const std::string tag = svg.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" />", 1));
    if (tag[0] == '/') {
      EXPECT_TRUE(!open.empty() && "/" + open.back() == tag) << tag;
      if (!open.empty()) open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    all.push_back(tag);
    at = end;
  }
  EXPECT_TRUE(open.empty());
  return all;
}

void expect_sound(const std::string& svg) {
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf\""), std::string::npos);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
  for (const std::string& tag : tags(svg)) {
    if (!tag.starts_with("animate")) continue;
    const auto times = split(attribute(tag, "keyTimes"));
    const auto values = split(attribute(tag, "values"));
    ASSERT_EQ(times.size(), values.size()) << tag;
    ASSERT_GE(times.size(), 2U) << tag;
    double before = 0.0;
    EXPECT_EQ(std::stod(times.front()), 0.0) << tag;
    for (const std::string& text : times) {
      const double time = std::stod(text);
      EXPECT_GE(time, before) << tag;
      EXPECT_LE(time, 1.0) << tag;
      before = time;
    }
    if (attribute(tag, "calcMode") != "discrete") {
      EXPECT_EQ(std::stod(times.back()), 1.0) << tag;
    }
  }
}

PageReport long_wander(std::size_t samples) {
  PageReport report = test::sample_report();
  report.track.clear();
  Rng rng(7);
  TrackSample now{.pose = report.start};
  for (std::size_t i = 0; i < samples; ++i) {
    now.time_s += 0.1;
    now.pose.position = now.pose.position + Vec2{rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3)};
    now.pose.heading_rad = rng.uniform(-3.0, 3.0);
    now.gun_yaw_rad = rng.uniform(-3.0, 3.0);
    report.track.push_back(now);
  }
  return report;
}

TEST(AnimatedSvg, IsSoundAndSmall) {
  const std::string svg = to_animated_svg(test::sample_report(), 24.0);
  expect_sound(svg);
  EXPECT_LT(svg.size(), 100'000U);
  EXPECT_EQ(svg, to_animated_svg(test::sample_report(), 24.0));
}

TEST(AnimatedSvg, ShowsTheStripThatIsCovered) {
  PageReport report;
  report.track = {{0.0, {{1, 1}, 0.0}, 0, 0}, {2.0, {{3, 1}, 0.0}, 0, 0}, {4.0, {{3, 1}, 1.5}, 0, 0}};
  report.cover = ReportCover{.width_m = 0.8,
                             .area = {{{0, 0}, {4, 0}, {4, 2}, {0, 2}}, {{2, 1.6}, {2, 1.8}, {2.2, 1.6}}},
                             .reach = {{{0.1, 0}, {4, 0}, {4, 2}}},
                             .missed = {{{0.1, 0}, {0.2, 0}, {0.2, 0.1}}},
                             .overlap = {},
                             .planned = {{1, 1}, {3, 1}},
                             .passes = {{0.0, 4.0, "lane"}},
                             .covered = {}};
  const std::string svg = to_animated_svg(report, 24.0);
  expect_sound(svg);
  EXPECT_NE(svg.find("missed in the end"), std::string::npos);
  report = {};
  report.cover.emplace();
  expect_sound(to_animated_svg(report, 24.0));
}

TEST(AnimatedSvg, StaysSmallForLongRuns) {
  const std::string svg = to_animated_svg(long_wander(20'000), 30.0);
  expect_sound(svg);
  EXPECT_LT(svg.size(), 400'000U);
}

TEST(AnimatedSvg, MovesTheRobotAlongTheTrack) {
  const PageReport report = test::sample_report();
  const LoopClock clock(report, 24.0);
  std::vector<std::string> times;
  std::vector<std::string> places;
  for (const std::string& tag : tags(to_animated_svg(report, 24.0))) {
    if (tag.starts_with("animateTransform") && attribute(tag, "type") == "translate" &&
        split(attribute(tag, "values")).size() > places.size()) {
      times = split(attribute(tag, "keyTimes"));
      places = split(attribute(tag, "values"));
    }
  }
  ASSERT_GT(places.size(), 12U);
  std::size_t next = 1;
  for (double share = 0.0; share < 1.0; share += 1e-3) {
    while (std::stod(times[next]) < share) ++next;
    const double from = std::stod(times[next - 1]);
    const double part = (share - from) / std::max(1e-9, std::stod(times[next]) - from);
    Vec2 a;
    Vec2 b;
    std::stringstream(places[next - 1]) >> a.x >> a.y;
    std::stringstream(places[next]) >> b.x >> b.y;
    const TrackSample truth = sample_at(report.track, clock.to_run(share * clock.loop_s()));
    EXPECT_LT(distance(a + part * (b - a), truth.pose.position), 0.02) << share;
  }
}

TEST(AnimatedSvg, LetsIntrudersComeAndGo) {
  PageReport report = test::sample_report();
  ReportTarget& target = report.targets[0];
  ASSERT_EQ(target.status, "reached");
  target.visit = ReportVisit{"gate", {1.0, 2.0}, 0.25 * target.done_s, 0.5 * target.done_s};
  const std::string svg = to_animated_svg(report, 24.0);
  expect_sound(svg);
  const std::string from = fmt::format("{:.3f}", 1.0 - target.centre.x);
  const auto walk = [&](const std::string& tag) {
    const auto places = split(attribute(tag, "values"));
    return attribute(tag, "type") == "translate" && places.size() == 4 && places[0] == places[1] &&
           std::stod(places[0]) == std::stod(from) && places[2] == "0 0";
  };
  const auto stay = [](const std::string& tag) { return attribute(tag, "values") == "0;1;0"; };
  const auto all = tags(svg);
  EXPECT_EQ(std::count_if(all.begin(), all.end(), walk), 1);
  EXPECT_GE(std::count_if(all.begin(), all.end(), stay), 1);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (const ReportVisit& odd : {ReportVisit{"", {none, none}, none, none}, ReportVisit{"", {}, 1e12, -1e12},
                                 ReportVisit{"", {}, -1e12, 1e12}}) {
    target.visit = odd;
    expect_sound(to_animated_svg(report, 24.0));
  }
}

TEST(AnimatedSvg, TakesAnyReport) {
  expect_sound(to_animated_svg(PageReport{}, 10.0));
  PageReport report = test::sample_report();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  report.world_name = "</title><script>&\x01\xff";
  report.targets[0].name = "<b>\"'";
  report.targets[1].done_s = none;
  report.targets[2].centre.x = none;
  report.shots[0].contact_point.x = none;
  report.shots[1].flight_s = none;
  report.shots[2].time_s = -1.0;
  report.bounds = {};
  expect_sound(to_animated_svg(report, none));
  report.track.clear();
  expect_sound(to_animated_svg(report, 0.0));
  report.bounds = {{-1e9, -1e9}, {1e9, 1e9}};
  EXPECT_LT(to_animated_svg(report, 1e9).size(), 400'000U);
  report.bounds = {{-1.0, -1.0}, {std::numeric_limits<double>::infinity(), 1.0}};
  expect_sound(to_animated_svg(report, 10.0));
}

TEST(Keyframes, SimplifiedStaysWithinTheTolerance) {
  Rng rng(3);
  for (const double tolerance : {0.0, 0.01, 0.1, 1.0}) {
    std::vector<Key> keys;
    Vec2 at;
    for (int i = 0; i < 500; ++i) {
      keys.push_back({0.1 * i, at});
      if (i % 50 > 20) at = at + Vec2{rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1)};
    }
    const auto few = simplified(keys, tolerance);
    ASSERT_GE(few.size(), 2U);
    EXPECT_LT(few.size(), keys.size());
    std::size_t next = 1;
    for (const Key& key : keys) {
      while (few[next].time < key.time) ++next;
      const Key& a = few[next - 1];
      const Key& b = few[next];
      const double share = (key.time - a.time) / (b.time - a.time);
      EXPECT_LE(distance(a.value + share * (b.value - a.value), key.value), tolerance + 1e-9);
    }
  }
  EXPECT_EQ(simplified({{0, {1, 2}}}, 0.1).size(), 1U);
}

TEST(Keyframes, SampleTurnsTheShorterWay) {
  const std::vector<TrackSample> track = {{0.0, {{0, 0}, 3.0}, -3.0, 0.0}, {2.0, {{1, 2}, -3.0}, 3.0, 1.0}};
  const TrackSample middle = sample_at(track, 1.0);
  EXPECT_NEAR(std::cos(middle.pose.heading_rad), -1.0, 1e-12);
  EXPECT_NEAR(std::cos(middle.gun_yaw_rad), -1.0, 1e-12);
  EXPECT_EQ(middle.pose.position, (Vec2{0.5, 1.0}));
  EXPECT_EQ(middle.gun_pitch_rad, 0.5);
  EXPECT_EQ(sample_at(track, -1.0).pose, track.front().pose);
  EXPECT_EQ(sample_at(track, 9.0).pose, track.back().pose);
}

TEST(Keyframes, LoopClockGoesOnAndBack) {
  const PageReport report = test::sample_report();
  const LoopClock clock(report, 24.0);
  double before = -1.0;
  for (double t = 0.0; t <= clock.end_s(); t += 0.05) {
    const double loop = clock.to_loop(t);
    EXPECT_GT(loop, before);
    EXPECT_NEAR(clock.to_run(loop), t, 1e-9);
    before = loop;
  }
  EXPECT_NEAR(clock.to_loop(clock.end_s()), 24.0 * 0.94, 1e-9);
  for (const ReportShot& shot : report.shots) {
    EXPECT_GE(clock.to_loop(shot.time_s + shot.flight_s) - clock.to_loop(shot.time_s), 0.4 - 1e-9);
  }
}

}  // namespace
}  // namespace outrider
