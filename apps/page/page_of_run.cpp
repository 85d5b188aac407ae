#include <initializer_list>
#include <string>

#include "outrider/core/base64.hpp"
#include "outrider/core/text.hpp"
#include "page.hpp"

namespace outrider::page {
namespace {

struct Part {
  std::string_view marker;
  std::string text;
};

/// Each marker stands once in the page, in this order; what is put in is not searched again.
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

std::string page_of_run(std::string_view title, std::string_view mcap, std::string_view empty) {
  return filled(empty, {{"@TITLE@", markup_text(title)}, {"@LOG@", base64_encoded(mcap)}});
}

}  // namespace outrider::page
