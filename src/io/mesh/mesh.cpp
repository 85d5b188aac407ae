#include "outrider/io/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/mesh_formats.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

constexpr std::size_t largest_mesh_bytes = std::size_t{64} << 20;
constexpr double farthest = 1e6;

bool is_corner_near(Vec3 p) {  // false for NaN too
  return std::abs(p.x) <= farthest && std::abs(p.y) <= farthest && std::abs(p.z) <= farthest;
}

/// Returns true for a triangle of which nothing can matter, as broken transforms of exporters leave them.
bool is_far_away(const Triangle& t) {
  return std::ranges::all_of(t, [](Vec3 p) { return std::isfinite(norm(p)) && !is_corner_near(p); });
}

bool has_area(const Triangle& t) { return squared_norm(cross(t[1] - t[0], t[2] - t[0])) > 0.0; }

Outcome<std::vector<Triangle>> read_format(std::string_view bytes, const std::string& name,
                                           std::string_view part) {
  const std::string lower_case = lower(name);
  const std::string_view plain = without_gz(lower_case);
  if (plain.ends_with(".stl")) return mesh_from_stl(bytes, name);
  if (plain.ends_with(".obj")) return mesh_from_obj(bytes, name, part);
  if (plain.ends_with(".dae")) return mesh_from_collada(bytes, name, part);
  return bad_input("its format is not read; convert it to .stl, .obj or .dae", name);
}

}  // namespace

tl::unexpected<Fault> too_many_triangles(const std::string& name) {
  return bad_input(
      fmt::format("it has more than {} triangles; use a simpler mesh for collisions", most_triangles), name);
}

Outcome<std::vector<Triangle>> mesh_from_bytes(std::string_view bytes, const std::string& name,
                                               std::string_view part) {
  auto triangles = read_format(bytes, name, part);
  if (!triangles) return triangles;
  std::erase_if(*triangles, is_far_away);
  for (const Triangle& triangle : *triangles) {
    if (std::ranges::all_of(triangle, is_corner_near)) continue;
    return bad_input("a triangle reaches beyond 1e6, or a corner is no number; scale the mesh", name);
  }
  std::erase_if(*triangles, [](const Triangle& triangle) { return !has_area(triangle); });
  if (triangles->empty()) return bad_input("it has no triangles", name);
  return triangles;
}

Outcome<std::vector<Triangle>> load_mesh(const std::string& path, std::string_view part) {
  auto bytes = read_file(path, largest_mesh_bytes);
  if (!bytes) return pass_on(bytes);
  return mesh_from_bytes(*bytes, path, part);
}

}  // namespace outrider
