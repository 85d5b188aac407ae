#include <cmath>

#include "faults/spoil_parts.hpp"
#include "graph/graph_log.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/spatial_pose.hpp"

namespace outrider {
namespace {

constexpr int most_draws = 100;

double length(const Pose2& pose) { return norm(pose.position); }
double length(const Pose3& pose) { return norm(pose.position); }

/// Only the way: a robot in space does not turn by its wheels alone.
Pose3 scaled(const Pose3& motion, double ratio) { return {ratio * motion.position, motion.rotation}; }

void place_anywhere(Pose2& measured, double farthest_m, Rng& rng) {
  const double bearing_rad = rng.uniform(-pi, pi);
  measured.position = rng.uniform(0.0, farthest_m) * direction(bearing_rad);
}
void place_anywhere(Pose3& measured, double farthest_m, Rng& rng) {
  const double height = rng.uniform(-1.0, 1.0);
  const double aside = std::sqrt(1.0 - height * height);
  const Vec2 flat = direction(rng.uniform(-pi, pi));
  measured.position = rng.uniform(0.0, farthest_m) * Vec3{aside * flat.x, aside * flat.y, height};
}

template <class Pose>
class GraphSpoiler {
 public:
  using Edge = GraphEdgeOf<Pose>;

  GraphSpoiler(const PoseGraphOf<Pose>& graph, const RecordingFaults& faults, const Rng& rng)
      : faults_(faults), outliers_(rng.child("outliers")), ids_(rng.child("ids")), ways_(graph) {
    out_.recording = graph;
    for (NodeIndex node = 0; node < graph.nodes.size(); ++node)
      (graph.nodes[node].is_point ? points_ : poses_).push_back(node);
    for (const auto& edge : graph.edges) {
      if (edge.kind != EdgeKind::pose) farthest_m_ = std::max(farthest_m_, length(edge.measured));
    }
  }

  /// Returns the key of a fault that no edge of the graph can have; empty if there is none.
  [[nodiscard]] std::string_view impossible() const {
    const auto has = [&](auto is_it) { return std::ranges::any_of(out_.recording.edges, is_it); };
    const auto moves = [&](const Edge& edge) { return is_odometry(edge); };
    if (faults_.slip > 0.0 && !has(moves)) return "slip";
    if (faults_.outliers > 0.0 && std::ranges::all_of(out_.recording.edges, moves)) return "outliers";
    if (faults_.changes_ranges() && !has([](const auto& edge) { return edge.kind != EdgeKind::pose; }))
      return faults_.bias_m != 0.0 ? "bias" : "range_scale";
    const bool has_sightings = has([](const auto& edge) { return edge.kind == EdgeKind::point; });
    if (faults_.wrong_ids > 0.0 && (points_.size() < 2 || !has_sightings)) return "wrong_ids";
    return {};
  }

  Spoiled<PoseGraphOf<Pose>> run() {
    for (Edge& edge : out_.recording.edges) out_.changes += spoil(edge) ? 1 : 0;
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool is_odometry(const Edge& edge) const {
    return edge.kind == EdgeKind::pose && ways_.follow(edge.from, edge.to);
  }

  /// Returns true if the edge was changed.
  bool spoil(Edge& edge) {
    if (is_odometry(edge)) {
      if (faults_.slip > 0.0) edge.measured = scaled(edge.measured, 1.0 / (1.0 - faults_.slip));
      return faults_.slip > 0.0;
    }
    const double range_m = length(edge.measured);
    const bool is_biased = edge.kind != EdgeKind::pose && faults_.changes_ranges() && range_m > 0.0;
    if (is_biased) edge.measured.position = biased(range_m, faults_) / range_m * edge.measured.position;
    const bool is_outlier = faults_.outliers > 0.0 && outliers_.uniform() < faults_.outliers;
    if (is_outlier) make_outlier(edge);
    const bool is_wrong =
        edge.kind == EdgeKind::point && faults_.wrong_ids > 0.0 && ids_.uniform() < faults_.wrong_ids;
    if (is_wrong) edge.to = other(points_, edge.to, ids_);
    return is_biased || is_outlier || is_wrong;
  }

  void make_outlier(Edge& edge) {
    if (edge.kind == EdgeKind::point) {
      place_anywhere(edge.measured, farthest_m_, outliers_);
      return;
    }
    if (edge.kind == EdgeKind::range) {
      edge.measured.position.x = outliers_.uniform(0.0, farthest_m_);
      return;
    }
    for (int draw = 0; draw < most_draws; ++draw) {
      const NodeIndex to = other(poses_, edge.to, outliers_);
      if (to == edge.from || ways_.follow(edge.from, to)) continue;
      edge.to = to;
      return;
    }
  }

  /// Returns one of the nodes but this; there are two at least.
  static NodeIndex other(const std::vector<NodeIndex>& nodes, NodeIndex but, Rng& rng) {
    const NodeIndex drawn = nodes[rng.below(nodes.size() - 1)];
    return drawn == but ? nodes.back() : drawn;
  }

  RecordingFaults faults_;
  Rng outliers_;
  Rng ids_;
  Ways ways_;
  std::vector<NodeIndex> poses_;
  std::vector<NodeIndex> points_;
  double farthest_m_ = 0.0;  ///< of what is measured to points, and of ranges
  Spoiled<PoseGraphOf<Pose>> out_;
};

}  // namespace

template <class Pose>
Outcome<Spoiled<PoseGraphOf<Pose>>> spoiled(const PoseGraphOf<Pose>& graph, const RecordingFaults& faults,
                                            const Rng& rng) {
  GraphSpoiler<Pose> spoiler(graph, faults, rng);
  if (const std::string_view key = spoiler.impossible(); !key.empty()) {
    return bad_input("the graph has no edges that this fault changes; leave it out",
                     fmt::format("faults.{}", key));
  }
  Spoiled<PoseGraphOf<Pose>> result = spoiler.run();
  if (auto whole = check(result.recording); !whole) {
    return bad_input(fmt::format("the graph cannot be solved after the faults: {}; give fewer of them, or "
                                 "another seed",
                                 whole.error().sentence),
                     "faults");
  }
  return result;
}

template Outcome<Spoiled<PoseGraph>> spoiled(const PoseGraph&, const RecordingFaults&, const Rng&);
template Outcome<Spoiled<PoseGraph3>> spoiled(const PoseGraph3&, const RecordingFaults&, const Rng&);

}  // namespace outrider
