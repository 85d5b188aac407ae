// Canary: whether two processes compute the same with the functions of the C library.
//
// sin(), pow() and others differ in the last bit between versions of the C library, and between processors
// on one version: glibc takes other code where the processor has fused multiply-add. Runs on such machines
// end differently, so the hashes of a table of their values are compared before.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace outrider {

/// Returns for each function its name and a hash of its values at 20,000 places, bit for bit. Takes some
/// milliseconds.
std::vector<std::pair<std::string, std::string>> mathematics_canary();

}  // namespace outrider
