// SimulatedStores: the tank and the battery of a simulated robot. Their levels follow from the time, the
// distance driven and the shots.
#pragma once

#include <algorithm>
#include <cstddef>

#include "outrider/robot/observation.hpp"
#include "outrider/robot/supplies.hpp"

namespace outrider {

class SimulatedStores {
 public:
  /// The stores begin at `levels`, at most full. The supplies must outlive this object.
  explicit SimulatedStores(const Supplies& supplies, const StoreLevels& levels = {})
      : supplies_(supplies),
        water_(std::min(levels.water, supplies.full(Store::water))),
        charge_j_(std::min(levels.charge_j, supplies.full(Store::charge))) {}

  /// Subtracts the use since the last call. The arguments are totals since the start.
  void note(double time_s, double driven_m, std::size_t shots) {
    const auto fired = static_cast<double>(shots - shots_);
    charge_j_ -= supplies_.charge_of(time_s - time_s_, driven_m - driven_m_) + supplies_.shot_j * fired;
    water_ -= supplies_.shot_water * fired;
    time_s_ = time_s;
    driven_m_ = driven_m;
    shots_ = shots;
  }
  /// Fills a store and returns the time this takes, s. The station powers the robot meanwhile.
  double fill(Store store) {
    double& level = store == Store::water ? water_ : charge_j_;
    const double taken_s = supplies_.filling_s(store, supplies_.full(store) - level);
    level = supplies_.full(store);
    time_s_ += taken_s;
    return taken_s;
  }
  [[nodiscard]] const Station& station(std::size_t index) const { return supplies_.stations[index]; }
  [[nodiscard]] double water() const { return water_; }
  [[nodiscard]] double charge_j() const { return charge_j_; }

 private:
  const Supplies& supplies_;
  double water_;
  double charge_j_;
  double time_s_ = 0.0;
  double driven_m_ = 0.0;
  std::size_t shots_ = 0;
};

}  // namespace outrider
