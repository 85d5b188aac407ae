#include "outrider/ballistics/target.hpp"

namespace outrider {

Solid solid_of(const Target& target) {
  return {target.name,
          {target.centre(), Rotation::from_rpy(0.0, 0.0, target.yaw_rad)},
          BoxShape{0.5 * target.size}};
}

}  // namespace outrider
