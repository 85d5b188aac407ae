// STL: 3D Systems, StereoLithography Interface Specification, 1988.
#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "mesh/mesh_formats.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

constexpr std::size_t header_bytes = 84;  // 80 bytes of comment, then the count
constexpr std::size_t facet_bytes = 50;   // normal and corners as 12 floats, 2 bytes of attributes

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return value;
}

Outcome<std::vector<Triangle>> from_binary(std::string_view bytes, std::size_t count,
                                           const std::string& name) {
  if (count > most_triangles) return too_many_triangles(name);
  std::vector<Triangle> triangles(count);
  const auto coordinate = [&](std::size_t at) {
    return static_cast<double>(std::bit_cast<float>(little_endian(bytes, at)));
  };
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t at = header_bytes + i * facet_bytes + 12 * (corner + 1);
      triangles[i][corner] = {coordinate(at), coordinate(at + 4), coordinate(at + 8)};
    }
  }
  return triangles;
}

Outcome<std::vector<Triangle>> from_text(std::string_view text, const std::string& name) {
  std::vector<Triangle> triangles;
  std::size_t corners = 0;
  TextLines lines{text, name};
  while (lines.next()) {
    const auto parts = words(lines.line);
    if (parts.empty() || parts[0] != "vertex") continue;
    const auto point = numbers_of(std::span(parts).subspan(1));
    if (!point || point->size() != 3) return bad_input("a vertex takes three numbers", lines.where());
    if (corners % 3 == 0) triangles.emplace_back();
    if (triangles.size() > most_triangles) return too_many_triangles(name);
    triangles.back()[corners++ % 3] = {(*point)[0], (*point)[1], (*point)[2]};
  }
  if (corners % 3 != 0) return bad_input("its last facet lacks a vertex; the file is cut short", name);
  return triangles;
}

}  // namespace

Outcome<std::vector<Triangle>> mesh_from_stl(std::string_view bytes, const std::string& name) {
  if (bytes.size() >= header_bytes) {  // binary files may also start with "solid", so the length decides
    const std::size_t count = little_endian(bytes, 80);
    if (bytes.size() >= header_bytes + count * facet_bytes && (count > 0 || !bytes.starts_with("solid"))) {
      return from_binary(bytes, count, name);
    }
  }
  if (bytes.starts_with("solid")) return from_text(bytes, name);
  return bad_input("it is no STL file, or is cut short", name);
}

}  // namespace outrider
