// The web page that was built into the tool: its files for `outrider serve`, and the viewer of one run for
// `outrider replay --html`. cmake/Page.cmake makes them from web/. If npm could not build them, both are
// empty.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace outrider::page {

/// Holds one file of the page as a browser requests it.
struct File {
  std::string_view path;  ///< below the root, without a leading slash: index.html, assets/app-Cx1.js
  std::string_view type;  ///< its Content-Type
  std::string_view gzip;  ///< its bytes, gzip-compressed
};

/// Returns the files, sorted by path. Names under assets/ contain a hash of the content.
std::span<const File> files();

/// Returns a self-contained page without a run. It holds each of @TITLE@ (HTML text) and @LOG@ (base64 in a
/// script element) once, in this order.
std::string_view viewer();

/// Returns an HTML page that plays a run. `mcap` is the log of the run as an MCAP file, `title` the title of
/// the page, which is escaped; `empty` has the markers of viewer(). O(length of all).
std::string page_of_run(std::string_view title, std::string_view mcap, std::string_view empty = viewer());

/// Explains what is missing if both are empty.
constexpr std::string_view missing =
    "this tool was built without the page; build it again where npm is installed and reaches its registry";

}  // namespace outrider::page
