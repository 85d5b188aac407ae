#include "outrider/io/map/cost_map.hpp"

#include <fmt/format.h>

#include "map/image.hpp"
#include "outrider/geometry/vec.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/map/terrain.hpp"

namespace outrider {
namespace {

Outcome<CostMap> from_image(std::string_view bytes, const std::string& path, double of_black) {
  auto image = image_from_bytes(bytes, path);
  if (!image) return pass_on(image);
  CostMap map{path, Grid<float>(GridFrame{{}, 1.0, image->width, image->height})};
  const auto columns = static_cast<std::size_t>(image->width), rows = static_cast<std::size_t>(image->height);
  for (std::size_t i = 0; i < image->values.size(); ++i) {
    const double dark = (255.0 - image->values[i]) / 255.0;
    map.image.cells[(rows - 1 - i / columns) * columns + i % columns] =
        static_cast<float>(1.0 + dark * (of_black - 1.0));
  }
  return map;
}

}  // namespace

Outcome<CostMap> load_cost_map(const std::string& path, double of_black) {
  auto bytes = read_file(path);
  if (!bytes) return pass_on(bytes);
  if (is_image(*bytes)) return from_image(*bytes, path, of_black);
  auto posts = terrain_from_grid(*bytes, path);
  if (!posts) return pass_on(posts);
  return CostMap{path, {}, std::move(*posts)};
}

Outcome<Grid<float>> costs_of(const CostMap& map, const GridFrame& frame, double yaw_rad) {
  Grid<float> costs(frame, 1.0F);
  if (map.posts) {
    for (std::size_t i = 0; i < costs.cells.size(); ++i) {
      const Vec2 p = frame.origin + rotated(yaw_rad, frame.centre(frame.cell(i)) - frame.origin);
      costs.cells[i] = static_cast<float>(map.posts->height(p));
    }
    return costs;
  }
  if (map.image.frame.width != frame.width || map.image.frame.height != frame.height) {
    return bad_input(fmt::format("the image has {} x {} pixels and the map {} x {} cells; give a pixel for "
                                 "each cell, or a grid of costs (.asc)",
                                 map.image.frame.width, map.image.frame.height, frame.width, frame.height),
                     map.name);
  }
  costs.cells = map.image.cells;
  return costs;
}

}  // namespace outrider
