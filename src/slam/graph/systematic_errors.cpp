#include "outrider/slam/graph/systematic_errors.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "graph/graduated.hpp"
#include "graph/graph_equations.hpp"

namespace outrider {
namespace {

constexpr double most_gain = 16.7;        // of chi-square with five degrees of freedom, one time in 200
constexpr double most_ranges_gain = 9.2;  // with two, one time in 100
constexpr double most_points_m = 0.1, most_poses_m = 0.25, most_of_radius = 0.03;
constexpr double alike = 0.8;         // correlation of the errors of ways and of turns
constexpr double stated_part = 0.01;  // of ranges of a calibrated range finder
constexpr double least = 1e-6;        // of a prior: where nothing of the kind is measured
constexpr Eigen::Index kinds = SharedErrors::RowsAtCompileTime;
using SharedMatrix = Eigen::Matrix<double, kinds, kinds>;
using Shares = Eigen::Matrix<double, 3, kinds>;

/// Returns the edge with what the solution says that it measures. A shared part belongs to that: if it were
/// one of what was measured, with its noise, a smaller map would always fit better.
GraphEdge predicted(GraphEdge edge, const Eigen::Vector3d& residual) {
  edge.measured.position = edge.measured.position + Vec2{residual[0], residual[1]};
  edge.measured.heading_rad += residual[2];
  return edge;
}

/// Returns what each shared error of one changes in the measurement of an edge.
Shares shares_of(const GraphEdge& edge, bool is_odometry) {
  Shares shares = Shares::Zero();
  const Vec2 measured = edge.measured.position;
  const double way_m = norm(measured);
  if (edge.kind == EdgeKind::range) {
    shares.row(0) << 0.0, 0.0, 0.0, 1.0, measured.x;
  } else if (edge.kind == EdgeKind::point && way_m > 0.0) {
    shares.col(4).head<2>() << measured.x, measured.y;
    shares.col(3) = shares.col(4) / way_m;
  } else if (is_odometry) {
    shares.col(0).head<2>() << measured.x, measured.y;
    shares.row(2) << 0.0, edge.measured.heading_rad, std::copysign(way_m, measured.x), 0.0, 0.0;
  }
  return shares;
}

/// The graph with its shared errors as further unknowns.
class SharedEquations {
 public:
  SharedEquations(const PoseGraph& graph, const std::vector<Pose2>& poses) : graph_(graph), poses_(poses) {
    const std::vector<bool> refusable = refusable_edges(graph);
    for (std::size_t i = 0; i < graph.edges.size(); ++i) {
      const GraphEdge& edge = graph.edges[i];
      linear_.push_back(linearise(edge, poses[edge.from], poses[edge.to]));
      shares_.push_back(
          shares_of(predicted(edge, linear_.back().residual), edge.kind == EdgeKind::pose && !refusable[i]));
    }
  }

  /// Eliminates the poses; returns false if they are not determined.
  bool eliminate() {
    const auto first_pose = std::ranges::find(graph_.nodes, false, &GraphNode::is_point);
    GraphEquations<Pose2> equations(graph_, static_cast<std::uint32_t>(first_pose - graph_.nodes.begin()));
    for (Eigen::Index k = -1; k < kinds; ++k) {
      equations.clear();
      for (std::size_t i = 0; i < linear_.size(); ++i) {
        LinearEdge edge = linear_[i];
        if (k >= 0) edge.residual = shares_[i].col(k);
        equations.add(i, edge);
      }
      if (k < 0 && !equations.factor(0.0)) return false;
      (k < 0 ? settled_ : moved_[static_cast<std::size_t>(k)]) = equations.solve();
    }
    weigh();
    return true;
  }

  /// Returns the shared errors with a prior of these standard deviations, for noise that is larger than
  /// stated by the root of `inflation`.
  [[nodiscard]] SharedSolution solution(const SharedErrors& sds, double inflation) const {
    SharedMatrix prior = sds.cwiseMax(least).cwiseAbs2().asDiagonal();
    prior(0, 1) = prior(1, 0) = alike * std::sqrt(prior(0, 0) * prior(1, 1));
    const SharedMatrix certainty = information_ / inflation + SharedMatrix(prior.inverse());
    SharedSolution result;
    result.estimate = certainty.ldlt().solve(weighted_ / inflation);
    result.gain = result.estimate.dot(weighted_) / inflation;
    result.points = shift(true, result.estimate, certainty);
    result.poses = shift(false, result.estimate, certainty);
    return result;
  }

 private:
  /// Returns by how much the points, or the poses, may be off.
  [[nodiscard]] MapShift shift(bool of_points, const SharedErrors& estimate,
                               const SharedMatrix& certainty) const {
    std::vector<std::size_t> nodes;
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
      if (graph_.nodes[i].is_point == of_points) nodes.push_back(i);
    }
    if (nodes.size() < 2) return {};
    const auto rows = static_cast<Eigen::Index>(2 * nodes.size());
    Eigen::Matrix<double, Eigen::Dynamic, 3> rigid(rows, 3);
    Eigen::Matrix<double, Eigen::Dynamic, kinds> by(rows, kinds);
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      const auto row = static_cast<Eigen::Index>(2 * j);
      const Vec2 place = poses_[nodes[j]].position;
      rigid.middleRows<2>(row) << 1.0, 0.0, -place.y, 0.0, 1.0, place.x;
      for (Eigen::Index k = 0; k < kinds; ++k)
        by.block<2, 1>(row, k) = moved_[static_cast<std::size_t>(k)][nodes[j]].head<2>();
    }
    const auto count = static_cast<double>(nodes.size());
    const Eigen::Matrix3d gram = rigid.transpose() * rigid;
    by -= rigid * gram.ldlt().solve(rigid.transpose() * by);
    const SharedMatrix moves = by.transpose() * by / count;
    const double radius_m =
        std::sqrt((gram(2, 2) - (gram(0, 2) * gram(0, 2) + gram(1, 2) * gram(1, 2)) / count) / count);
    const Eigen::GeneralizedSelfAdjointEigenSolver<SharedMatrix> widest(moves, certainty);
    return {std::sqrt(std::max(0.0, estimate.dot(moves * estimate))),
            std::sqrt(std::max(0.0, widest.eigenvalues()[kinds - 1])),
            std::max(of_points ? most_points_m : most_poses_m, most_of_radius * radius_m),
            widest.eigenvectors().col(kinds - 1)};
  }

  [[nodiscard]] static Eigen::Vector3d change(const LinearEdge& edge, const GraphEdge& ends,
                                              const GraphSteps<Pose2>& steps) {
    return edge.by_from * steps[ends.from] + edge.by_to * steps[ends.to];
  }

  void weigh() {
    for (std::size_t i = 0; i < linear_.size(); ++i) {
      const LinearEdge& edge = linear_[i];
      const Eigen::Vector3d residual = edge.residual + change(edge, graph_.edges[i], settled_);
      Shares left = shares_[i];
      for (Eigen::Index k = 0; k < kinds; ++k)
        left.col(k) += change(edge, graph_.edges[i], moved_[static_cast<std::size_t>(k)]);
      information_ += left.transpose() * edge.information * left;
      weighted_ -= left.transpose() * edge.information * residual;
    }
  }

  const PoseGraph& graph_;
  const std::vector<Pose2>& poses_;
  std::vector<LinearEdge> linear_;
  std::vector<Shares> shares_;
  GraphSteps<Pose2> settled_;                        ///< steps to the least cost
  std::array<GraphSteps<Pose2>, kinds> moved_;       ///< steps for each shared error of one
  SharedMatrix information_ = SharedMatrix::Zero();  ///< on the shared errors, by the measurements alone
  SharedErrors weighted_ = SharedErrors::Zero();     ///< its product with their estimate
};

/// Returns the standard deviations of stated tolerances; `noise` is the ratio of the noise to what is stated,
/// which is often said to be too large and never to be too small.
SharedErrors stated_sds(const PoseGraph& graph, double noise) {
  double way_m = 0.0, turn_rad = 0.0, way_m2 = 0.0, turn_rad2 = 0.0, ranges = 0.0, range_m = 0.0;
  const std::vector<bool> refusable = refusable_edges(graph);
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    const double length_m = norm(edge.measured.position);
    if (edge.kind != EdgeKind::pose) {
      ranges += 1.0;
      range_m += length_m;
    } else if (!refusable[i]) {
      const Eigen::Matrix3d covariance = edge.information.inverse();
      way_m += length_m;
      turn_rad += std::abs(edge.measured.heading_rad);
      way_m2 += 0.5 * covariance.topLeftCorner<2, 2>().trace();
      turn_rad2 += covariance(2, 2);
    }
  }
  const auto root = [&](double square, double over) {
    return over > 0.0 ? std::min(1.0, noise) * std::sqrt(square / over) : 0.0;
  };
  SharedErrors sds;
  sds << root(way_m2, way_m), root(turn_rad2, turn_rad), root(turn_rad2, way_m),
      ranges > 0.0 ? stated_part * range_m / ranges : 0.0, stated_part;
  return sds;
}

/// Returns the shift by which a solution contradicts the map, with one standard deviation of what is not
/// seen; null if it does not.
const MapShift* contradiction(const SharedSolution& solution, double least_gain) {
  if (!(solution.gain > least_gain)) return nullptr;
  for (const MapShift* const shift : {&solution.points, &solution.poses}) {
    if (shift->moved_m + shift->unseen_m > shift->most_m) return shift;
  }
  return nullptr;
}

}  // namespace

SystematicErrors find_systematic_errors(const PoseGraph& graph, const std::vector<Pose2>& poses) {
  constexpr double length_m = 0.3, large = 0.1;
  if (std::ranges::all_of(graph.edges, [](const GraphEdge& edge) { return edge.kind == EdgeKind::pose; }))
    return {};
  SharedEquations equations(graph, poses);
  if (!equations.eliminate()) return {};
  const double freedom = degrees_of_freedom(graph);
  const double ratio = freedom > 0.0 ? cost(graph, poses) / freedom : 1.0;
  const double inflation = std::max(1.0, ratio);
  SharedErrors odometry, ranges;
  odometry << large, large, large, length_m, stated_part;
  ranges << stated_part, stated_part, stated_part, length_m, large;
  return {equations.solution(stated_sds(graph, std::sqrt(ratio)), inflation),
          equations.solution(odometry, inflation), equations.solution(ranges, inflation)};
}

std::string why_not_believed(const SystematicErrors& errors) {
  if (const MapShift& points = errors.stated.points; points.unseen_m > points.most_m) {
    const SharedErrors& along = points.direction;
    return fmt::format(
        "the measurements do not tell the size of the map: odometry whose ways are {:+.1f} % and turns "
        "{:+.1f} "
        "% off, with ranges {:+.2f} m and {:+.1f} % off, would move it by {:.2f} m",
        100.0 * along[0], 100.0 * along[1], along[3], 100.0 * along[4], points.unseen_m);
  }
  for (const SharedSolution* const one : {&errors.odometry, &errors.ranges}) {
    const MapShift* const shift = contradiction(*one, one == &errors.odometry ? most_gain : most_ranges_gain);
    if (shift == nullptr) continue;
    const SharedErrors& found = one->estimate;
    return fmt::format(
        "the measurements are much more likely if odometry counts ways {:+.1f} % and turns {:+.1f} % too "
        "much "
        "and ranges are {:+.2f} m and {:+.1f} % too long, so the map may be of a wrong size, by {:.2f} m",
        100.0 * found[0], 100.0 * found[1], found[3], 100.0 * found[4], shift->moved_m);
  }
  return {};
}

}  // namespace outrider
