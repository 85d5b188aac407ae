// Parses repaired SDF text with sdformat, with a reduced description of the format.
//
// sdformat copies the description of an element into every element that it reads. That of a <model>, with
// sensors, engines and materials, takes 2.3 MiB. repair_sdf() leaves only a few kinds of elements in the
// text. Without the descriptions of the others, a model takes some ten kilobytes, and the results are the
// same.
#pragma once

#include <sdf/Root.hh>
#include <string>

#include "outrider/core/outcome.hpp"
#include "sdf_repair.hpp"

namespace outrider {

/// Parses the text. Every failure of sdformat becomes a fault, with the line if sdformat states it. Mutes
/// std::cerr meanwhile.
Outcome<sdf::Root> parse_sdf(const RepairedSdf& repaired, const std::string& file);

}  // namespace outrider
