// Folders to write to. Fault: bad_input, whose sentence has the folder and the reason.
#pragma once

#include <string>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Refuses a folder that make_folder() would refuse. Changes nothing.
Status check_folder(const std::string& folder);

/// Creates the folder and its parents.
Status make_folder(const std::string& folder);

}  // namespace outrider
