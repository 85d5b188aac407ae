// The row `steer` of local_motions().
#pragma once

#include <memory>

#include "outrider/navigate/local_motion.hpp"

namespace outrider {

std::unique_ptr<LocalMotion> make_steer(const LocalMotionOptions& options);

}  // namespace outrider
