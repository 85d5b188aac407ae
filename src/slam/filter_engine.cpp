#include <Eigen/Cholesky>
#include <algorithm>
#include <set>

#include "graph_edges.hpp"
#include "outrider/core/units.hpp"
#include "outrider/slam/joint_compatibility.hpp"
#include "slam_engine.hpp"

namespace outrider {
namespace {

using Dense = Eigen::MatrixXd;
using Index = Eigen::Index;

Index at(std::size_t landmark) { return 3 + 2 * static_cast<Index>(landmark); }

template <std::size_t Rows, std::size_t Columns>
Dense dense(const Matrix<Rows, Columns>& m) {
  Dense result(static_cast<Index>(Rows), static_cast<Index>(Columns));
  for (std::size_t i = 0; i < Rows; ++i) {
    for (std::size_t j = 0; j < Columns; ++j) result(static_cast<Index>(i), static_cast<Index>(j)) = m(i, j);
  }
  return result;
}

template <std::size_t N>
Matrix<N, N> block(const Dense& m, Index first) {
  Matrix<N, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j)
      result(i, j) = m(first + static_cast<Index>(i), first + static_cast<Index>(j));
  }
  return result;
}

/// The Kalman filters. The state is (x, y, heading of the robot, x, y of each landmark). In the linear one
/// the heading has no uncertainty, and so takes no correction.
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
  [[nodiscard]] Matrix3 pose_covariance() const override { return block<3>(covariance_, 0); }
  [[nodiscard]] LandmarkMap landmarks() const override {
    LandmarkMap map;
    for (std::size_t i = 0; i < records_.size(); ++i) {
      map.push_back({records_[i].id, position(i), block<2>(covariance_, at(i)), records_[i].sightings});
    }
    return map;
  }
  [[nodiscard]] std::vector<Pose2> trajectory() const override { return trajectory_; }
  [[nodiscard]] const LandmarkSlamOptions& options() const override { return options_; }
  void save(StateWriter& writer) const override {
    FilterEngine copy = *this;
    copy.exchange(writer);
  }

  template <class Archive>
  void exchange(Archive& archive) {
    std::vector<double> mean(mean_.data(), mean_.data() + mean_.size());
    std::vector<double> covariance(covariance_.data(), covariance_.data() + covariance_.size());
    archive(memory_, records_, trajectory_, mean, covariance);
    if constexpr (Archive::reading) {
      const std::size_t n = 3 + 2 * records_.size();
      archive.ok = archive.ok && mean.size() == n && covariance.size() == n * n;
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

  /// Smith, Self and Cheeseman: x' = x (+) u, with the Jacobians by x and by u.
  void predict(const LogStep& step) {
    const Pose2 before = pose();
    const Vec2 moved = rotated(before.heading_rad, step.odometry.position);
    Dense by_pose = Dense::Identity(3, 3);
    Dense by_motion = Dense::Identity(3, 3);
    by_motion.topLeftCorner(2, 2) = dense(rotation2(before.heading_rad));
    by_pose(0, 2) = -moved.y;
    by_pose(1, 2) = moved.x;
    if (linear_) by_motion(2, 2) = 0.0;
    const Pose2 after = composed(before, step.odometry);
    mean_.head(3) << after.position.x, after.position.y, after.heading_rad;
    const Index rest = covariance_.rows() - 3;
    covariance_.topLeftCorner(3, 3) = (by_pose * covariance_.topLeftCorner(3, 3) * by_pose.transpose() +
                                       by_motion * dense(step.covariance) * by_motion.transpose())
                                          .eval();
    covariance_.topRightCorner(3, rest) = (by_pose * covariance_.topRightCorner(3, rest)).eval();
    covariance_.bottomLeftCorner(rest, 3) = covariance_.topRightCorner(3, rest).transpose();
  }

  /// The sighting less what is expected, and the Jacobian of the expectation by the whole state.
  struct Expectation {
    Vec2 innovation;
    Dense jacobian;
  };
  [[nodiscard]] Expectation expect(const LandmarkSighting& sighting, std::size_t landmark) const {
    const GraphEdge edge{EdgeKind::point, 0, 1, {sighting.position, 0.0}, {}};
    const LinearEdge linear = linearised(edge, pose(), {position(landmark), 0.0});
    Dense jacobian = Dense::Zero(2, mean_.size());
    jacobian.leftCols(3) = dense(linear.by_from).topRows(2);
    jacobian.middleCols(at(landmark), 2) = dense(linear.by_to).topLeftCorner(2, 2);
    if (linear_) jacobian.col(2).setZero();
    return {{-linear.residual[0], -linear.residual[1]}, jacobian};
  }

  [[nodiscard]] bool compatible(const LandmarkSighting& sighting, std::size_t landmark) const {
    const Expectation e = expect(sighting, landmark);
    const Dense s = e.jacobian * covariance_ * e.jacobian.transpose() + dense(sighting.covariance);
    const Eigen::Vector2d v(e.innovation.x, e.innovation.y);
    return v.dot(s.llt().solve(v)) <= squared_gate(options_.gate, 2);
  }

  /// The sightings of landmarks in the map; counts those refused. Those of no landmark are left for
  /// add_new().
  std::vector<Pairing> associate(const std::vector<LandmarkSighting>& sightings, StepOutcome& outcome) {
    std::vector<Pairing> pairings =
        options_.unknown_ids ? associate_jointly(sightings) : associate_by_id(sightings);
    fresh_.assign(sightings.size(), true);
    for (const Pairing& pairing : pairings) fresh_[pairing.sighting] = false;
    if (options_.unknown_ids) {
      refuse_near_the_map(sightings, outcome);
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
    std::vector<Dense> jacobians;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      for (std::size_t k = 0; k < records_.size(); ++k) {
        if (!compatible(sightings[i], k)) continue;
        const Expectation e = expect(sightings[i], k);
        pairs.push_back({i, k, e.innovation});
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
      s.block(row, row, 2, 2) += dense(sightings[pairs[i].sighting].covariance);
    }
    std::vector<Pairing> pairings;
    const std::vector<double> covariance(s.data(), s.data() + s.size());
    for (const std::size_t i : joint_compatibility(pairs, covariance, options_.gate)) {
      pairings.push_back({pairs[i].sighting, pairs[i].landmark});
    }
    return pairings;
  }
  /// Without ids, a sighting that fits no landmark but lies near one is no new landmark either; and where
  /// none of several fits, the robot may be elsewhere.
  void refuse_near_the_map(const std::vector<LandmarkSighting>& sightings, StepOutcome& outcome) {
    const Matrix3 p = pose_covariance();
    const double slack = options_.patience_distance_m + 3.0 * std::sqrt(p(0, 0) + p(1, 1));
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      const Vec2 world = composed(pose(), {sightings[i].position, 0.0}).position;
      for (std::size_t k = 0; fresh_[i] && k < records_.size(); ++k) {
        if (distance(world, position(k)) > slack) continue;
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
      innovation.segment(row, 2) << e.innovation.x, e.innovation.y;
      noise.block(row, row, 2, 2) = dense(sighting.covariance);
      ++records_[pairings[i].landmark].sightings;
    }
    const Dense cross = covariance_ * jacobian.transpose();
    const Dense s = jacobian * cross + noise;
    const Dense gain = s.llt().solve(cross.transpose()).transpose();
    mean_ += gain * innovation;
    mean_(2) = wrap_angle(mean_(2));
    covariance_ -= gain * cross.transpose();
    covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
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
      const Vec2 local = unrotated(pose().heading_rad, position(k) - pose().position);
      if (seen.contains(k)) record.missed = 0;
      if (!seen.contains(k) && has_to_be_seen(local, options_) && !sightings.empty()) ++record.missed;
      if (record.refused < options_.patience + 2 && record.missed < options_.misses) continue;
      outcome.removed.push_back(record.id);
      remove(k);
    }
  }

  void add_new(const std::vector<LandmarkSighting>& sightings, StepOutcome& outcome) {
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      if (!fresh_[i]) continue;
      const Vec2 world = composed(pose(), {sightings[i].position, 0.0}).position;
      const auto ready = memory_.remember(sightings[i], world, options_);
      outcome.waiting += ready ? 0 : 1;
      if (!ready) continue;
      add(sightings[i], ready->id);
      outcome.added.push_back(ready->id);
    }
  }
  /// l = p + R z: its covariance with the state follows from the Jacobians by pose and by z.
  void add(const LandmarkSighting& sighting, std::int64_t id) {
    const Pose2 from = pose();
    const Vec2 arm = rotated(from.heading_rad, sighting.position);
    const Index n = mean_.size();
    Dense by_pose = Dense::Zero(2, 3);
    by_pose << 1.0, 0.0, -arm.y, 0.0, 1.0, arm.x;
    if (linear_) by_pose.col(2).setZero();
    const Dense turn = dense(rotation2(from.heading_rad));
    const Dense cross = by_pose * covariance_.topRows(3);
    const Dense own =
        cross.leftCols(3) * by_pose.transpose() + turn * dense(sighting.covariance) * turn.transpose();
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
  Memory memory_;
  std::vector<Pose2> trajectory_;
  std::vector<bool> fresh_;  ///< by sighting of the step: of no landmark in the map
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
