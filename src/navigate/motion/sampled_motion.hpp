// The row `sampled` of local_motions().
#pragma once

#include <memory>

#include "outrider/navigate/local_motion.hpp"

namespace outrider {

std::unique_ptr<LocalMotion> make_sampled_motion(const LocalMotionOptions& options);

}  // namespace outrider
