// A GuidedGraph as stored bytes, without its windings.
#pragma once

#include <algorithm>

#include "guided_graph.hpp"
#include "hubs/index_bytes.hpp"

namespace outrider::hub_labelling {

template <class Metric>
void write(IndexWriter& writer, const GuidedGraph<Metric>& graph) {
  writer.array(graph.at);
  writer.array(graph.first);
  writer.array(graph.to);
  writer.array(graph.component);
  writer.array(graph.landmarks);
  writer.array(graph.lengths);
}

/// Returns false if the content contradicts itself. Lengths may be wrong; a search then still ends.
template <class Metric>
bool read(IndexReader& reader, GuidedGraph<Metric>& graph) {
  const bool whole = reader.array(graph.at) && reader.array(graph.first) && reader.array(graph.to) &&
                     reader.array(graph.component) && reader.array(graph.landmarks) &&
                     reader.array(graph.lengths);
  const std::size_t turns = graph.at.size();
  if (!whole || graph.first.size() != 2 * turns + 1 || graph.component.size() != turns ||
      graph.lengths.size() != turns || graph.landmarks.size() > most_landmarks)
    return false;
  const auto first = graph.first.all();
  const auto names_a_turn = [&](std::uint32_t turn) { return turn < turns; };
  return std::is_sorted(first.begin(), first.end()) && first.back() == graph.to.size() &&
         std::ranges::all_of(graph.to.all(), names_a_turn) &&
         std::ranges::all_of(graph.landmarks.all(), names_a_turn);
}

}  // namespace outrider::hub_labelling
