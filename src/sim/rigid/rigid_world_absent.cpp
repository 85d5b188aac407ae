// Built in place of rigid_world.cpp where the physics engine is not installed.
#include "outrider/sim/rigid/rigid_world.hpp"

namespace outrider {

Outcome<std::unique_ptr<RigidWorld>> make_rigid_world(const RigidScene&) {
  return bad_input(
      "this build has no physics engine; install the group 'physics' of packages.txt and build again, or "
      "take 'kinematic'",
      "sim");
}

}  // namespace outrider
