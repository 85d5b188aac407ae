// Collada 1.4 and 1.5: the meshes that the visual scene places (Khronos, COLLADA specification).
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <map>
#include <numbers>

#include "files/xml.hpp"
#include "mesh/mesh_formats.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

using Ids = std::map<std::string_view, XmlElement>;

constexpr int deepest_nodes = 64;
constexpr int most_nodes = 100'000;

using Affine = Eigen::Affine3d;

struct Reader {
  const std::string& name;
  const XmlDocument& document;
  std::string_view part;  ///< the name of the only part to read; empty: all
  Ids ids;
  double metres = 1.0;
  int nodes = 0;
  std::vector<Triangle> triangles;

  [[nodiscard]] tl::unexpected<Fault> wrong(XmlElement element, std::string_view what) const {
    return bad_input(fmt::format("<{}>: {}", excerpt(element.name()), what), document.where(element));
  }
  /// Returns the element with the id of a reference "#id", or null.
  [[nodiscard]] XmlElement find(std::string_view reference) const {
    if (reference.starts_with('#')) reference.remove_prefix(1);
    const auto found = ids.find(reference);
    return found == ids.end() ? XmlElement() : found->second;
  }
};

struct IdCollector : pugi::xml_tree_walker {
  explicit IdCollector(Ids& all) : ids(all) {}
  bool for_each(XmlElement& element) override {
    if (const auto id = xml_attribute(element, "id"); !id.empty()) ids.emplace(id, element);
    return true;
  }
  Ids& ids;
};

template <class Number>
Outcome<std::vector<Number>> numbers(const Reader& reader, XmlElement element) {
  std::vector<Number> values;
  std::string_view rest = xml_text(element);
  for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
    const auto value = number<Number>(word);
    if (!value) return reader.wrong(element, fmt::format("'{}' is not valid here", excerpt(word)));
    values.push_back(*value);
  }
  return values;
}

// ---- Meshes --------------------------------------------------------------------------------------

Outcome<std::vector<Vec3>> positions(const Reader& reader, XmlElement source) {
  const XmlElement array = source.child("float_array");
  if (!array) return reader.wrong(source, "it has no <float_array>");
  auto values = numbers<double>(reader, array);
  if (!values) return pass_on(values);
  const XmlElement accessor = source.child("technique_common").child("accessor");
  const std::size_t stride = accessor.attribute("stride").as_uint(3);
  if (stride < 3) return reader.wrong(source, "its positions have fewer than three coordinates");
  std::vector<Vec3> points;
  for (std::size_t i = 0; i + 3 <= values->size(); i += stride) {
    points.push_back({(*values)[i], (*values)[i + 1], (*values)[i + 2]});
  }
  return points;
}

/// Returns the points of the <vertices> of a mesh, which its primitives share.
Outcome<std::vector<Vec3>> mesh_points(const Reader& reader, XmlElement mesh) {
  const XmlElement vertices = mesh.child("vertices");
  if (!vertices) return reader.wrong(mesh, "it has no <vertices>");
  for (const XmlElement input : vertices.children("input")) {
    if (xml_attribute(input, "semantic") != "POSITION") continue;
    const XmlElement source = reader.find(xml_attribute(input, "source"));
    if (!source) return reader.wrong(input, "its source does not exist");
    return positions(reader, source);
  }
  return reader.wrong(vertices, "it has no input POSITION");
}

struct Layout {
  std::size_t offset = 0;  ///< position of VERTEX among the indices of a corner
  std::size_t stride = 1;  ///< number of indices per corner
};

Outcome<Layout> layout_of(const Reader& reader, XmlElement primitive) {
  Layout layout;
  bool found = false;
  for (const XmlElement input : primitive.children("input")) {
    const std::size_t offset = input.attribute("offset").as_uint(0);
    if (offset > 64) return reader.wrong(input, "its offset is above 64");
    layout.stride = std::max(layout.stride, offset + 1);
    if (xml_attribute(input, "semantic") != "VERTEX") continue;
    layout.offset = offset;
    found = true;
  }
  if (!found) return reader.wrong(primitive, "it has no input VERTEX");
  return layout;
}

/// Adds one face as a fan of triangles; `corners` are indices of points.
void add_fan(Reader& reader, const std::vector<std::size_t>& corners, const std::vector<Vec3>& points,
             const Affine& place) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    Triangle triangle = {points[corners[0]], points[corners[i - 1]], points[corners[i]]};
    for (Vec3& point : triangle) {
      const Eigen::Vector3d placed = place * Eigen::Vector3d(point.x, point.y, point.z);
      point = reader.metres * Vec3{placed.x(), placed.y(), placed.z()};
    }
    reader.triangles.push_back(triangle);
  }
}

/// The numbers of corners of the faces of a <p>.
struct FaceSizes {
  bool one_face = false;            ///< <polygons>: the whole <p> is one face
  std::vector<std::size_t> counts;  ///< for <polylist>; empty: triangles

  [[nodiscard]] std::size_t of(std::size_t face, std::size_t corners) const {
    if (one_face) return corners;
    if (counts.empty()) return 3;
    return face < counts.size() ? counts[face] : 0;
  }
};

Status add_faces(Reader& reader, XmlElement p, const std::vector<Vec3>& points, const Layout& layout,
                 const FaceSizes& sizes, const Affine& place) {
  auto indices = numbers<std::size_t>(reader, p);
  if (!indices) return pass_on(indices);
  std::vector<std::size_t> corners;
  for (std::size_t i = layout.offset; i < indices->size() / layout.stride * layout.stride;
       i += layout.stride) {
    if ((*indices)[i] >= points.size()) {
      return reader.wrong(p, fmt::format("index {} has no position", (*indices)[i]));
    }
    corners.push_back((*indices)[i]);
  }
  auto first = corners.cbegin();
  for (std::size_t face = 0; first != corners.cend(); ++face) {
    const std::size_t count = sizes.of(face, corners.size());
    if (count == 0 || count > static_cast<std::size_t>(corners.cend() - first)) {
      return reader.wrong(p, "its indices do not fill whole faces");
    }
    const auto last = first + static_cast<std::ptrdiff_t>(count);
    add_fan(reader, {first, last}, points, place);
    if (reader.triangles.size() > most_triangles) return too_many_triangles(reader.name);
    first = last;
  }
  return {};
}

Status add_primitive(Reader& reader, XmlElement primitive, const std::vector<Vec3>& points,
                     const Affine& place) {
  auto layout = layout_of(reader, primitive);
  if (!layout) return pass_on(layout);
  FaceSizes sizes{primitive.name() == std::string_view("polygons"), {}};
  if (const XmlElement vcount = primitive.child("vcount")) {
    auto read = numbers<std::size_t>(reader, vcount);
    if (!read) return pass_on(read);
    sizes.counts = std::move(*read);
  }
  for (const XmlElement p : primitive.children("p")) {
    if (auto added = add_faces(reader, p, points, *layout, sizes, place); !added) return added;
  }
  return {};
}

/// Returns true if an element goes by a name; simulators call a part by its node, or by its geometry.
bool goes_by(XmlElement element, std::string_view name) {
  return xml_attribute(element, "name") == name || xml_attribute(element, "id") == name;
}

Status add_geometry(Reader& reader, XmlElement node, XmlElement geometry, const Affine& place) {
  const XmlElement mesh = geometry.child("mesh");
  const bool wanted = reader.part.empty() || goes_by(node, reader.part) || goes_by(geometry, reader.part);
  if (!mesh || !wanted) return {};
  auto points = mesh_points(reader, mesh);
  if (!points) return pass_on(points);
  for (const XmlElement child : mesh.children()) {
    const std::string_view kind = child.name();
    if (kind == "tristrips" || kind == "trifans")
      return reader.wrong(child, "strips and fans are not read; export triangles");
    if (kind != "triangles" && kind != "polylist" && kind != "polygons") continue;
    if (auto added = add_primitive(reader, child, *points, place); !added) return added;
  }
  return {};
}

// ---- Scene ---------------------------------------------------------------------------------------

/// Returns the number of values of a transform; 0 for other elements.
std::size_t value_count(std::string_view kind) {
  if (kind == "matrix") return 16;
  if (kind == "rotate") return 4;
  return kind == "translate" || kind == "scale" ? 3 : 0;
}

/// Returns the transform of one child of a node; the identity if the child is not a transform.
Outcome<Affine> transform_of(const Reader& reader, XmlElement child) {
  const std::string_view kind = child.name();
  const std::size_t count = value_count(kind);
  if (kind == "lookat" || kind == "skew") {
    return reader.wrong(child, "this transform is not read; export a matrix");
  }
  if (count == 0) return Affine::Identity();
  auto v = numbers<double>(reader, child);
  if (!v) return pass_on(v);
  if (v->size() != count) return reader.wrong(child, fmt::format("expected {} numbers", count));
  const auto& m = *v;
  const Eigen::Vector3d first(m[0], m[1], m[2]);
  if (kind == "translate") return Affine(Eigen::Translation3d(first));
  if (kind == "scale") return Affine(Eigen::Scaling(first));
  if (kind == "rotate") {
    if (first.isZero(0.0)) return Affine::Identity();
    return Affine(Eigen::AngleAxisd(m[3] * std::numbers::pi / 180.0, first.normalized()));
  }
  Affine matrix = Affine::Identity();
  matrix.affine() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(m.data());
  return matrix;
}

/// Returns true if no mesh hangs at the node, as at one with a camera. Exporters write anything for its
/// transform.
bool is_bare(XmlElement node) {
  return !node.child("node") && !node.child("instance_node") && !node.child("instance_geometry");
}

Status add_node(Reader& reader, XmlElement node, const Affine& parent, int depth) {
  Affine place = parent;
  if (is_bare(node)) return {};
  if (depth > deepest_nodes || ++reader.nodes > most_nodes) {
    return reader.wrong(node, "its nodes nest too deep, or hold each other in a circle");
  }
  for (const XmlElement child : node.children()) {
    auto transform = transform_of(reader, child);
    if (!transform) return pass_on(transform);
    place = place * *transform;
    const std::string_view kind = child.name();
    const XmlElement referred = reader.find(xml_attribute(child, "url"));
    Status added;
    if (kind == "node") {
      added = add_node(reader, child, place, depth + 1);
    } else if (kind == "instance_node" && referred) {
      added = add_node(reader, referred, place, depth + 1);
    } else if (kind == "instance_geometry" && referred) {
      added = add_geometry(reader, node, referred, place);
    }
    if (!added) return added;
  }
  return {};
}

XmlElement scene_of(const Reader& reader, XmlElement root) {
  return reader.find(xml_attribute(root.child("scene").child("instance_visual_scene"), "url"));
}

}  // namespace

Outcome<std::vector<Triangle>> mesh_from_collada(std::string_view text, const std::string& name,
                                                 std::string_view part) {
  auto document = XmlDocument::parse(text, name, "COLLADA");
  if (!document) return pass_on(document);
  XmlElement root = document->root();
  Reader reader{name, *document, part, {}, 1.0, 0, {}};
  IdCollector collector(reader.ids);
  root.traverse(collector);
  reader.metres = root.child("asset").child("unit").attribute("meter").as_double(1.0);
  if (const XmlElement scene = scene_of(reader, root)) {
    if (auto added = add_node(reader, scene, Affine::Identity(), 0); !added) return pass_on(added);
    return std::move(reader.triangles);
  }
  // no scene: no transforms
  for (const XmlElement geometry : root.child("library_geometries").children("geometry")) {
    if (auto added = add_geometry(reader, geometry, geometry, Affine::Identity()); !added)
      return pass_on(added);
  }
  return std::move(reader.triangles);
}

}  // namespace outrider
