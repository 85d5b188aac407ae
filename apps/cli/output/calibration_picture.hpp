// Picture of a calibration: each law with its runs.
#pragma once

#include <string>

#include "outrider/control/calibrate.hpp"

namespace outrider::cli {

/// Returns an SVG. For each law it shows the runs as dots, the line, its 95 % band, and a and b with their
/// intervals. Below, it shows the gain of each wheel with its interval.
std::string calibration_picture(const CalibrationFit& fit, const Chassis& chassis);

}  // namespace outrider::cli
