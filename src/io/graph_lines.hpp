// GraphLines: builds a pose graph line by line. Nodes have names and keep their order; edges are checked at
// once.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/io/g2o.hpp"
#include "outrider/io/text.hpp"
#include "outrider/slam/pose_graph.hpp"

namespace outrider {

/// The kind of matrix that comes with an edge.
enum class EdgeMatrix { information, covariance };

template <class Pose>
class GraphLines {
 public:
  /// Places a node. Fault: bad_input if it is placed already.
  Status place(std::string_view name, const Pose& pose, bool is_point);
  /// Adds an edge. New nodes are not placed. `triangle` is the upper triangle of its matrix, by rows.
  Status join(EdgeKind kind, std::string_view from, std::string_view to, const Pose& measured,
              std::span<const double> triangle, EdgeMatrix matrix);
  [[nodiscard]] bool knows(std::string_view name) const { return numbers_.contains(name); }
  /// Returns the graph. Nodes that no line placed are placed by the edges.
  Outcome<PoseGraphOf<Pose>> finish() &&;

  InformationTerms terms = InformationTerms::all;
  PoseGraphOf<Pose> graph;
  std::vector<bool> placed;

 private:
  Outcome<std::uint32_t> node(std::string_view name, bool is_point);

  std::map<std::string, std::uint32_t, std::less<>> numbers_;
};

/// Returns the words as finite numbers up to 1e18 in size, or nothing if a word is not such a number.
std::optional<std::vector<double>> numbers_of(std::span<const std::string_view> words);

/// Calls `read` for each line that is not empty after removal of its comment. A fault gets the line number.
/// Reads at most 2,000,000 lines.
Status read_graph_lines(std::string_view text, const std::string& name,
                        const std::function<Status(std::string_view)>& read);

}  // namespace outrider
