#include <initializer_list>

#include "outrider/core/base64.hpp"
#include "outrider/report/pictures.hpp"
#include "text.hpp"

namespace outrider {
namespace {

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

std::string to_html(const std::string& title, std::string_view mcap, std::string_view viewer) {
  return filled(viewer, {{"@TITLE@", markup_text(title)}, {"@LOG@", base64_encoded(mcap)}});
}

}  // namespace outrider
