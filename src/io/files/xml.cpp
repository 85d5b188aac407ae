#include "files/xml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

constexpr int deepest_element = 100;

/// Finds an element that is nested deeper than allowed.
struct FindTooDeep : pugi::xml_tree_walker {
  XmlElement found;

  bool for_each(XmlElement& element) override {
    if (depth() + 1 >= deepest_element) found = element;  // the children of the root are at depth 0
    return !found;
  }
};

std::string line_at(const std::vector<std::size_t>& line_ends, const std::string& name,
                    std::ptrdiff_t offset) {
  const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0));
  return fmt::format("{}:{}", name, std::ranges::lower_bound(line_ends, at) - line_ends.begin() + 1);
}

}  // namespace

Outcome<XmlDocument> XmlDocument::parse(std::string_view text, const std::string& name,
                                        std::string_view root) {
  XmlDocument document;
  document.name_ = name;
  for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
    document.line_ends_.push_back(at);
  const auto parsed = document.tree_->load_buffer(
      text.data(), text.size(), pugi::parse_default | pugi::parse_embed_pcdata, pugi::encoding_utf8);
  XmlElement top = document.root();
  if (!parsed) {
    return bad_input(fmt::format("it is not well-formed XML ({}); correct or export it again",
                                 lower(parsed.description())),
                     line_at(document.line_ends_, name, parsed.offset));
  }
  FindTooDeep deep;
  if (!top.traverse(deep))
    return bad_input(
        fmt::format("its elements nest more than {} deep; correct or export it again", deepest_element),
        document.where(deep.found));
  if (!top) return bad_input("it has no elements", name);
  if (!root.empty() && top.name() != root) {
    return bad_input(fmt::format("its root element is <{}>, not <{}>", excerpt(top.name()), root), name);
  }
  return document;
}

std::string XmlDocument::where(XmlElement element) const {
  return line_at(line_ends_, name_, element.offset_debug());
}

std::string_view xml_text(XmlElement element) { return trimmed(element.child_value()); }

}  // namespace outrider
