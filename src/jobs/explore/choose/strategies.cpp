#include "choose/strategies.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double same_m = 0.5;

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

std::vector<double> nearness_values(const Views& views, const ExploreState& state,
                                    const ExploreOptions& options, Workspace& /*workspace*/) {
  std::vector<double> values;
  for (const View& view : views.views) values.push_back(view.reach_s);
  if (const auto before = chosen_before(views, state.before))
    values[*before] -= bonus_of_before(state, options);
  return values;
}

std::vector<double> gain_values(const Views& views, const ExploreState& state, const ExploreOptions& options,
                                Workspace& /*workspace*/) {
  const auto before = chosen_before(views, state.before);
  std::vector<double> values;
  for (std::size_t i = 0; i < views.views.size(); ++i) {
    const View& view = views.views[i];
    const double bonus = before == i ? bonus_of_before(state, options) : 0.0;
    values.push_back(view.gain_m2 / std::max(0.5, view.turn_s + view.reach_s - bonus));
  }
  return values;
}

}  // namespace outrider
