#include "outrider/io/scenario/things.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/io/files/text.hpp"
#include "outrider/io/scenario/values.hpp"

namespace outrider {

Status add_things(const std::string& text, double robot_height_m, World& world) {
  constexpr const char* key = "things";
  for (const std::string_view word : words(text)) {
    const bool round = std::ranges::count(word, ',') == 2;
    auto n = parse_numbers(std::string(word), round ? 3 : 4, key,
                           "x,y,length,width of a box or x,y,radius of a post, in m, such as 3,2,0.5,0.4");
    if (!n) return pass_on(n);
    for (std::size_t i = 2; i < n->size(); ++i) {
      if ((*n)[i] < 0.01 || (*n)[i] > 100.0)
        return bad_input(fmt::format("'{}' is not valid; sizes are from 0.01 to 100 m", excerpt(word)), key);
    }
    const double half_m = 0.5 * std::max(1.0, robot_height_m);
    const Pose3 pose{{(*n)[0], (*n)[1], world.floor_z_m + half_m}, {}};
    const std::string name = fmt::format("thing {}", world.solids.size());
    if (round) {
      world.solids.push_back({name, pose, CylinderShape{(*n)[2], half_m}});
    } else {
      world.solids.push_back({name, pose, BoxShape{{0.5 * (*n)[2], 0.5 * (*n)[3], half_m}}});
    }
  }
  return {};
}

}  // namespace outrider
