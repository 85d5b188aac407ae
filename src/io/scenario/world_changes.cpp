#include "outrider/io/scenario/world_changes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/scenario/values.hpp"

namespace outrider {
namespace {

constexpr double rounding_deg = 1e-9;  // tolerance for whole degrees

}  // namespace

Outcome<WorldChanges> changes_from_text(std::string_view moved, std::string_view removed) {
  WorldChanges changes;
  for (const std::string_view part : filled_parts_between(moved, ';')) {
    const std::size_t equals = part.rfind('=');
    const std::string_view name = trimmed(part.substr(0, std::min(equals, part.size())));
    if (equals == std::string_view::npos || name.empty()) {
      return bad_input(
          fmt::format(
              "'{}' is not valid; write name=x,y,turn, such as bench=1.5,-2,90; several with ; between",
              excerpt(part)),
          "moved");
    }
    auto n = parse_numbers(std::string(part.substr(equals + 1)), 3, "moved",
                           fmt::format("x,y,turn in m, m and degrees, such as {}=1.5,-2,90", excerpt(name)));
    if (!n) return pass_on(n);
    changes.moved.push_back({std::string(name), {{(*n)[0], (*n)[1]}, wrap_angle(radians((*n)[2]))}});
  }
  for (const std::string_view part : filled_parts_between(removed, ';')) changes.removed.emplace_back(part);
  return changes;
}

std::string degrees_text(double angle_rad) {
  const double whole = std::round(degrees(angle_rad));
  return fmt::format("{}", std::abs(degrees(angle_rad) - whole) < rounding_deg ? whole : degrees(angle_rad));
}

std::string moved_text(const std::vector<MovedThing>& moved) {
  std::vector<std::string> texts;
  for (const auto& [name, place] : moved) {
    texts.push_back(fmt::format("{}={},{},{}", name, place.position.x, place.position.y,
                                degrees_text(place.heading_rad)));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string removed_text(const std::vector<std::string>& removed) {
  return fmt::format("{}", fmt::join(removed, "; "));
}

}  // namespace outrider
