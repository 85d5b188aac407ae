#include <initializer_list>

#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "text.hpp"

namespace outrider {
namespace {

// JSON for a script element: '<' stands only inside strings there, and as an escape it can neither
// close the element nor open a comment.
std::string script_data(const std::string& json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

struct Part {
  std::string_view marker;
  std::string text;
};

// Each marker stands once in the page, in this order; what is put in is not searched again.
std::string filled(std::string_view page, std::initializer_list<Part> parts) {
  std::string text;
  for (const Part& part : parts) {
    const std::size_t at = page.find(part.marker);
    text += page.substr(0, at);
    text += part.text;
    page.remove_prefix(at + part.marker.size());
  }
  text += page;
  return text;
}

}  // namespace

std::string to_html(const PageReport& report, std::string_view viewer) {
  return filled(viewer, {{"@TITLE@", markup_text(report.job + ": " + report.world_name)},
                         {"@REPORT@", script_data(to_json(report))}});
}

}  // namespace outrider
