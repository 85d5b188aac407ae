// Content of a stored index behind a header that fits it: it is refused, or read such that no query leaves
// its memory or never ends. Paths may be wrong, since whoever writes a right checksum can write wrong
// lengths. The first word of the input names the planner.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "fuzz_entry.hpp"
#include "hubs/index_bytes.hpp"
#include "outrider/path/catalog.hpp"

namespace {

using namespace outrider;

std::shared_ptr<const GridMap> ground_of(GridModel model) {
  constexpr int side = 9;
  Grid<std::uint8_t> grid(GridFrame{{}, 1.0, side, side});
  for (const Cell c : {Cell{2, 2}, Cell{2, 3}, Cell{5, 1}, Cell{6, 5}, Cell{3, 6}, Cell{4, 6}, Cell{7, 7}})
    grid[c] = 1;
  return std::make_shared<const GridMap>(GridMap::of(grid, model).value());
}

void ask(const ConfiguredPlanner& planner, const std::shared_ptr<const GridMap>& ground,
         const std::string& bytes) {
  std::vector<std::uint64_t> words((bytes.size() + 7) / 8);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  Workspace workspace;
  if (!planner.load_index({ground}, {std::as_bytes(std::span(words)).first(bytes.size()), nullptr},
                          workspace))
    return;
  for (int k = 0; k < 81; ++k) {
    const Vec2 from = ground->point({k % 9, k / 9}), to = ground->point({k * 7 % 9, k * 5 % 9});
    [[maybe_unused]] const auto plan = planner.plan({ground, from, to}, {}, workspace);
  }
}

}  // namespace

extern "C" int FUZZ_ENTRY(stored_index)(const std::uint8_t* data, std::size_t size) {
  if (size < 8 || size > 100'000) return 0;
  const char* const name = std::array{"hub_labels", "octile_labels", "terrain_labels"}[data[0] % 3];
  const auto ground = ground_of(data[0] % 3 == 0 ? GridModel::corners : GridModel::cells);
  outrider::hub_labelling::IndexWriter writer;
  for (std::size_t i = 8; i < size; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, data + i, std::min<std::size_t>(8, size - i));
    writer.number(word);
  }
  ask(find_path_planner(name)->configure(), ground,
      std::move(writer).finish({name, "hub_memory 64", *ground}));
  return 0;
}
