#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "algebra/small_cholesky.hpp"
#include "covariances.hpp"
#include "graph/graph_edges.hpp"
#include "landmark/slam_engine.hpp"
#include "outrider/core/units.hpp"
#include "outrider/slam/landmark/joint_compatibility.hpp"

namespace outrider {
namespace {

using Dense = Eigen::MatrixXd;
using Index = Eigen::Index;

Index at(std::size_t landmark) { return 3 + 2 * static_cast<Index>(landmark); }

/// The Kalman filters. The state is (x, y, heading of the robot, x, y of each landmark). In the linear filter
/// the heading has no uncertainty, so it is never corrected.
class FilterEngine : public SlamEngine {
 public:
  FilterEngine(LandmarkSlamOptions options, const Pose2& start)
      : options_(std::move(options)),
        linear_(options_.engine == "kalman"),
        mean_(Eigen::Vector3d(start.position.x, start.position.y, start.heading_rad)),
        covariance_(Dense::Zero(3, 3)),
        trajectory_{start} {}

  StepOutcome advance(const LogStep& step) override {
    ++memory_.step;
    predict(step);
    StepOutcome outcome;
    const std::vector<Pairing> pairings = associate(step.sightings, outcome);
    note_fit(memory_, outcome);
    correct(step.sightings, pairings);
    outcome.lost = memory_.lost(options_);
    if (!outcome.lost) {
      remove_gone(step.sightings, pairings, outcome);
      add_new(step.sightings, outcome);
    }
    trajectory_.push_back(pose());
    return outcome;
  }

  [[nodiscard]] Pose2 pose() const override { return {{mean_(0), mean_(1)}, mean_(2)}; }
  [[nodiscard]] Eigen::Matrix3d pose_covariance() const override { return covariance_.topLeftCorner<3, 3>(); }
  [[nodiscard]] LandmarkMap landmarks() const override {
    LandmarkMap map;
    for (std::size_t i = 0; i < records_.size(); ++i) {
      map.push_back(
          {records_[i].id, position(i), covariance_.block<2, 2>(at(i), at(i)), records_[i].sightings});
    }
    return map;
  }
  [[nodiscard]] std::vector<Pose2> trajectory() const override { return trajectory_; }
  [[nodiscard]] double cost() const override { return cost_; }
  [[nodiscard]] std::int64_t degrees_of_freedom() const override { return 2 * corrections_; }
  [[nodiscard]] const LandmarkSlamOptions& options() const override { return options_; }
  void save(StateWriter& writer) const override {
    FilterEngine copy = *this;
    copy.exchange(writer);
  }

  template <class Archive>
  void exchange(Archive& archive) {
    std::vector<double> mean(mean_.data(), mean_.data() + mean_.size());
    std::vector<double> covariance(covariance_.data(), covariance_.data() + covariance_.size());
    archive(memory_, records_, trajectory_, mean, covariance, cost_, corrections_);
    if constexpr (Archive::reading) {
      const std::size_t n = 3 + 2 * records_.size();
      archive.ok = archive.ok && mean.size() == n && covariance.size() == n * n && corrections_ >= 0;
      if (!archive.ok) return;
      const auto size = static_cast<Index>(n);
      mean_ = Eigen::Map<const Eigen::VectorXd>(mean.data(), size);
      covariance_ = Eigen::Map<const Dense>(covariance.data(), size, size);
    }
  }

 private:
  struct Pairing {
    std::size_t sighting = 0;
    std::size_t landmark = 0;
  };

  [[nodiscard]] Vec2 position(std::size_t landmark) const {
    return {mean_(at(landmark)), mean_(at(landmark) + 1)};
  }

  /// Predicts x' = x (+) u (Smith, Self and Cheeseman), with the Jacobians by x and by u.
  void predict(const LogStep& step) {
    const Pose2 before = pose();
    const Vec2 moved = rotated(before.heading_rad, step.odometry.position);
    const Eigen::Matrix3d by_pose = lever_of(moved);
    Eigen::Matrix3d by_motion = rotation_by(before.heading_rad);
    if (linear_) by_motion(2, 2) = 0.0;
    const Pose2 after = wrap_heading(compose(before, step.odometry));
    mean_.head(3) << after.position.x, after.position.y, after.heading_rad;
    const Index rest = covariance_.rows() - 3;
    covariance_.topLeftCorner<3, 3>() = (by_pose * covariance_.topLeftCorner<3, 3>() * by_pose.transpose() +
                                         by_motion * step.covariance * by_motion.transpose())
                                            .eval();
    covariance_.topRightCorner(3, rest) = (by_pose * covariance_.topRightCorner(3, rest)).eval();
    covariance_.bottomLeftCorner(rest, 3) = covariance_.topRightCorner(3, rest).transpose();
  }

  /// The innovation of a sighting, and the Jacobian of the predicted sighting by the whole state.
  struct Expectation {
    Eigen::Vector2d innovation;
    Eigen::Matrix<double, 2, Eigen::Dynamic> jacobian;
  };
  [[nodiscard]] Expectation expect(const LandmarkSighting& sighting, std::size_t landmark) const {
    const GraphEdge edge{EdgeKind::point, 0, 1, {sighting.position, 0.0}};
    const LinearEdge linear = linearise(edge, pose(), {position(landmark), 0.0});
    Expectation result{-linear.residual.head<2>(), {}};
    result.jacobian.setZero(2, mean_.size());
    result.jacobian.leftCols<3>() = linear.by_from.topRows<2>();
    result.jacobian.middleCols<2>(at(landmark)) = linear.by_to.topLeftCorner<2, 2>();
    if (linear_) result.jacobian.col(2).setZero();
    return result;
  }

  [[nodiscard]] bool compatible(const LandmarkSighting& sighting, std::size_t landmark) const {
    const Expectation e = expect(sighting, landmark);
    const Eigen::Matrix2d s = e.jacobian * covariance_ * e.jacobian.transpose() + sighting.covariance;
    return e.innovation.dot(SmallCholesky<2>(s).solve(e.innovation)) <= squared_gate(options_.gate, 2);
  }

  /// Returns the sightings of landmarks in the map, and counts those refused. Sightings of other landmarks
  /// are left for add_new().
  std::vector<Pairing> associate(const std::vector<LandmarkSighting>& sightings, StepOutcome& outcome) {
    std::vector<Pairing> pairings =
        options_.unknown_ids ? associate_jointly(sightings) : associate_by_id(sightings);
    fresh_.assign(sightings.size(), true);
    for (const Pairing& pairing : pairings) fresh_[pairing.sighting] = false;
    if (options_.unknown_ids) {
      refuse_near_the_map(sightings, pairings, outcome);
    } else {
      refuse_known(sightings, outcome, !pairings.empty());
    }
    outcome.used = static_cast<int>(pairings.size());
    return pairings;
  }

  std::vector<Pairing> associate_by_id(const std::vector<LandmarkSighting>& sightings) {
    std::vector<Pairing> pairings;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      for (std::size_t k = 0; k < records_.size(); ++k) {
        if (sightings[i].id != records_[k].id || !compatible(sightings[i], k)) continue;
        pairings.push_back({i, k});
        records_[k].refused = 0;
      }
    }
    return pairings;
  }
  void refuse_known(const std::vector<LandmarkSighting>& sightings, StepOutcome& outcome, bool others_fit) {
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      if (!fresh_[i]) continue;
      for (LandmarkRecord& record : records_) {
        if (sightings[i].id != record.id) continue;
        fresh_[i] = false;
        ++outcome.refused;
        if (others_fit) ++record.refused;
      }
    }
  }

  std::vector<Pairing> associate_jointly(const std::vector<LandmarkSighting>& sightings) {
    std::vector<PossiblePair> pairs;
    std::vector<Eigen::Matrix<double, 2, Eigen::Dynamic>> jacobians;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      for (std::size_t k = 0; k < records_.size(); ++k) {
        if (!compatible(sightings[i], k)) continue;
        const Expectation e = expect(sightings[i], k);
        pairs.push_back({i, k, {e.innovation.x(), e.innovation.y()}});
        jacobians.push_back(e.jacobian);
      }
    }
    const auto n = static_cast<Index>(2 * pairs.size());
    Dense all(n, mean_.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
      all.middleRows(2 * static_cast<Index>(i), 2) = jacobians[i];
    Dense s = all * covariance_ * all.transpose();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto row = 2 * static_cast<Index>(i);
      s.block<2, 2>(row, row) += sightings[pairs[i].sighting].covariance;
    }
    std::vector<Pairing> pairings;
    for (const std::size_t i : joint_compatibility(pairs, s, options_.gate)) {
      pairings.push_back({pairs[i].sighting, pairs[i].landmark});
    }
    return pairings;
  }
  /// Without ids, refuses sightings that fit no landmark but lie near one that nothing else fits, because
  /// they are not new landmarks.
  void refuse_near_the_map(const std::vector<LandmarkSighting>& sightings,
                           const std::vector<Pairing>& pairings, StepOutcome& outcome) {
    std::vector<bool> taken(records_.size(), false);
    for (const Pairing& pairing : pairings) taken[pairing.landmark] = true;
    const Eigen::Matrix3d p = pose_covariance();
    const double slack = options_.patience_distance_m + 3.0 * std::sqrt(p(0, 0) + p(1, 1));
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const Vec2 world = pose() * sightings[i].position;
      for (std::size_t k = 0; fresh_[i] && k < records_.size(); ++k) {
        if (taken[k] || distance(world, position(k)) > slack) continue;
        fresh_[i] = false;
        ++outcome.refused;
      }
    }
  }

  void correct(const std::vector<LandmarkSighting>& sightings, const std::vector<Pairing>& pairings) {
    if (pairings.empty()) return;
    const auto n = static_cast<Index>(2 * pairings.size());
    Dense jacobian(n, mean_.size());
    Dense noise = Dense::Zero(n, n);
    Eigen::VectorXd innovation(n);
    for (std::size_t i = 0; i < pairings.size(); ++i) {
      const auto row = 2 * static_cast<Index>(i);
      const LandmarkSighting& sighting = sightings[pairings[i].sighting];
      const Expectation e = expect(sighting, pairings[i].landmark);
      jacobian.middleRows(row, 2) = e.jacobian;
      innovation.segment<2>(row) = e.innovation;
      noise.block<2, 2>(row, row) = sighting.covariance;
      ++records_[pairings[i].landmark].sightings;
    }
    const Dense cross = covariance_ * jacobian.transpose();
    const Dense s = jacobian * cross + noise;
    const Eigen::LLT<Dense> factor(s);
    const Dense gain = factor.solve(cross.transpose()).transpose();
    mean_ += gain * innovation;
    mean_(2) = wrap_angle(mean_(2));
    covariance_ -= gain * cross.transpose();
    covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
    cost_ += innovation.dot(factor.solve(innovation));
    corrections_ += static_cast<std::int64_t>(pairings.size());
  }

  void remove(std::size_t landmark) {
    const Index first = at(landmark), after = mean_.size() - first - 2;
    mean_.segment(first, after) = mean_.tail(after).eval();
    mean_.conservativeResize(first + after);
    covariance_.middleRows(first, after) = covariance_.bottomRows(after).eval();
    covariance_.middleCols(first, after) = covariance_.rightCols(after).eval();
    covariance_.conservativeResize(first + after, first + after);
    records_.erase(records_.begin() + static_cast<std::ptrdiff_t>(landmark));
  }
  void remove_gone(const std::vector<LandmarkSighting>& sightings, const std::vector<Pairing>& pairings,
                   StepOutcome& outcome) {
    std::set<std::size_t> seen;
    for (const Pairing& pairing : pairings) seen.insert(pairing.landmark);
    for (std::size_t k = records_.size(); k-- > 0;) {
      LandmarkRecord& record = records_[k];
      const Vec2 local = pose().to_local(position(k));
      if (seen.contains(k)) record.missed = 0;
      if (!seen.contains(k) && has_to_be_seen(local, options_) && !sightings.empty()) ++record.missed;
      if (record.refused < options_.patience + 2 && record.missed < options_.misses) continue;
      outcome.removed.push_back(record.id);
      outcome.contradicted += record.refused >= options_.patience + 2 ? 1 : 0;
      remove(k);
    }
  }

  void add_new(const std::vector<LandmarkSighting>& sightings, StepOutcome& outcome) {
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      if (!fresh_[i]) continue;
      const Vec2 world = pose() * sightings[i].position;
      const auto ready = memory_.remember(sightings[i], world, options_);
      outcome.waiting += ready ? 0 : 1;
      if (!ready) continue;
      add(sightings[i], ready->id);
      outcome.added.push_back(ready->id);
    }
  }
  /// Adds a landmark l = p + R z. Its covariance with the state follows from the Jacobians by pose and by z.
  void add(const LandmarkSighting& sighting, std::int64_t id) {
    const Pose2 from = pose();
    const Vec2 arm = rotated(from.heading_rad, sighting.position);
    const Index n = mean_.size();
    Eigen::Matrix<double, 2, 3> by_pose = lever_of(arm).topRows<2>();
    if (linear_) by_pose.col(2).setZero();
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(from.heading_rad).toRotationMatrix();
    const Eigen::Matrix<double, 2, Eigen::Dynamic> cross = by_pose * covariance_.topRows<3>();
    const Eigen::Matrix2d own =
        cross.leftCols<3>() * by_pose.transpose() + turn * sighting.covariance * turn.transpose();
    mean_.conservativeResize(n + 2);
    mean_.tail(2) << from.position.x + arm.x, from.position.y + arm.y;
    covariance_.conservativeResize(n + 2, n + 2);
    covariance_.bottomLeftCorner(2, n) = cross;
    covariance_.topRightCorner(n, 2) = cross.transpose();
    covariance_.bottomRightCorner(2, 2) = 0.5 * (own + own.transpose());
    records_.push_back({id, 1, 0, 0});
  }

  LandmarkSlamOptions options_;
  bool linear_;
  Eigen::VectorXd mean_;
  Dense covariance_;
  std::vector<LandmarkRecord> records_;
  double cost_ = 0.0;             ///< sum of the squared normalised innovations
  std::int64_t corrections_ = 0;  ///< sightings used
  Memory memory_;
  std::vector<Pose2> trajectory_;
  std::vector<bool> fresh_;  ///< by sighting of the step: it matches no landmark of the map
};

}  // namespace

std::unique_ptr<SlamEngine> make_filter_engine(const LandmarkSlamOptions& options, const Pose2& start) {
  return std::make_unique<FilterEngine>(options, start);
}

std::unique_ptr<SlamEngine> load_filter_engine(const LandmarkSlamOptions& options, StateReader& reader) {
  auto engine = std::make_unique<FilterEngine>(options, Pose2{});
  engine->exchange(reader);
  return reader.ok ? std::move(engine) : nullptr;
}

}  // namespace outrider
