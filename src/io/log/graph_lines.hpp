// GraphLines: builds a pose graph line by line. Nodes have names and keep their order; edges are checked at
// once.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/io/files/text.hpp"
#include "outrider/io/log/g2o.hpp"
#include "outrider/slam/graph/pose_graph.hpp"

namespace outrider {

template <class Pose>
class GraphLines {
 public:
  /// Places a node. Fault: bad_input if it is placed already.
  Status place(std::string_view name, const Pose& pose, bool is_point);
  /// Adds an edge. New nodes are not placed. `triangle` is the upper triangle of its matrix, by rows.
  Status join(EdgeKind kind, std::string_view from, std::string_view to, const Pose& measured,
              std::span<const double> triangle);
  [[nodiscard]] bool knows(std::string_view name) const { return numbers_.contains(name); }
  /// Returns the graph. Nodes that no line placed are placed by the edges.
  Outcome<PoseGraphOf<Pose>> finish() &&;

  InformationTerms terms = InformationTerms::all;
  bool covariances = false;  ///< the matrices of edges are covariances, not information
  PoseGraphOf<Pose> graph;
  std::vector<bool> placed;

 private:
  Outcome<std::uint32_t> node(std::string_view name, bool is_point);

  std::map<std::string, std::uint32_t, std::less<>> numbers_;
};

/// The form of a line: its first word, its names and its numbers.
struct GraphForm {
  std::string_view tag;
  std::size_t names;
  std::size_t numbers;
  std::string_view sentence;
  std::size_t names_from = 1;  ///< index of the word with the first name
};

/// The words of a line that has one of the forms.
struct GraphLine {
  std::string_view tag;
  std::span<const std::string_view> names;
  std::vector<double> numbers;
};

/// Calls `read` for each line that is not empty. Faults: bad_input with the line number, for lines of no
/// form; more than 2,000,000 lines. `ground` says what the graph is of.
Status read_graph_lines(std::string_view text, const std::string& name, std::span<const GraphForm> forms,
                        std::string_view ground, const std::function<Status(const GraphLine&)>& read);

}  // namespace outrider
