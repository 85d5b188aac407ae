#include <fmt/format.h>

#include <algorithm>

#include "files/xml.hpp"
#include "map/area_formats.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

/// Returns the name of an element without its namespace.
std::string_view local_name(XmlElement element) {
  const std::string_view name = element.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// Returns the first element of that name in the tree of this element, or none.
XmlElement find(XmlElement element, std::string_view name) {
  const auto is_named = [&](XmlElement one) { return local_name(one) == name; };
  return is_named(element) ? element : element.find_node(is_named);
}

Outcome<AreaRing> ring_of(const XmlDocument& document, XmlElement border) {
  const auto coordinates = find(border, "coordinates");
  if (!coordinates) {
    return bad_input("a border holds a LinearRing with coordinates: x,y x,y ...", document.where(border));
  }
  AreaRing ring{{}, document.where(coordinates)};
  for (const std::string_view word : words(xml_text(coordinates))) {
    auto parts = parts_between(word, ',');
    parts.resize(2);  // a height may follow
    const auto corner = numbers_of(parts);
    if (!corner) {
      return bad_input(fmt::format("'{}' is no corner; write x,y in degrees or metres", excerpt(word)),
                       ring.where);
    }
    ring.corners.push_back({(*corner)[0], (*corner)[1]});
  }
  return ring;
}

}  // namespace

Outcome<AreaRings> rings_from_gml(std::string_view text, const std::string& name) {
  auto document = XmlDocument::parse(text, name, "");
  if (!document) return pass_on(document);
  const auto polygon = find(document->root(), "Polygon");
  if (!polygon) return bad_input("it holds no gml:Polygon; give one", name);
  AreaRings rings;
  for (const XmlElement child : polygon.children()) {
    const bool outer = local_name(child) == "outerBoundaryIs";
    if (!outer && local_name(child) != "innerBoundaryIs") continue;
    auto ring = ring_of(*document, child);
    if (!ring) return pass_on(ring);
    rings.insert(outer ? rings.begin() : rings.end(), std::move(*ring));
  }
  if (rings.empty()) {
    return bad_input("the polygon has no outerBoundaryIs", document->where(polygon));
  }
  return rings;
}

}  // namespace outrider
