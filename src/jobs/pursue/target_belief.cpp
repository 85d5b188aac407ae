#include "outrider/jobs/pursue/target_belief.hpp"

#include <algorithm>
#include <utility>

namespace outrider {

TargetBelief::TargetBelief(PursuitProblem map, std::size_t seconds, TargetForecast forecast)
    : believed(std::move(map)), forecast_(std::move(forecast)), seconds_(seconds) {
  if (!forecast_.predict) forecast_ = target_forecasts().front();
  believed.target.clear();
}

bool TargetBelief::update(const std::vector<Cell>& known, Cell robot) {
  const std::size_t before = std::exchange(known_, known.size());
  const auto first = static_cast<std::ptrdiff_t>(before);
  if (before > 0 && std::equal(known.begin() + first, known.end(), believed.target.begin() + first))
    return false;
  believed.target = known;
  foresee(forecast_, robot);
  return true;
}

void TargetBelief::expect_rest() { foresee(target_forecasts().back(), {}); }

void TargetBelief::foresee(const TargetForecast& forecast, Cell robot) {
  believed.target.resize(known_);
  const auto rest = forecast.predict({believed, believed.target, robot}, seconds_ - known_);
  believed.target.insert(believed.target.end(), rest.begin(), rest.end());
}

}  // namespace outrider
