// XML documents, with faults that name the line.
#pragma once

#include <tinyxml2.h>

#include <memory>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

using XmlDocument = std::unique_ptr<tinyxml2::XMLDocument>;

/// Refuses what is not well-formed, has another root element (any will do for an empty name), or nests
/// deeper than 100.
Outcome<XmlDocument> xml_document(std::string_view text, const std::string& name, std::string_view root);

/// The text of an element, or of its child of that name; empty when there is none.
std::string_view xml_text(const tinyxml2::XMLElement& element);
std::string_view xml_text(const tinyxml2::XMLElement& element, const char* child);
std::string_view xml_attribute(const tinyxml2::XMLElement& element, const char* attribute);

/// The document as text whose elements start on the lines where they stood in the file, so that
/// whoever reads it names the right line. Comments are left out.
std::string xml_on_same_lines(const tinyxml2::XMLDocument& document);

}  // namespace outrider
