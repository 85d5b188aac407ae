// A run of exploring that looks like a real one: three rooms that come into sight on the way through them.
#pragma once

#include "outrider/report/page_report.hpp"

namespace outrider::test {

PageReport sample_explore();

}  // namespace outrider::test
