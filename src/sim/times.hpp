// Times that the simulators have in common.
#pragma once

namespace outrider {

/// Times that are closer are one.
inline constexpr double instant_s = 1e-9;
/// Step in which driven bodies are moved.
inline constexpr double body_step_s = 0.005;
/// The default of a time in the options: it never comes.
inline constexpr double never_s = 1e9;

}  // namespace outrider
