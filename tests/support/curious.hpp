// Looks on after every step of a run and puts together what it sees anew: it must make the report.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/report/growth.hpp"

namespace outrider::testing {

class Curious final : public RunObserver {
 public:
  bool wants() override { return true; }

  void see(const Report& so_far) override {
    const Report news = growth_.delta(so_far);
    EXPECT_EQ(news.status, "running");
    EXPECT_TRUE(!news.job.empty() || news.solids.empty()) << "what stands still is told once";
    if (!news.job.empty()) world_name_ = news.world_name;
    append(told_.track, news.track);
    append(told_.shots, news.shots);
    append(told_.events, news.events);
    if (!news.targets.empty()) told_.targets = news.targets;
    if (news.explore) append(beliefs_, news.explore->beliefs);
    if (news.explore && news.explore->map.columns > 0) map_ = news.explore->map;
    if (news.drive) append(beliefs_, news.drive->beliefs);
  }

  void expect_to_have_seen(const Report& report) const {
    EXPECT_EQ(world_name_, report.world_name);
    ASSERT_EQ(told_.track.size(), report.track.size());
    for (std::size_t i = 0; i < report.track.size(); ++i) {
      EXPECT_EQ(told_.track[i].time_s, report.track[i].time_s);
      EXPECT_EQ(told_.track[i].pose, report.track[i].pose);
    }
    ASSERT_EQ(told_.shots.size(), report.shots.size());
    for (std::size_t i = 0; i < report.shots.size(); ++i) {
      EXPECT_EQ(told_.shots[i].time_s, report.shots[i].time_s);
      EXPECT_EQ(told_.shots[i].target, report.shots[i].target);
    }
    EXPECT_LE(told_.targets.size(), report.targets.size());
    for (const ReportTarget& target : told_.targets) {
      const auto has = [&](const ReportTarget& one) {
        return one.name == target.name && one.status == target.status && one.shots == target.shots;
      };
      EXPECT_TRUE(std::ranges::any_of(report.targets, has)) << target.name << " is " << target.status;
    }
    EXPECT_EQ(beliefs_.size(), (report.explore ? report.explore->beliefs.size() : 0) +
                                   (report.drive ? report.drive->beliefs.size() : 0));
    EXPECT_TRUE(!report.explore || map_.state_runs == report.explore->map.state_runs);
  }

  /// In the order in which they were told.
  [[nodiscard]] const std::vector<ReportEvent>& events() const { return told_.events; }

 private:
  template <class T>
  static void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
  }

  ReportGrowth growth_;
  std::string world_name_;
  Report told_;
  std::vector<ReportBelief> beliefs_;
  ReportMap map_;
};

}  // namespace outrider::testing
