#include "outrider/jobs/guard/rigid_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <ignition/common/Console.hh>
#include <ignition/common/Mesh.hh>
#include <ignition/common/SubMesh.hh>
#include <ignition/physics.hh>
#include <ignition/physics/mesh/MeshShape.hh>
#include <ignition/physics/sdf/ConstructModel.hh>
#include <ignition/physics/sdf/ConstructWorld.hh>
#include <ignition/plugin/Loader.hh>
#include <limits>
#include <map>
#include <optional>
#include <sdf/sdf.hh>
#include <set>
#include <stdexcept>

#include "rigid_robot.hpp"

namespace outrider {
namespace {

namespace physics = ignition::physics;

struct Features
    : physics::FeatureList<physics::ForwardStep, physics::GetContactsFromLastStepFeature,
                           physics::LinkFrameSemantics, physics::GetEntities, physics::RemoveEntities,
                           physics::FindFreeGroupFeature, physics::SetFreeGroupWorldVelocity,
                           physics::SetJointVelocityCommandFeature, physics::CollisionFilterMaskFeature,
                           physics::sdf::ConstructSdfWorld, physics::sdf::ConstructSdfModel,
                           physics::mesh::AttachMeshShapeFeature> {};
using ContactPoint = physics::World3d<Features>::ContactPoint;

constexpr double floor_contact_m = 1e-3;

Vec3 vec(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Eigen::Isometry3d isometry(const Pose3& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  const auto column = [](Vec3 v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  for (int i = 0; i < 3; ++i)
    result.linear().col(i) = column(pose.rotation.axes[static_cast<std::size_t>(i)]);
  result.translation() = column(pose.position);
  return result;
}

ignition::math::Pose3d sdf_pose(const Pose3& pose) {
  const auto& [x, y, z] = pose.rotation.axes;
  const ignition::math::Matrix3d matrix(x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z);
  return {{pose.position.x, pose.position.y, pose.position.z}, ignition::math::Quaterniond(matrix)};
}

/// Nothing for a shape that SDF text cannot give the engine.
std::optional<sdf::Geometry> sdf_geometry(const Shape& shape) {
  sdf::Geometry geometry;
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    sdf::Box its;
    its.SetSize({2.0 * box->half_size.x, 2.0 * box->half_size.y, 2.0 * box->half_size.z});
    geometry.SetType(sdf::GeometryType::BOX);
    geometry.SetBoxShape(its);
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    sdf::Cylinder its;
    its.SetRadius(cylinder->radius_m);
    its.SetLength(2.0 * cylinder->half_length_m);
    geometry.SetType(sdf::GeometryType::CYLINDER);
    geometry.SetCylinderShape(its);
  } else if (const auto* sphere = std::get_if<SphereShape>(&shape)) {
    sdf::Sphere its;
    its.SetRadius(sphere->radius_m);
    geometry.SetType(sdf::GeometryType::SPHERE);
    geometry.SetSphereShape(its);
  } else if (std::holds_alternative<HalfSpaceShape>(shape)) {
    geometry.SetType(sdf::GeometryType::PLANE);
    geometry.SetPlaneShape({});
  } else {
    return {};
  }
  return geometry;
}

/// Every triangle from both sides: the engine lets balls through from behind.
ignition::common::SubMesh two_sided(const MeshShape& shape) {
  ignition::common::SubMesh surface("surface");
  surface.SetPrimitiveType(ignition::common::SubMesh::TRIANGLES);
  unsigned index = 0;
  const auto add = [&](Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 normal = cross(b - a, c - a);
    for (const Vec3 p : {a, b, c}) {
      surface.AddVertex(p.x, p.y, p.z);
      surface.AddNormal(normal.x, normal.y, normal.z);
      surface.AddIndex(index++);
    }
  };
  for (const auto& [a, b, c] : shape.triangles) {
    add(a, b, c);
    add(a, c, b);
  }
  return surface;
}

/// The fixed bodies that SDF can describe; meshes and other shapes are left out.
sdf::Model fixed_bodies(const std::vector<Solid>& bodies) {
  sdf::Link link;
  link.SetName("bodies");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto geometry = sdf_geometry(bodies[i].shape);
    if (!geometry) continue;
    sdf::Collision collision;
    collision.SetName(std::to_string(i));
    collision.SetRawPose(sdf_pose(bodies[i].world_T_solid));
    collision.SetGeom(*geometry);
    link.AddCollision(collision);
  }
  sdf::Model model;
  model.SetName("yard");
  model.SetStatic(true);
  model.AddLink(link);
  return model;
}

sdf::Model model_of(const std::string& text) {
  sdf::Root root;
  if (!root.LoadSdfString(text).empty() || root.Model() == nullptr) {
    throw std::logic_error("our own SDF is refused: " + text);
  }
  return *root.Model();
}

// ---- The engine ----------------------------------------------------------------------------------

class Gazebo final : public RigidWorld {
 public:
  explicit Gazebo(const GuardProblem& problem) : problem_(problem) {
    bodies_ = problem.world.solids;
    for (const Target& target : problem.targets) bodies_.push_back(solid_of(target));
  }

  Status load() {
    const std::string library =
        std::string(IGNITION_PHYSICS_ENGINE_INSTALL_DIR) + "/libignition-physics5-dartsim-plugin.so.5";
    constexpr const char* remedy = "install the package libignition-physics5-dartsim-plugin5";
    if (!std::filesystem::exists(library))
      return bad_input(fmt::format("the physics engine {} is missing; {}", library, remedy), "sim");
    ignition::common::Console::SetVerbosity(0);  // what is wrong is told here, in a sentence
    loader_.LoadLib(library);
    engine_ =
        physics::RequestEngine3d<Features>::From(loader_.Instantiate("ignition::physics::dartsim::Plugin"));
    if (engine_ == nullptr)
      return bad_input(fmt::format("the physics engine {} cannot be loaded; {} anew", library, remedy),
                       "sim");
    return {};
  }

  Status build() {
    sdf::World world;
    world.SetName("yard");
    world.SetGravity({0.0, 0.0, -problem_.world.gravity_mps2});
    world.AddModel(fixed_bodies(bodies_));
    world_ = engine_->ConstructWorld(world);
    fixed_ = world_->GetModel(0)->GetLink(0);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (auto named = name_shape(i); !named) return named;
    }
    robot_ =
        world_->ConstructModel(model_of(robot_sdf(problem_.robot, problem_.start, problem_.world.floor_z_m)));
    chassis_ = robot_->GetLink("chassis");
    left_ = robot_->GetJoint("left_wheel");
    right_ = robot_->GetJoint("right_wheel");
    for (std::size_t i = 0; i < robot_->GetLinkCount(); ++i) {
      const auto link = robot_->GetLink(i);
      for (std::size_t k = 0; k < link->GetShapeCount(); ++k) {
        robot_shapes_.insert(link->GetShape(k)->EntityID());
      }
    }
    return {};
  }

  void turn_wheels(const WheelSpeeds& speeds) override { speeds_ = speeds; }

  void step(double period_s) override {
    left_->SetVelocityCommand(0, speeds_.left_radps);
    right_->SetVelocityCommand(0, speeds_.right_radps);
    physics::ForwardStep::Input input;
    input.Get<std::chrono::nanoseconds>() = std::chrono::nanoseconds(std::llround(1e9 * period_s));
    world_->Step(output_, state_, input);
    note_contacts();
  }

  [[nodiscard]] Pose3 world_T_robot() const override {
    const auto pose = chassis_->FrameDataRelativeToWorld().pose;
    return {vec(pose.translation()),
            {{vec(pose.linear().col(0)), vec(pose.linear().col(1)), vec(pose.linear().col(2))}}};
  }

  [[nodiscard]] std::vector<std::size_t> touched_by_robot() const override {
    const double floor = problem_.world.floor_z_m + floor_contact_m;
    return touched_by([&](std::size_t shape) { return robot_shapes_.contains(shape); }, floor);
  }

  [[nodiscard]] Vec3 velocity_at(Vec3 point) const override {
    const auto frame = chassis_->FrameDataRelativeToWorld();
    const Vec3 arm = point - vec(frame.pose.translation());
    return vec(frame.linearVelocity) + cross(vec(frame.angularVelocity), arm);
  }

  std::optional<std::size_t> throw_ball(const Flight& flight, std::size_t target) override {
    std::size_t number = 0;
    while (number < balls_.size() && balls_[number].model != nullptr) ++number;
    if (number == balls_.size()) return std::nullopt;
    Ball& ball = balls_[number];
    ball.model =
        world_->ConstructModel(model_of(ball_sdf(number, flight.muzzle, problem_.gun.ball_radius_m)));
    ball.link = ball.model->GetLink(0);
    ball.target = target;
    const Vec3 v = flight.velocity_mps;
    ball.model->FindFreeGroup()->SetWorldLinearVelocity(Eigen::Vector3d(v.x, v.y, v.z));
    show_to_balls(target);
    return number;
  }

  void remove_ball(std::size_t ball) override {
    Ball& its = balls_[ball];
    its.model->Remove();
    its.model = nullptr;  // only nullptr empties it: an empty pointer assigned leaves it as it is
    its.link = nullptr;
    show_to_balls(its.target);
  }

  [[nodiscard]] Vec3 ball(std::size_t ball) const override {
    return vec(balls_[ball].link->FrameDataRelativeToWorld().pose.translation());
  }

  [[nodiscard]] std::vector<std::size_t> touched_by_ball(std::size_t ball) const override {
    const std::size_t its = balls_[ball].link->GetShape(0)->EntityID();
    return touched_by([&](std::size_t shape) { return shape == its; },
                      -std::numeric_limits<double>::infinity());
  }

 private:
  /// Finds the shape of a body, makes it when it is a mesh, says what feels it, and remembers which body it
  /// is.
  Status name_shape(std::size_t body) {
    const Solid& solid = bodies_[body];
    const std::string name = std::to_string(body);
    if (const auto* mesh = std::get_if<MeshShape>(&solid.shape)) {
      ignition::common::Mesh surface;
      surface.AddSubMesh(two_sided(*mesh));
      fixed_->AttachMeshShape(name, surface, isometry(solid.world_T_solid));
    }
    const auto shape = fixed_->GetShape(name);
    if (shape == nullptr) {
      return bad_input(fmt::format("'{}' is a {}, which the physics engine is not given; take 'kinematic'",
                                   solid.name, kind(solid.shape)),
                       "sim");
    }
    const bool felt = body < problem_.world.solids.size() || problem_.targets_block;
    shape->SetCollisionFilterMask(felt ? felt_by_all : felt_by_nothing);
    shapes_.push_back(shape);
    body_of_[shape->EntityID()] = body;
    return {};
  }

  /// Lets a target that does not block feel the balls that were thrown at it.
  void show_to_balls(std::size_t target) {
    if (problem_.targets_block) return;
    FeltBy mask = felt_by_nothing;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      if (balls_[i].model != nullptr && balls_[i].target == target) mask |= felt_by_ball(i);
    }
    shapes_[problem_.world.solids.size() + target]->SetCollisionFilterMask(mask);
  }

  /// Keeps the contacts of the last step. The engine itself knows them only until a ball is removed.
  void note_contacts() {
    contacts_.clear();
    for (const auto& contact : world_->GetContactsFromLastStep()) {
      const ContactPoint& at = contact.Get<ContactPoint>();
      contacts_.push_back({at.collision1->EntityID(), at.collision2->EntityID(), at.point.z()});
    }
  }

  /// The bodies that touched one of those shapes above a height.
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

  GuardProblem problem_;
  std::vector<Solid> bodies_;
  ignition::plugin::Loader loader_;  // outlives everything of the engine
  physics::Engine3dPtr<Features> engine_;
  physics::World3dPtr<Features> world_;
  physics::Link3dPtr<Features> fixed_;
  std::vector<physics::Shape3dPtr<Features>> shapes_;  // by body
  std::map<std::size_t, std::size_t> body_of_;         // by the engine's number of the shape
  physics::Model3dPtr<Features> robot_;
  physics::Link3dPtr<Features> chassis_;
  physics::Joint3dPtr<Features> left_;
  physics::Joint3dPtr<Features> right_;
  std::set<std::size_t> robot_shapes_;
  struct Ball {
    physics::Model3dPtr<Features> model;  // null: none
    physics::Link3dPtr<Features> link;
    std::size_t target = 0;
  };
  std::array<Ball, most_balls> balls_;
  struct Contact {
    std::size_t first;  // the engine's numbers of both shapes
    std::size_t second;
    double z_m;
  };
  std::vector<Contact> contacts_;
  WheelSpeeds speeds_;
  physics::ForwardStep::Output output_;
  physics::ForwardStep::State state_;
};

}  // namespace

Outcome<std::unique_ptr<RigidWorld>> make_rigid_world(const GuardProblem& problem) {
  auto world = std::make_unique<Gazebo>(problem);
  if (auto loaded = world->load(); !loaded) return pass_on(loaded);
  if (auto built = world->build(); !built) return pass_on(built);
  return world;
}

}  // namespace outrider
