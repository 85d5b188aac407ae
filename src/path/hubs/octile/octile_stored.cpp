// The index of octile_labels as stored bytes.
#include <algorithm>

#include "hubs/turns/guided_stored.hpp"
#include "octile_index.hpp"

namespace outrider::hub_labelling {
namespace {

/// Every node leads to an earlier one of its tree or is a hub, so following them ends.
bool sound(const StoredArray<OctileNode>& nodes, const GridMap& ground) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].next > i || !ground.contains(nodes[i].cell())) return false;
  }
  return true;
}

bool sound(const OctileTileRow& row, const GridMap& ground, std::size_t nodes) {
  const auto tiles = row.tiles.all();
  if (tiles.size() != tile_columns_of(ground) + 1 || !std::is_sorted(tiles.begin(), tiles.end()) ||
      tiles.back() != row.blocks.size() || row.cells.size() != row.paths.size())
    return false;
  return std::ranges::all_of(
             row.blocks.all(),
             [&](const HubBlock& block) { return block.first + ones(block.bits) <= row.paths.size(); }) &&
         std::ranges::all_of(row.paths.all(), [&](const OctilePath& path) { return path.node < nodes; });
}

std::optional<OctileLists> read_labels(IndexReader& reader, const GridMap& ground) {
  OctileLists labels;
  if (!reader.array(labels.nodes) || !sound(labels.nodes, ground)) return std::nullopt;
  labels.rows.resize(tile_rows_of(ground));
  for (OctileTileRow& row : labels.rows) {
    const bool whole = reader.array(row.tiles) && reader.array(row.blocks) && reader.array(row.cells) &&
                       reader.array(row.paths);
    if (!whole || !sound(row, ground, labels.nodes.size())) return std::nullopt;
  }
  return labels;
}

std::unique_ptr<const OctileSubgoals> read_subgoals(IndexReader& reader, const GridMap& ground) {
  OctileSubgoals subgoals{subgoals_of(ground), {}};
  if (!read(reader, subgoals.graph)) return nullptr;
  if (!std::ranges::equal(subgoals.subgoals.cells, subgoals.graph.at.all())) return nullptr;
  return std::make_unique<const OctileSubgoals>(std::move(subgoals));
}

}  // namespace

void OctileIndex::write(IndexWriter& writer) const {
  writer.number(static_cast<std::uint64_t>(labels ? IndexKind::labels : IndexKind::guided));
  writer.number(work);
  writer.number(work_of_search);
  if (!labels) {
    hub_labelling::write(writer, subgoals->graph);
    return;
  }
  writer.array(labels->nodes);
  for (const OctileTileRow& row : labels->rows) {
    writer.array(row.tiles);
    writer.array(row.blocks);
    writer.array(row.cells);
    writer.array(row.paths);
  }
}

std::unique_ptr<const OctileIndex> OctileIndex::read(IndexReader& reader, const GridMap& ground) {
  if (std::max(ground.frame.width, ground.frame.height) > longest_side_of_runs) return nullptr;
  OctileIndex index;
  std::uint64_t kind = 0;
  if (!reader.number(kind) || !reader.number(index.work) || !reader.number(index.work_of_search))
    return nullptr;
  if (kind == static_cast<std::uint64_t>(IndexKind::labels)) index.labels = read_labels(reader, ground);
  if (kind == static_cast<std::uint64_t>(IndexKind::guided)) index.subgoals = read_subgoals(reader, ground);
  if ((!index.labels && !index.subgoals) || !reader.at_end()) return nullptr;
  index.runs = octile_runs(ground);
  return std::make_unique<const OctileIndex>(std::move(index));
}

}  // namespace outrider::hub_labelling
