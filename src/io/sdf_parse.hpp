// sdformat's reading of repaired SDF text, with a description of the format that is cut down to what the
// text can hold.
//
// sdformat copies the description of an element into every element that it reads: all that a <model> may
// hold, with sensors, engines and materials, is 2.3 MiB. Of that repair_sdf() leaves a few elements. Without
// the others a model costs some ten kilobytes, and the answers are the same.
#pragma once

#include <sdf/Root.hh>
#include <string>

#include "outrider/core/outcome.hpp"
#include "sdf_repair.hpp"

namespace outrider {

/// Every failure of sdformat is a fault with the line, where it says one. Mutes std::cerr meanwhile.
Outcome<sdf::Root> parse_sdf(const RepairedSdf& repaired, const std::string& file);

}  // namespace outrider
