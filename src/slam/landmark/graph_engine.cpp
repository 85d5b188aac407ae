#include <algorithm>
#include <limits>

#include "algebra/small_cholesky.hpp"
#include "graph/growing_graph.hpp"
#include "landmark/slam_engine.hpp"
#include "outrider/slam/landmark/joint_compatibility.hpp"

namespace outrider {
namespace {

class GraphEngine : public SlamEngine {
 public:
  GraphEngine(LandmarkSlamOptions options, const Pose2& start)
      : options_(std::move(options)), graph_(options_.kernel, options_.kernel_width) {
    poses_.push_back(graph_.add_node(start, false));
  }

  StepOutcome advance(const LogStep& step) override {
    ++memory_.step;
    const std::uint32_t before = poses_.back();
    poses_.push_back(graph_.add_node(wrap_heading(compose(graph_.estimate(before), step.odometry)), false));
    graph_.add_edge(EdgeKind::pose, before, poses_.back(), step.odometry, step.covariance);
    has_present_pose_ = false;
    StepOutcome outcome;
    const std::vector<Match> matches = match(step.sightings, outcome);
    note_fit(memory_, outcome);
    for (const Match& found : matches) use(poses_.back(), *found.sighting, landmarks_[found.landmark]);
    outcome.lost = memory_.lost(options_);
    if (!outcome.lost) {
      remove_gone(step.sightings, matches, outcome);
      add_new(step.sightings, outcome);
    }
    graph_.update(options_.relinearise);
    if (memory_.step % options_.reorder_every == 0) graph_.reorder(poses_.back());
    return outcome;
  }
  void settle() override {
    graph_.reorder(poses_.back());
    graph_.settle();
  }

  [[nodiscard]] Pose2 pose() const override { return graph_.estimate(poses_.back()); }
  [[nodiscard]] Eigen::Matrix3d pose_covariance() const override { return graph_.covariance(poses_.back()); }
  [[nodiscard]] LandmarkMap landmarks() const override {
    LandmarkMap map;
    if (landmarks_.empty()) return map;
    const std::vector<Eigen::Matrix3d> covariances = graph_.covariances();
    for (const Landmark& landmark : landmarks_) {
      const Eigen::Matrix3d& c = covariances[landmark.node];
      map.push_back({landmark.record.id, graph_.estimate(landmark.node).position, c.topLeftCorner<2, 2>(),
                     landmark.record.sightings});
    }
    return map;
  }
  [[nodiscard]] std::vector<Pose2> trajectory() const override {
    std::vector<Pose2> result;
    for (const std::uint32_t node : poses_) result.push_back(graph_.estimate(node));
    return result;
  }
  [[nodiscard]] double cost() const override { return graph_.cost(); }
  [[nodiscard]] std::int64_t degrees_of_freedom() const override { return graph_.degrees_of_freedom(); }
  [[nodiscard]] const LandmarkSlamOptions& options() const override { return options_; }
  void save(StateWriter& writer) const override {
    GraphEngine copy = *this;
    copy.exchange(writer);
  }

  template <class Archive>
  void exchange(Archive& archive) {
    archive(memory_, landmarks_, poses_, graph_);
  }
  /// Returns true if poses, landmarks and candidates are consistent with the graph.
  [[nodiscard]] bool sound() const {
    const auto steps = static_cast<std::int64_t>(poses_.size()) - 1;
    const auto known = [&](std::int64_t step) { return step >= 0 && step <= steps; };
    return steps == memory_.step && steps >= 0 && poses_.front() == 0 && graph_.is_pose(poses_) &&
           std::all_of(landmarks_.begin(), landmarks_.end(),
                       [&](const Landmark& landmark) { return graph_.is_point(landmark.node); }) &&
           std::all_of(memory_.candidates.begin(), memory_.candidates.end(), [&](const Candidate& candidate) {
             return candidate.steps.size() == candidate.sightings.size() &&
                    std::all_of(candidate.steps.begin(), candidate.steps.end(), known);
           });
  }

 private:
  struct Landmark {
    LandmarkRecord record;
    std::uint32_t node = 0;
    template <class Archive>
    void exchange(Archive& archive) {
      archive(record, node);
    }
  };
  struct Match {
    const LandmarkSighting* sighting = nullptr;
    std::size_t landmark = 0;
  };

  std::size_t find(std::int64_t id) const {
    const auto found = std::find_if(landmarks_.begin(), landmarks_.end(),
                                    [&](const Landmark& landmark) { return landmark.record.id == id; });
    return static_cast<std::size_t>(found - landmarks_.begin());
  }

  /// Tests a sighting. Computes the covariance of the prediction only if that of the sighting does not
  /// explain the residual.
  [[nodiscard]] bool compatible(const LandmarkSighting& sighting, const Landmark& landmark) {
    const GraphEdge edge{EdgeKind::point, 0, 1, {sighting.position, 0.0}};
    const Eigen::Vector3d r = residual(edge, graph_.estimate(poses_.back()), graph_.estimate(landmark.node));
    const double gate = squared_gate(options_.gate, 2);
    const auto far = [&](const Eigen::Matrix2d& covariance) {
      const SmallCholesky<2> factor(covariance);
      return factor.is_positive() && r.head<2>().dot(factor.solve(r.head<2>())) > gate;
    };
    if (!far(sighting.covariance)) return true;
    if (!has_present_pose_) graph_.update(std::numeric_limits<double>::infinity());
    has_present_pose_ = true;
    return !far(sighting.covariance + graph_.relative_covariance(poses_.back(), landmark.node));
  }

  std::vector<Match> match(const std::vector<LandmarkSighting>& sightings, StepOutcome& outcome) {
    std::vector<Match> matches;
    std::vector<std::size_t> refused;
    for (const LandmarkSighting& sighting : sightings) {
      const std::size_t landmark = find(*sighting.id);
      if (landmark == landmarks_.size()) continue;
      if (compatible(sighting, landmarks_[landmark])) {
        matches.push_back({&sighting, landmark});
        landmarks_[landmark].record.refused = 0;
      } else {
        refused.push_back(landmark);
      }
    }
    for (const std::size_t landmark : refused) landmarks_[landmark].record.refused += matches.empty() ? 0 : 1;
    outcome.used = static_cast<int>(matches.size());
    outcome.refused = static_cast<int>(refused.size());
    return matches;
  }

  void use(std::uint32_t pose, const LandmarkSighting& sighting, Landmark& landmark) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    covariance.topLeftCorner<2, 2>() = sighting.covariance;
    graph_.add_edge(EdgeKind::point, pose, landmark.node, {sighting.position, 0.0}, covariance);
    ++landmark.record.sightings;
  }

  /// Removes landmarks from the map. Their nodes stay in the graph; later sightings make new ones.
  void remove_gone(const std::vector<LandmarkSighting>& sightings, const std::vector<Match>& matches,
                   StepOutcome& outcome) {
    const Pose2 here = graph_.estimate(poses_.back());
    for (const Match& found : matches) landmarks_[found.landmark].record.missed = -1;
    std::erase_if(landmarks_, [&](Landmark& landmark) {
      LandmarkRecord& record = landmark.record;
      const Vec2 local = here.to_local(graph_.estimate(landmark.node).position);
      const bool missed = record.missed >= 0 && !sightings.empty() && has_to_be_seen(local, options_);
      if (missed || record.missed < 0) ++record.missed;
      const bool gone = record.refused >= options_.patience + 2 || record.missed >= options_.misses;
      if (gone) outcome.removed.push_back(record.id);
      outcome.contradicted += record.refused >= options_.patience + 2 ? 1 : 0;
      return gone;
    });
  }

  /// Adds the candidates with enough sightings, with all their sightings from the earlier poses.
  void add_new(const std::vector<LandmarkSighting>& sightings, StepOutcome& outcome) {
    for (const LandmarkSighting& sighting : sightings) {
      if (find(*sighting.id) != landmarks_.size()) continue;
      const Vec2 world = graph_.estimate(poses_.back()) * sighting.position;
      const auto ready = memory_.remember(sighting, world, options_);
      outcome.waiting += ready ? 0 : 1;
      if (!ready) continue;
      landmarks_.push_back({{ready->id, 0, 0, 0}, graph_.add_node({world, 0.0}, true)});
      for (std::size_t i = 0; i < ready->steps.size(); ++i) {
        use(poses_[static_cast<std::size_t>(ready->steps[i])], ready->sightings[i], landmarks_.back());
      }
      outcome.added.push_back(ready->id);
    }
  }

  LandmarkSlamOptions options_;
  GrowingGraph graph_;
  Memory memory_;
  std::vector<Landmark> landmarks_;
  std::vector<std::uint32_t> poses_;  ///< node of each step; the first is the start
  bool has_present_pose_ = false;     ///< the factor contains the present pose
};

}  // namespace

std::unique_ptr<SlamEngine> make_graph_engine(const LandmarkSlamOptions& options, const Pose2& start) {
  return std::make_unique<GraphEngine>(options, start);
}

std::unique_ptr<SlamEngine> load_graph_engine(const LandmarkSlamOptions& options, StateReader& reader) {
  auto engine = std::make_unique<GraphEngine>(options, Pose2{});
  engine->exchange(reader);
  return reader.ok && engine->sound() ? std::move(engine) : nullptr;
}

}  // namespace outrider
