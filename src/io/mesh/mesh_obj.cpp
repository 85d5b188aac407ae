// Wavefront OBJ: lines "v x y z" and "f a b c ...", an index being v, v/vt, v//vn or v/vt/vn.
#include <fmt/format.h>

#include <optional>

#include "mesh/mesh_formats.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

/// Converts an index of the file, which counts from 1, or back from the last vertex if it is negative.
std::optional<std::size_t> vertex_index(std::string_view word, std::size_t count) {
  const auto index = number<std::int64_t>(word.substr(0, word.find('/')));
  const auto size = static_cast<std::int64_t>(count);
  if (!index || *index == 0 || *index > size || *index < -size) return std::nullopt;
  return static_cast<std::size_t>(*index > 0 ? *index - 1 : size + *index);
}

Status add_face(const std::vector<std::string_view>& parts, const std::vector<Vec3>& vertices,
                std::vector<Triangle>& triangles, const std::string& where) {
  std::vector<Vec3> corners;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto index = vertex_index(parts[i], vertices.size());
    if (!index) return bad_input(fmt::format("'{}' names no vertex above it", excerpt(parts[i])), where);
    corners.push_back(vertices[*index]);
  }
  if (corners.size() < 3) return bad_input("a face takes at least three vertices", where);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
  return {};
}

}  // namespace

Outcome<std::vector<Triangle>> mesh_from_obj(std::string_view text, const std::string& name,
                                             std::string_view part) {
  bool wanted = part.empty();
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
  TextLines lines{text, name};
  while (lines.next_filled()) {
    const auto parts = words(lines.line);
    if (!part.empty() && parts.size() > 1 && (parts[0] == "o" || parts[0] == "g")) wanted = parts[1] == part;
    if (parts[0] == "v") {  // a weight may follow
      const auto point = numbers_of(std::span(parts).subspan(1, std::min<std::size_t>(parts.size() - 1, 3)));
      if (!point || point->size() != 3) return bad_input("a vertex takes three numbers", lines.where());
      vertices.push_back({(*point)[0], (*point)[1], (*point)[2]});
    } else if (parts[0] == "f" && wanted) {
      if (auto added = add_face(parts, vertices, triangles, lines.where()); !added) return pass_on(added);
    }
    if (triangles.size() > most_triangles) return too_many_triangles(name);
  }
  return triangles;
}

}  // namespace outrider
