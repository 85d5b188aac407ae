#include "laser/keyframe_covariance.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "covariances.hpp"

namespace outrider {
namespace {

/// Returns the covariance of a keyframe from that of another one and that of their relative pose.
Eigen::Matrix3d propagated(const Keyframe& from, const Keyframe& to, const Eigen::Matrix3d& of_from,
                           const Eigen::Matrix3d& relative) {
  const Eigen::Matrix3d lever = lever_of(to.pose.position - from.pose.position);
  return lever * of_from * lever.transpose() + relative;
}

/// Returns the covariance of an information that is given in the frame of a keyframe, along the world's axes.
Eigen::Matrix3d covariance_of(const Eigen::Matrix3d& information, const Keyframe& frame) {
  const Eigen::Matrix3d turn = rotation_by(frame.pose.heading_rad);
  return turn * information.inverse() * turn.transpose();
}

}  // namespace

void KeyframeCovariance::forget() {
  const auto [last, counted] = std::pair(last_, counted_);
  *this = {};
  last_ = last;
  counted_ = counted;
}

/// Adds a constraint between two keyframes whose residual is zero at the present poses. The covariance is
/// that of their relative pose, along the world's axes.
void KeyframeCovariance::join(std::span<const Keyframe> keyframes, std::uint32_t from, std::uint32_t to,
                              const Eigen::Matrix3d& covariance) {
  const Place &a = places_[from], &b = places_[to];
  if (a.node == b.node) return;
  // from a's keyframe to `from`, on to `to`, and from there to b's keyframe
  const Eigen::Matrix3d there = propagated(keyframes[from], keyframes[to], a.covariance, covariance);
  const Eigen::Matrix3d sum = propagated(keyframes[to], keyframes[b.keyframe], there, b.covariance);
  const Pose2 &start = keyframes[a.keyframe].pose, &end = keyframes[b.keyframe].pose;
  const Eigen::Matrix3d turn = rotation_by(start.heading_rad);
  const Eigen::Matrix3d w = turn.transpose() * sum.inverse() * turn;
  const LinearEdge linear =
      linearise({EdgeKind::pose, a.node, b.node, relative_pose(start, end), w}, start, end);
  const auto add_to = [&](std::uint32_t node, const Eigen::Matrix3d& by) {
    if (node == 0) return;  // fixed
    matrix_.diagonal(node) += by.transpose() * w * by;
    changed_.push_back(node);
  };
  add_to(a.node, linear.by_from);
  add_to(b.node, linear.by_to);
  if (a.node == 0 || b.node == 0) return;
  const Eigen::Matrix3d mixed = linear.by_from.transpose() * w * linear.by_to;
  matrix_.upper_block(matrix_.pair(a.node, b.node)) += a.node < b.node ? mixed : mixed.transpose();
}

void KeyframeCovariance::add(std::span<const Keyframe> keyframes, const KeyframeConstraint& constraint) {
  const GraphEdge& edge = constraint.edge;
  const Keyframe& frame = keyframes[edge.from];
  if (constraint.shared.isZero(0.0))
    return join(keyframes, edge.from, edge.to, covariance_of(constraint.certainty * edge.information, frame));
  join(keyframes, edge.from, edge.to, covariance_of(edge.information - constraint.shared, frame));
  for (const MatchedWith& with : constraint.matched) {
    if (with.share > 0.0)
      join(keyframes, with.keyframe, edge.to,
           covariance_of(with.share * constraint.certainty * constraint.shared, frame));
  }
}

/// Adds the next keyframe with the constraints that end at it: as a node, or attached to one.
void KeyframeCovariance::add_keyframe(std::span<const Keyframe> keyframes,
                                      std::span<const KeyframeConstraint> constraints) {
  const auto key = static_cast<std::uint32_t>(places_.size());
  const auto known = std::ranges::find_if(constraints, &KeyframeConstraint::is_known_place);
  if (known != constraints.end()) {
    const GraphEdge& edge = known->edge;
    Place place = places_[edge.from];
    place.covariance = propagated(keyframes[edge.from], keyframes[key], place.covariance,
                                  covariance_of(known->certainty * edge.information, keyframes[edge.from]));
    places_.push_back(place);
    return;
  }
  const auto node = static_cast<std::uint32_t>(matrix_.size());
  places_.push_back({key, node});
  matrix_.add_node();
  if (node == 0) matrix_.diagonal(0).setIdentity();
  if (ordered_ > 0) factor_.append(node);
  changed_.push_back(node);
  for (const KeyframeConstraint& constraint : constraints) add(keyframes, constraint);
}

/// Returns false if the information is too ill conditioned, as when a robot was carried for kilometres.
bool KeyframeCovariance::factor() {
  constexpr double growth = 1.25;  // of the graph, after which the elimination order is chosen anew
  std::ranges::sort(changed_);
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  if (static_cast<double>(matrix_.size()) > growth * static_cast<double>(ordered_)) {
    ordered_ = matrix_.size();
    factor_.begin(least_fill_order(matrix_, std::array{static_cast<std::uint32_t>(ordered_ - 1)}));
    factor_.analyse_all(matrix_);
    is_factored_ = factor_.factor_all(matrix_);
  } else {
    is_factored_ = factor_.factor(matrix_, factor_.analyse(matrix_, changed_)) && is_factored_;
  }
  changed_.clear();
  return is_factored_;
}

Eigen::Matrix3d KeyframeCovariance::of_last(std::span<const Keyframe> keyframes,
                                            std::span<const KeyframeConstraint> constraints) {
  if (keyframes.size() < 2) return Eigen::Matrix3d::Zero();
  while (true) {
    const auto ends_before = [&](std::size_t keyframe) {
      return constraints_ < constraints.size() && constraints[constraints_].edge.to < keyframe;
    };
    while (ends_before(places_.size())) add(keyframes, constraints[constraints_++]);  // loops
    if (places_.size() == keyframes.size()) break;
    const std::size_t first = constraints_;
    while (ends_before(places_.size() + 1)) ++constraints_;
    add_keyframe(keyframes, constraints.subspan(first, constraints_ - first));
  }
  const Place& last = places_.back();
  if (factor()) {
    const Eigen::Matrix3d node =
        last.node > 0 ? factor_.inverse_diagonal(last.node) : Eigen::Matrix3d(Eigen::Matrix3d::Zero());
    last_ = propagated(keyframes[last.keyframe], keyframes.back(), node, last.covariance);
  } else if (counted_ < keyframes.size()) {
    const auto chain = std::ranges::find_if(constraints, [&](const KeyframeConstraint& constraint) {
      return constraint.edge.to + 1 == keyframes.size();
    });
    const Keyframe& before = keyframes[chain->edge.from];
    last_ = propagated(before, keyframes.back(), last_, covariance_of(chain->edge.information, before));
  }
  counted_ = keyframes.size();
  return last_;
}

}  // namespace outrider
