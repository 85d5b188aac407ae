// `outrider research ...`: the tool with the reference methods of research/, where `make research` built it.
#pragma once

#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider::cli {

/// Becomes the program outrider-research beside this one, with these words, and so does not return. Fault:
/// bad_input where it is not built.
Fault become_research(const std::vector<std::string>& words);

}  // namespace outrider::cli
