#include "outrider/jobs/guard/mission/gun_silence.hpp"

#include <fmt/format.h>

namespace outrider {
namespace {

constexpr int enough_shots = 6;
constexpr std::size_t enough_targets = 2;
constexpr double enough_s = 30.0;

}  // namespace

void GunSilence::note(std::size_t target, bool has_result, double time_s) {
  if (has_result) {
    *this = {};
    return;
  }
  if (shots++ == 0) since_s = time_s;
  targets.insert(target);
}

std::string GunSilence::verdict(double time_s) const {
  if (shots < enough_shots || targets.size() < enough_targets || time_s - since_s < enough_s) return {};
  return fmt::format("the gun gives no result: nothing came of {} shots in a row at {} targets", shots,
                     targets.size());
}

}  // namespace outrider
