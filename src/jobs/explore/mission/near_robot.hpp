// How near is near, for a robot that explores.
#pragma once

namespace outrider {

inline constexpr double arrived_m = 0.03;  ///< of the end of a path
inline constexpr double nearby_m = 0.9;    ///< within which obstacles are kept in sight

}  // namespace outrider
