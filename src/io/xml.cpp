#include "xml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/core/text.hpp"
#include "outrider/io/text.hpp"

namespace outrider {
namespace {

class SameLinePrinter : public tinyxml2::XMLPrinter {
 public:
  SameLinePrinter() : XMLPrinter(nullptr, true) {}  // compact: it adds no line ends

  bool VisitEnter(const tinyxml2::XMLElement& element, const tinyxml2::XMLAttribute* attributes) override {
    while (line_ < element.GetLineNum()) {
      SealElementIfJustOpened();
      Write("\n");
      ++line_;
    }
    return XMLPrinter::VisitEnter(element, attributes);
  }
  bool Visit(const tinyxml2::XMLText& text) override {
    line_ += static_cast<int>(std::ranges::count(std::string_view(text.Value()), '\n'));
    return XMLPrinter::Visit(text);
  }
  bool Visit(const tinyxml2::XMLComment&) override { return true; }
  bool Visit(const tinyxml2::XMLDeclaration&) override { return true; }
  bool Visit(const tinyxml2::XMLUnknown&) override { return true; }

 private:
  int line_ = 1;
};

std::string_view view(const char* text) { return text == nullptr ? std::string_view() : text; }

}  // namespace

Outcome<XmlDocument> xml_document(std::string_view text, const std::string& name, std::string_view root) {
  auto document = std::make_unique<tinyxml2::XMLDocument>();
  if (document->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    std::string_view kind = document->ErrorName();
    if (kind.starts_with("XML_")) kind.remove_prefix(4);
    return bad_input(fmt::format("it is not well-formed XML ({}); correct or export it again", kind),
                     fmt::format("{}:{}", name, std::max(document->ErrorLineNum(), 1)));
  }
  const tinyxml2::XMLElement* top = document->RootElement();
  if (top == nullptr || (!root.empty() && top->Name() != root)) {
    return bad_input(
        fmt::format("its root element is <{}>, not <{}>", top == nullptr ? "" : excerpt(top->Name()), root),
        name);
  }
  return document;
}

std::string_view xml_text(const tinyxml2::XMLElement& element) { return trimmed(view(element.GetText())); }

std::string_view xml_text(const tinyxml2::XMLElement& element, const char* child) {
  const tinyxml2::XMLElement* found = element.FirstChildElement(child);
  return found == nullptr ? std::string_view() : xml_text(*found);
}

std::string_view xml_attribute(const tinyxml2::XMLElement& element, const char* attribute) {
  return view(element.Attribute(attribute));
}

std::string xml_on_same_lines(const tinyxml2::XMLDocument& document) {
  SameLinePrinter printer;
  document.Accept(&printer);
  return printer.CStr();
}

}  // namespace outrider
