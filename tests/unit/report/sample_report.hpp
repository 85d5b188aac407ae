// A run that looks like a real one: a yard with walls, a table, boxes and cylinders, ten targets of
// every status, a drive between the shots, flights that are true parabolas and end on true boxes.
#pragma once

#include "outrider/report/page_report.hpp"

namespace outrider::test {

PageReport sample_report();

}  // namespace outrider::test
