#include "strategies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace outrider {
namespace {

constexpr double same_m = 0.5;

/// The least by `value`, where the choice before counts less by the bonus.
template <class Value>
std::size_t least(const Views& views, const ExploreState& state, double bonus, Value value) {
  const auto before = chosen_before(views, state.before);
  std::size_t best = 0;
  double least_value = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < views.views.size(); ++i) {
    const double v = value(views.views[i]) - (before == i ? bonus : 0.0);
    if (v < least_value) {
      least_value = v;
      best = i;
    }
  }
  return best;
}

}  // namespace

std::optional<std::size_t> chosen_before(const Views& views, const ExploreChoice& before) {
  if (before.frontier == 0) return std::nullopt;
  std::optional<std::size_t> nearest;
  double least_m = same_m;
  for (std::size_t i = 0; i < views.views.size(); ++i) {
    if (views.views[i].frontier == before.frontier) return i;
    const double away = distance(views.views[i].pose.position, before.place);
    if (away < least_m) {
      least_m = away;
      nearest = i;
    }
  }
  return nearest;
}

double bonus_of_before(const ExploreState& state, const ExploreOptions& options) {
  constexpr int most_doublings = 10;
  return std::ldexp(options.momentum_s, std::min(state.before.switches, most_doublings));
}

std::size_t choose_nearest(const Views& views, const ExploreState& state, const ExploreOptions& options,
                           Workspace& /*workspace*/) {
  return least(views, state, bonus_of_before(state, options), [](const View& view) { return view.reach_s; });
}

std::size_t choose_by_gain(const Views& views, const ExploreState& state, const ExploreOptions& options,
                           Workspace& /*workspace*/) {
  const auto before = chosen_before(views, state.before);
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < views.views.size(); ++i) {
    const View& view = views.views[i];
    const double bonus = before == i ? bonus_of_before(state, options) : 0.0;
    const double rate = view.gain_m2 / std::max(0.5, view.turn_s + view.reach_s - bonus);
    if (rate > most) {
      most = rate;
      best = i;
    }
  }
  return best;
}

}  // namespace outrider
