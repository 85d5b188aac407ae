// Parses numbers, poses and boxes in the values of scenario keys and flags.
//
// Numbers are separated by commas, with optional blanks around them. They must be finite and within 1e6.
// `where` is the key or flag that the fault names; each fault states the form and an example. O(length).
#pragma once

#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

/// Parses exactly `count` numbers. `form` describes the expected text in the fault.
Outcome<std::vector<double>> parse_numbers(const std::string& text, std::size_t count,
                                           const std::string& where, const std::string& form);

/// Parses "x,y,heading" in m, m and degrees. The heading is not wrapped.
Outcome<Pose2> parse_pose(const std::string& text, const std::string& where);

/// Parses "x,y" in m.
Outcome<Vec2> parse_place(const std::string& text, const std::string& where);

/// Parses "low x,low y,high x,high y" in m. Refuses a box without area.
Outcome<Box2> parse_box(const std::string& text, const std::string& where);

}  // namespace outrider
