#include "outrider/jobs/explore/choose/blacklist.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {

void Blacklist::add(Vec2 place, double time_s) {
  for (Ban& ban : bans) {
    if (distance(ban.place, place) > radius_m) continue;
    ban.until_s = time_s + ban_s * std::exp2(std::min(ban.failures, 10));
    ++ban.failures;
    return;
  }
  bans.push_back({place, time_s + ban_s, 1});
}

bool Blacklist::lift(int failures, double time_s) {
  bool any = false;
  for (Ban& ban : bans) {
    if (time_s >= ban.until_s || ban.failures >= failures) continue;
    ban.until_s = time_s;
    any = true;
  }
  return any;
}

const Ban* Blacklist::find(Vec2 place, double time_s) const {
  for (const Ban& ban : bans) {
    if (time_s < ban.until_s && distance(ban.place, place) <= radius_m) return &ban;
  }
  return nullptr;
}

}  // namespace outrider
