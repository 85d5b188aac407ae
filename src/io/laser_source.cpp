#include "outrider/io/laser_source.hpp"

namespace outrider {

Outcome<std::optional<LaserLogStep>> LoadedLaserSource::next() {
  if (next_ >= log_.steps.size()) return std::optional<LaserLogStep>{};
  return std::optional(log_.steps[next_++]);
}

double LoadedLaserSource::progress() const {
  return log_.steps.empty() ? 1.0 : static_cast<double>(next_) / static_cast<double>(log_.steps.size());
}

}  // namespace outrider
