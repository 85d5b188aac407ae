// A pose graph gathered line by line: nodes by name, in the order in which they come; edges judged at once.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/io/text.hpp"
#include "outrider/slam/pose_graph.hpp"

namespace outrider {

class GraphLines {
 public:
  /// A node that a line places; refused when it is placed already.
  Status place(std::string_view name, const Pose2& pose, bool is_point);
  /// An edge; nodes that are new get no place. `triangle` is the upper triangle of the information, or, when
  /// `covariance`, of its inverse.
  Status join(EdgeKind kind, std::string_view from, std::string_view to, const Pose2& measured,
              std::span<const double> triangle, bool covariance);
  [[nodiscard]] bool knows(std::string_view name) const { return numbers_.contains(name); }
  /// The graph, with the nodes that were not placed standing where the edges say.
  Outcome<PoseGraph> finish() &&;

  PoseGraph graph;
  std::vector<bool> placed;

 private:
  Outcome<std::uint32_t> node(std::string_view name, bool is_point);

  std::map<std::string, std::uint32_t, std::less<>> numbers_;
};

/// The words as finite numbers below 1e18 in size; nothing when one is not.
std::optional<std::vector<double>> numbers_of(std::span<const std::string_view> words);

/// Gives `read` each line with more than blanks and a comment; a fault gets the line's number. At most
/// 2,000,000.
Status read_graph_lines(std::string_view text, const std::string& name,
                        const std::function<Status(std::string_view)>& read);

}  // namespace outrider
