// The comment at the head of a scenario, which says what the mission is.
#pragma once

#include <string>
#include <string_view>

namespace outrider::server {

inline constexpr std::size_t longest_head_comment = 400;

/// Returns the comment lines before the first other line as one text, at most `longest_head_comment` bytes
/// long. Leaves out indented lines, which are commands, and the mark of saved files. A paragraph ends it.
std::string head_comment(std::string_view yaml);

}  // namespace outrider::server
