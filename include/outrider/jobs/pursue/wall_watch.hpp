// WallWatch: the real clock, for pursuits in which planning costs the time that it takes.
#pragma once

#include <utility>

#include "outrider/job/clock.hpp"
#include "outrider/jobs/pursue/mission.hpp"

namespace outrider {

class WallWatch final : public StopWatch {
 public:
  double lap_s() override {
    const double now_s = wall_s();
    return now_s - std::exchange(last_s_, now_s);
  }
  void restart() override { last_s_ = wall_s(); }

 private:
  double last_s_ = wall_s();
};

}  // namespace outrider
