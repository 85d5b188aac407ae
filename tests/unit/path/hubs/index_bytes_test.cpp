// Stored indices of hub_labels, octile_labels and terrain_labels: read back, and refused where they do not
// belong.
#include "hubs/index_bytes.hpp"

#include <gtest/gtest.h>

#include "outrider/path/catalog.hpp"
#include "outrider/path/check.hpp"
#include "support/random_cases.hpp"
#include "support/random_costs.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

/// A row with an index that can be kept, by name.
class Stored : public ::testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] ConfiguredPlanner planner(std::int64_t hub_memory_mib = 64) const {
    ConfiguredPlanner configured = find_path_planner(GetParam())->configure();
    EXPECT_TRUE(assign(configured.options.front(), std::to_string(hub_memory_mib)));
    return configured;
  }
  /// With costs for a row that weighs them.
  [[nodiscard]] IndexedGround ground_of(const Grid<std::uint8_t>& grid, std::uint64_t seed = 1) const {
    const GridModel model = GetParam() == "hub_labels" ? GridModel::corners : GridModel::cells;
    IndexedGround ground{std::make_shared<const GridMap>(GridMap::of(grid, model).value())};
    if (find_path_planner(GetParam())->weighs) {
      Rng rng = Rng(seed).child("costs");
      ground.costs =
          std::make_shared<const CellCosts>(CellCosts::of(testing::random_costs(rng, grid.frame)).value());
    }
    return ground;
  }
  /// Words aligned as those of a mapped file.
  static StoredIndex stored(std::string_view bytes) {
    const auto words = std::make_shared<std::vector<std::uint64_t>>((bytes.size() + 7) / 8);
    if (!bytes.empty()) std::memcpy(words->data(), bytes.data(), bytes.size());
    return {std::as_bytes(std::span(*words)).first(bytes.size()), words};
  }
  std::string saved(const IndexedGround& ground, std::int64_t hub_memory_mib = 64) const {
    Workspace workspace;
    return planner(hub_memory_mib).save_index(ground, {}, workspace).value();
  }
  [[nodiscard]] std::string refusal(const IndexedGround& ground, std::string_view bytes) const {
    Workspace workspace;
    const auto loaded = planner().load_index(ground, stored(bytes), workspace);
    return loaded ? "" : loaded.error().sentence;
  }
};
INSTANTIATE_TEST_SUITE_P(Rows, Stored, ::testing::Values("hub_labels", "octile_labels", "terrain_labels"),
                         [](const auto& row) { return row.param; });

Vec2 random_point(Rng& rng, const GridMap& ground) {
  const auto below = [&](int n) { return static_cast<int>(rng.below(static_cast<std::uint64_t>(n))); };
  return ground.point({below(ground.frame.width), below(ground.frame.height)});
}

TEST_P(Stored, AnswersAsTheIndexThatWasBuilt) {
  Rng rng = Rng(51).child("stored");
  // Labels, landmarks, and nothing that fits.
  const std::vector<std::pair<IndexedGround, std::int64_t>> grounds = {
      {ground_of(rooms(rng, 40)), 64},
      {ground_of(strewn(rng, 120, 120, 0.1)), 2},
      {ground_of(strewn(rng, 200, 200, 0.3)), 1}};
  int bent = 0;
  for (const auto& [ground, hub_memory_mib] : grounds) {
    const ConfiguredPlanner row = planner(hub_memory_mib);
    Workspace built, loaded;
    const std::string bytes = row.save_index(ground, {}, built).value();
    ASSERT_TRUE(row.load_index(ground, stored(bytes), loaded));
    EXPECT_EQ(row.save_index(ground, {}, loaded).value(), bytes);
    EXPECT_EQ(saved(ground, hub_memory_mib), bytes);
    for (int k = 0; k < 150; ++k) {
      Problem problem{ground.grid, random_point(rng, *ground.grid), random_point(rng, *ground.grid)};
      problem.costs = ground.costs;
      const auto a = row.plan(problem, {}, built), b = row.plan(problem, {}, loaded);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (!a) continue;
      ASSERT_EQ(*a, *b);
      ASSERT_TRUE(check(*b, problem));
      bent += a->vertices.size() > 3 ? 1 : 0;
    }
  }
  EXPECT_GT(bent, 100);
}

TEST_P(Stored, IsRefusedWithAnyByteChanged) {
  Rng rng = Rng(52).child("bytes");
  const IndexedGround ground = ground_of(rooms(rng, 9));
  const std::string bytes = saved(ground);
  ASSERT_EQ(refusal(ground, bytes), "");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string wrong = bytes;
    wrong[i] = static_cast<char>(wrong[i] ^ static_cast<char>(1U << rng.below(8)));
    const std::string sentence = refusal(ground, wrong);
    ASSERT_NE(sentence, "") << "byte " << i;
    ASSERT_NE(sentence.find("; delete it"), std::string::npos) << sentence;
  }
}

TEST_P(Stored, IsRefusedCutOrWithMoreBytes) {
  Rng rng = Rng(53).child("cut");
  const IndexedGround ground = ground_of(rooms(rng, 9));
  const std::string bytes = saved(ground);
  for (std::size_t size = 0; size < bytes.size(); size += size < 512 ? 1 : 37)
    ASSERT_NE(refusal(ground, std::string_view(bytes).substr(0, size)), "") << size;
  EXPECT_EQ(refusal(ground, bytes + "12345678"),
            "it has " + std::to_string(bytes.size() + 8) + " bytes, not " + std::to_string(bytes.size()) +
                ", so it is cut or damaged; delete it, and it is made anew, or name another file");
}

/// Content that was changed and has a right checksum may give wrong paths, but every query ends.
TEST_P(Stored, EndsEveryQueryWithAnyWordChanged) {
  Rng rng = Rng(55).child("words");
  const IndexedGround ground = ground_of(rooms(rng, 9));
  const hub_labelling::IndexKey key{GetParam(), "hub_memory 64", *ground.grid, ground.costs.get()};
  const StoredIndex whole = stored(saved(ground));
  const auto content = hub_labelling::content_of(whole, key).value();
  int refused = 0;
  for (int round = 0; round < testing::cases(300); ++round) {
    hub_labelling::IndexWriter writer;
    const std::size_t changed = rng.below(content.size() / 8);
    for (std::size_t i = 0; i < content.size() / 8; ++i) {
      std::uint64_t word = 0;
      std::memcpy(&word, content.data() + 8 * i, sizeof word);
      writer.number(i == changed ? word ^ (std::uint64_t{1} << rng.below(64)) : word);
    }
    Workspace workspace;
    const ConfiguredPlanner row = planner();
    if (!row.load_index(ground, stored(std::move(writer).finish(key)), workspace)) {
      ++refused;
      continue;
    }
    for (int k = 0; k < 20; ++k) {
      Problem problem{ground.grid, random_point(rng, *ground.grid), random_point(rng, *ground.grid)};
      problem.costs = ground.costs;
      [[maybe_unused]] const auto plan = row.plan(problem, {}, workspace);
    }
  }
  EXPECT_GT(refused, 0);
}

TEST_P(Stored, IsRefusedForAnotherMapRowOrOption) {
  Rng rng = Rng(54).child("others");
  auto grid = rooms(rng, 12);
  const IndexedGround ground = ground_of(grid);
  const std::string bytes = saved(ground);
  grid.cells[70] ^= 1U;
  EXPECT_EQ(refusal(ground_of(grid), bytes).substr(0, 27), "it was made for another map");
  EXPECT_EQ(refusal(ground, saved(ground, 65)).substr(0, 33), "it was made with other options of");
  const std::string other = GetParam() == "hub_labels" ? "octile_labels" : "hub_labels";
  const GridModel model = other == "hub_labels" ? GridModel::corners : GridModel::cells;
  Workspace workspace;
  const auto others = find_path_planner(other)->configure().save_index(
      {std::make_shared<const GridMap>(GridMap::of(grid, model).value())}, {}, workspace);
  EXPECT_EQ(refusal(ground, *others).substr(0, 23), "it holds the index of " + other.substr(0, 1));
  if (ground.costs != nullptr) {
    grid.cells[70] ^= 1U;
    EXPECT_EQ(refusal(ground_of(grid, 2), bytes).substr(0, 41), "it was made for other costs of the cells;");
    EXPECT_EQ(refusal({ground.grid}, bytes).substr(0, 41), "it was made for other costs of the cells;");
  }
  EXPECT_EQ(refusal(ground, std::string(5000, 'x')).substr(0, 19), "it is no index file");
}

}  // namespace
}  // namespace outrider
