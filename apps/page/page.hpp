// The web page, as it was built with the tool: its files for `outrider serve`, and the viewer of one report
// for `outrider replay --html`. cmake/Page.cmake makes them of web/; where npm could not, both are empty.
#pragma once

#include <span>
#include <string_view>

namespace outrider::page {

/// One file of the page as a browser asks for it.
struct File {
  std::string_view path;  ///< below the root, without a leading slash: index.html, assets/app-Cx1.js
  std::string_view type;  ///< its Content-Type
  std::string_view gzip;  ///< its bytes, gzip-compressed
};

/// In the order of their paths. Names under assets/ hold a hash of their content.
std::span<const File> files();

/// A page that needs nothing beside itself. It holds each of @TITLE@ (HTML text) and @REPORT@ (JSON in a
/// script element) once, in this order.
std::string_view viewer();

/// What is missing where both are empty.
constexpr std::string_view missing =
    "this tool was built without the page; build it again where npm is installed and reaches its registry";

}  // namespace outrider::page
