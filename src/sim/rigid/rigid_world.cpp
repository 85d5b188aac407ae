#include "outrider/sim/rigid/rigid_world.hpp"

#include <algorithm>
#include <array>
#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Joint.hpp>
#include <dart/simulation/World.hpp>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "rigid/rigid_bodies.hpp"

namespace outrider {
namespace {

using dart::collision::CollisionObject;
using dart::dynamics::BodyNode;
using dart::dynamics::ShapeFrame;

constexpr double floor_contact_m = 1e-3;

Vec3 vec(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Lets shapes collide whose masks share a bit, and that the engine itself does not ignore.
class MaskFilter final : public dart::collision::BodyNodeCollisionFilter {
 public:
  void set(const ShapeFrame* shape, CollisionMask mask) { masks_[shape] = mask; }
  void forget(const ShapeFrame* shape) { masks_.erase(shape); }

  bool ignoresCollision(const CollisionObject* first, const CollisionObject* second) const override {
    const int shared = masks_.at(first->getShapeFrame()) & masks_.at(second->getShapeFrame());
    return shared == 0 || BodyNodeCollisionFilter::ignoresCollision(first, second);
  }

 private:
  std::map<const ShapeFrame*, CollisionMask> masks_;
};

class DartWorld final : public RigidWorld {
 public:
  explicit DartWorld(const RigidScene& scene) : scene_(scene) {
    world_->setGravity({0.0, 0.0, -scene.world.gravity_mps2});
    auto& solver = *world_->getConstraintSolver();
    solver.setCollisionDetector(dart::collision::OdeCollisionDetector::create());
    solver.getCollisionOption().collisionFilter = filter_;
  }

  Status build() {
    std::vector<Solid> bodies = scene_.world.solids;
    for (const Target& target : scene_.targets) bodies.push_back(solid_of(target));
    auto yard = rigid_yard(bodies);
    if (!yard) return pass_on(yard);
    shapes_ = shapes_of(**yard);
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      const bool felt = i < scene_.world.solids.size() || scene_.targets_block;
      filter_->set(shapes_[i], felt ? mask_of_all : mask_of_none);
      body_of_[shapes_[i]] = i;
    }
    world_->addSkeleton(*yard);

    robot_ = rigid_robot(scene_.robot, scene_.start, scene_.world.floor_z_m);
    for (const ShapeFrame* shape : shapes_of(*robot_)) {
      filter_->set(shape, robot_mask);
      robot_shapes_.insert(shape);
    }
    chassis_ = robot_->getBodyNode("chassis");
    left_ = robot_->getJoint("left_wheel");
    right_ = robot_->getJoint("right_wheel");
    world_->addSkeleton(robot_);
    return {};
  }

  void turn_wheels(const WheelSpeeds& speeds) override { speeds_ = speeds; }

  void step(double period_s) override {
    left_->setCommand(0, speeds_.left_radps);
    right_->setCommand(0, speeds_.right_radps);
    if (world_->getTimeStep() != period_s) world_->setTimeStep(period_s);
    world_->step();
    note_contacts();
  }

  [[nodiscard]] Pose3 world_T_robot() const override {
    const Eigen::Isometry3d& pose = chassis_->getWorldTransform();
    return {vec(pose.translation()),
            {{vec(pose.linear().col(0)), vec(pose.linear().col(1)), vec(pose.linear().col(2))}}};
  }

  [[nodiscard]] std::vector<std::size_t> touched_by_robot() const override {
    const double floor = scene_.world.floor_z_m + floor_contact_m;
    return touched_by([&](const ShapeFrame* shape) { return robot_shapes_.contains(shape); }, floor);
  }

  [[nodiscard]] Vec3 velocity_at(Vec3 point) const override {
    const Vec3 arm = point - vec(chassis_->getWorldTransform().translation());
    return vec(chassis_->getLinearVelocity()) + cross(vec(chassis_->getAngularVelocity()), arm);
  }

  std::optional<std::size_t> throw_ball(const Flight& flight, std::size_t target) override {
    const auto free = std::ranges::find_if(balls_, [](const Ball& ball) { return ball.skeleton == nullptr; });
    if (free == balls_.end()) return std::nullopt;
    const auto number = static_cast<std::size_t>(free - balls_.begin());
    *free = {rigid_ball(number, flight.muzzle, scene_.ball_radius_m, flight.velocity_mps), target};
    filter_->set(free->shape(), ball_mask(number));
    world_->addSkeleton(free->skeleton);
    show_to_balls(target);
    return number;
  }

  void remove_ball(std::size_t ball) override {
    Ball& its = balls_[ball];
    world_->removeSkeleton(its.skeleton);
    filter_->forget(its.shape());
    its.skeleton = nullptr;
    show_to_balls(its.target);
  }

  [[nodiscard]] Vec3 ball(std::size_t ball) const override {
    return vec(balls_[ball].skeleton->getBodyNode(0)->getWorldTransform().translation());
  }

  [[nodiscard]] std::vector<std::size_t> touched_by_ball(std::size_t ball) const override {
    const ShapeFrame* its = balls_[ball].shape();
    return touched_by([&](const ShapeFrame* shape) { return shape == its; },
                      -std::numeric_limits<double>::infinity());
  }

 private:
  static std::vector<const ShapeFrame*> shapes_of(const dart::dynamics::Skeleton& skeleton) {
    std::vector<const ShapeFrame*> shapes;
    for (const BodyNode* body : skeleton.getBodyNodes()) {
      for (std::size_t i = 0; i < body->getNumShapeNodes(); ++i) shapes.push_back(body->getShapeNode(i));
    }
    return shapes;
  }

  /// Lets a target that does not block feel the balls that were thrown at it.
  void show_to_balls(std::size_t target) {
    if (scene_.targets_block) return;
    CollisionMask mask = mask_of_none;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      if (balls_[i].skeleton != nullptr && balls_[i].target == target) mask |= ball_mask(i);
    }
    filter_->set(shapes_[scene_.world.solids.size() + target], mask);
  }

  /// Keeps the contacts of the last step, which the engine forgets when a ball is removed.
  void note_contacts() {
    contacts_.clear();
    for (const auto& contact : world_->getLastCollisionResult().getContacts()) {
      contacts_.push_back({contact.collisionObject1->getShapeFrame(),
                           contact.collisionObject2->getShapeFrame(), contact.point.z()});
    }
  }

  /// Returns the bodies that touched one of those shapes above a height.
  template <class IsMine>
  [[nodiscard]] std::vector<std::size_t> touched_by(IsMine is_mine, double above_z_m) const {
    std::set<std::size_t> touched;
    for (const auto& [first, second, z_m] : contacts_) {
      if (z_m <= above_z_m) continue;
      if (is_mine(first) && body_of_.contains(second)) touched.insert(body_of_.at(second));
      if (is_mine(second) && body_of_.contains(first)) touched.insert(body_of_.at(first));
    }
    return {touched.begin(), touched.end()};
  }

  RigidScene scene_;
  std::shared_ptr<MaskFilter> filter_ = std::make_shared<MaskFilter>();
  dart::simulation::WorldPtr world_ = dart::simulation::World::create("yard");
  std::vector<const ShapeFrame*> shapes_;  // by body
  std::map<const ShapeFrame*, std::size_t> body_of_;
  dart::dynamics::SkeletonPtr robot_;
  BodyNode* chassis_ = nullptr;
  dart::dynamics::Joint* left_ = nullptr;
  dart::dynamics::Joint* right_ = nullptr;
  std::set<const ShapeFrame*> robot_shapes_;
  struct Ball {
    dart::dynamics::SkeletonPtr skeleton;  // null: none
    std::size_t target = 0;
    [[nodiscard]] const ShapeFrame* shape() const { return skeleton->getBodyNode(0)->getShapeNode(0); }
  };
  std::array<Ball, most_balls> balls_;
  struct Contact {
    const ShapeFrame* first;
    const ShapeFrame* second;
    double z_m;
  };
  std::vector<Contact> contacts_;
  WheelSpeeds speeds_;
};

}  // namespace

Outcome<std::unique_ptr<RigidWorld>> make_rigid_world(const RigidScene& scene) {
  auto world = std::make_unique<DartWorld>(scene);
  if (auto built = world->build(); !built) return pass_on(built);
  return world;
}

}  // namespace outrider
