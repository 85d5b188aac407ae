// A run of exploring that looks like a real one: three rooms that come into sight on the way through them.
#pragma once

#include "outrider/report/report.hpp"

namespace outrider::test {

Report sample_explore();

}  // namespace outrider::test
