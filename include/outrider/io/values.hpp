// Numbers, points, poses and boxes as one text: the values of scenario keys and flags.
//
// Numbers stand between commas, blanks around them do not matter. They are finite and at most 1e6 in size.
// `where` is the key or flag that the fault names; each fault says the form and an example. O(length).
#pragma once

#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

/// Exactly `count` numbers; `form` says what the text should be.
Outcome<std::vector<double>> parse_numbers(const std::string& text, std::size_t count,
                                           const std::string& where, const std::string& form);

/// "x,y,heading" in m, m and degrees; the heading is not wrapped.
Outcome<Pose2> parse_pose(const std::string& text, const std::string& where);

/// "low x,low y,high x,high y" in m, where the low corner comes first and the box has an area.
Outcome<Box2> parse_box(const std::string& text, const std::string& where);

}  // namespace outrider
