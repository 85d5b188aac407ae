// The pages of the manual for `man`.
#pragma once

#include <string>
#include <string_view>

#include "command.hpp"

namespace outrider::cli {

/// Returns the page of the tool, outrider(1), in the language of man(7).
std::string manual_page(const CommandText& tool, std::string_view version);
/// Returns the page of one of its commands, outrider-NAME(1), with all its flags.
std::string manual_page_of(const CommandText& command, std::string_view version);

}  // namespace outrider::cli
