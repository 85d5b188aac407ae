// The build ID of the program: a hash of its code that the linker has put into it.
#pragma once

#include <string>

namespace outrider {

/// Returns the ID in hexadecimal; empty if the program was linked without one.
std::string build_id();

}  // namespace outrider
