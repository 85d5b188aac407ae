// The page of a run: one HTML file that plays it.
#pragma once

#include <string>
#include <string_view>

namespace outrider {

/// Returns an HTML page that plays a run. `mcap` is the log of the run as an MCAP file, `title` the title of
/// the page, which is escaped. `viewer` is the page without a run (the tool contains one, built from web/):
/// HTML with the markers
/// @TITLE@ (text) and @LOG@ (base64, inside a script element), each once and in this order. O(length of all).
std::string to_html(const std::string& title, std::string_view mcap, std::string_view viewer);

}  // namespace outrider
