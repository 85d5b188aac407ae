// XML documents, with faults that name the line.
#pragma once

#include <pugixml.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

using XmlElement = pugi::xml_node;

/// A parsed document. Elements are handles into it: they are valid as long as it lives.
class XmlDocument {
 public:
  /// Parses a document. Refuses text that is not well-formed, another root element than `root` (if that is
  /// not empty), and nesting deeper than 100. O(text); no recursion.
  static Outcome<XmlDocument> parse(std::string_view text, const std::string& name, std::string_view root);

  [[nodiscard]] XmlElement root() const { return tree_->document_element(); }
  /// Returns the place of an element of this document, "name:line".
  [[nodiscard]] std::string where(XmlElement element) const;

 private:
  std::string name_;
  std::unique_ptr<pugi::xml_document> tree_ = std::make_unique<pugi::xml_document>();
  std::vector<std::size_t> line_ends_;  // positions in the text
};

/// Returns the text of an element, without white space at its ends; empty if there is none.
std::string_view xml_text(XmlElement element);
inline std::string_view xml_text(XmlElement element, const char* child) {
  return xml_text(element.child(child));
}
inline std::string_view xml_attribute(XmlElement element, const char* attribute) {
  return element.attribute(attribute).value();
}

}  // namespace outrider
