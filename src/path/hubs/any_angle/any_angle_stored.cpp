// The index of hub_labels as stored bytes.
#include <algorithm>

#include "any_angle_index.hpp"
#include "hubs/turns/guided_stored.hpp"

namespace outrider::hub_labelling {
namespace {

bool corner_of(const GridMap& ground, Cell c) { return ground.contains(c); }

/// Every node leads to an earlier one of its tree or is a hub, so following them ends.
bool sound(const AnyAngleLabels& labels, const GridMap& ground) {
  for (const Cell turn : labels.turns.all()) {
    if (!corner_of(ground, turn)) return false;
  }
  for (std::size_t i = 0; i < labels.nodes.size(); ++i) {
    if (labels.nodes[i].next > i || labels.nodes[i].turn >= labels.turns.size()) return false;
  }
  return true;
}

bool sound(const TileRow& row, const GridMap& ground, std::size_t nodes) {
  if (row.tiles.size() != tile_columns_of(ground) + 1) return false;
  const TileRow::Tile last = row.tiles[row.tiles.size() - 1];
  if (row.tiles[0].entries != 0 || row.tiles[0].turns != 0 || last.entries != row.entries.size() ||
      last.turns != row.turns.size())
    return false;
  for (std::size_t t = 1; t < row.tiles.size(); ++t) {
    const TileRow::Tile low = row.tiles[t - 1], high = row.tiles[t];
    if (low.entries > high.entries || low.turns > high.turns) return false;
    // In order, so the last bounds hold for all before: entries are looked at only within theirs.
    if (high.entries > row.entries.size() || high.turns > row.turns.size()) return false;
    for (std::uint32_t e = low.entries; e < high.entries; ++e) {
      if (row.entries[e].node >= nodes || row.entries[e].turn >= high.turns - low.turns) return false;
    }
  }
  return true;
}

std::optional<AnyAngleLabels> read_labels(IndexReader& reader, const GridMap& ground) {
  AnyAngleLabels labels;
  if (!reader.array(labels.turns) || !reader.array(labels.nodes) || !sound(labels, ground))
    return std::nullopt;
  labels.rows.resize(tile_rows_of(ground));
  for (TileRow& row : labels.rows) {
    const bool whole = reader.array(row.tiles) && reader.array(row.entries) && reader.array(row.turns);
    if (!whole || !sound(row, ground, labels.nodes.size())) return std::nullopt;
  }
  return labels;
}

std::unique_ptr<const AnyAngleTurns> read_turns(IndexReader& reader, const GridMap& ground) {
  AnyAngleTurns turns{navigation_mesh(ground), {}};
  turns.graph.windings = windings_of(turns.mesh);
  if (!read(reader, turns.graph)) return nullptr;
  const bool same = std::equal(turns.mesh.turns.begin(), turns.mesh.turns.end(), turns.graph.at.all().begin(),
                               turns.graph.at.all().end(),
                               [](const NavigationMesh::Turn& turn, Cell at) { return turn.at == at; });
  if (!same) return nullptr;
  return std::make_unique<const AnyAngleTurns>(std::move(turns));
}

}  // namespace

void AnyAngleIndex::write(IndexWriter& writer) const {
  writer.number(static_cast<std::uint64_t>(labels ? IndexKind::labels : IndexKind::guided));
  writer.number(work);
  writer.number(work_of_search);
  if (!labels) {
    hub_labelling::write(writer, turns->graph);
    return;
  }
  writer.array(labels->turns);
  writer.array(labels->nodes);
  for (const TileRow& row : labels->rows) {
    writer.array(row.tiles);
    writer.array(row.entries);
    writer.array(row.turns);
  }
}

std::unique_ptr<const AnyAngleIndex> AnyAngleIndex::read(IndexReader& reader, const GridMap& ground) {
  AnyAngleIndex index;
  std::uint64_t kind = 0;
  if (!reader.number(kind) || !reader.number(index.work) || !reader.number(index.work_of_search))
    return nullptr;
  if (kind == static_cast<std::uint64_t>(IndexKind::labels)) index.labels = read_labels(reader, ground);
  if (kind == static_cast<std::uint64_t>(IndexKind::guided)) index.turns = read_turns(reader, ground);
  if ((!index.labels && !index.turns) || !reader.at_end()) return nullptr;
  return std::make_unique<const AnyAngleIndex>(std::move(index));
}

}  // namespace outrider::hub_labelling
