// The options that planners of wide paths have in common.
#pragma once

#include <fmt/format.h>

#include "outrider/core/options.hpp"

namespace outrider {

inline constexpr double most_weight_m = 1e6;

inline Option weight_option(double& weight_m) {
  return {"weight", "m", 0.0, most_weight_m, "clearance at which a metre of path counts twice", &weight_m};
}
inline Option kept_option(double& kept) {
  return {"kept", "", 0.0, 1.0, "share of the largest possible least clearance that the path keeps", &kept};
}

inline Status check_weight(double weight_m) {
  if (weight_m >= 0.0 && weight_m <= most_weight_m) return {};
  return bad_input(fmt::format("{} m is not valid; expected 0 to {:g}", weight_m, most_weight_m), "weight");
}
/// Checks a share under the name of its option.
inline Status check_share(double share, std::string_view name) {
  if (share >= 0.0 && share <= 1.0) return {};
  return bad_input(fmt::format("{} is not valid; expected 0 to 1", share), std::string(name));
}

}  // namespace outrider
