// XML documents, with faults that name the line.
#pragma once

#include <tinyxml2.h>

#include <memory>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

using XmlDocument = std::unique_ptr<tinyxml2::XMLDocument>;

/// Parses a document. Refuses text that is not well-formed, another root element than `root` (if that is not
/// empty), and nesting deeper than 100.
Outcome<XmlDocument> xml_document(std::string_view text, const std::string& name, std::string_view root);

/// Returns the text of an element, or of its child with that name; empty if there is none.
std::string_view xml_text(const tinyxml2::XMLElement& element);
std::string_view xml_text(const tinyxml2::XMLElement& element, const char* child);
std::string_view xml_attribute(const tinyxml2::XMLElement& element, const char* attribute);

/// Returns the document as text whose elements start on the same lines as in the file, so that faults of
/// later readers name the right line. Comments are removed.
std::string xml_on_same_lines(const tinyxml2::XMLDocument& document);

}  // namespace outrider
