#include "rigid/rigid_bodies.hpp"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/CylinderShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/MeshShape.hpp>
#include <dart/dynamics/PlaneShape.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <memory>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "outrider/sim/bodies/wheels.hpp"

namespace outrider {
namespace {

namespace dd = dart::dynamics;

constexpr double chassis_kg = 5.0;
constexpr double wheel_kg = 0.3;
constexpr double water_kgpm3 = 1000.0;

Eigen::Vector3d vector(Vec3 v) { return {v.x, v.y, v.z}; }

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

Eigen::Isometry3d isometry(const Pose3& pose) {
  Eigen::Isometry3d result = at(pose.position.x, pose.position.y, pose.position.z);
  for (int i = 0; i < 3; ++i) {
    result.linear().col(i) = vector(pose.rotation.axes[static_cast<std::size_t>(i)]);
  }
  return result;
}

/// Returns each triangle from both sides, because the engine lets balls through from behind. The mesh shape
/// owns the scene.
aiScene* two_sided(const MeshShape& shape) {
  const std::size_t faces = 2 * shape.triangles.size();
  auto mesh = std::make_unique<aiMesh>();
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = static_cast<unsigned>(3 * faces);
  mesh->mVertices = new aiVector3D[3 * faces];
  mesh->mNormals = new aiVector3D[3 * faces];
  mesh->mNumFaces = static_cast<unsigned>(faces);
  mesh->mFaces = new aiFace[faces];
  unsigned vertex = 0;
  unsigned face = 0;
  const auto ai = [](Vec3 v) {
    return aiVector3D(static_cast<ai_real>(v.x), static_cast<ai_real>(v.y), static_cast<ai_real>(v.z));
  };
  const auto add = [&](Vec3 a, Vec3 b, Vec3 c) {
    const aiVector3D normal = ai(cross(b - a, c - a));
    mesh->mFaces[face].mNumIndices = 3;
    mesh->mFaces[face].mIndices = new unsigned[3]{vertex, vertex + 1, vertex + 2};
    ++face;
    for (const Vec3 p : {a, b, c}) {
      mesh->mVertices[vertex] = ai(p);
      mesh->mNormals[vertex++] = normal;
    }
  };
  for (const auto& [a, b, c] : shape.triangles) {
    add(a, b, c);
    add(a, c, b);
  }
  auto scene = std::make_unique<aiScene>();
  scene->mMeshes = new aiMesh*[1]{mesh.release()};
  scene->mNumMeshes = 1;
  scene->mRootNode = new aiNode;
  return scene.release();
}

/// Returns nothing for a shape that the engine does not support.
dd::ShapePtr engine_shape(const Shape& shape) {
  if (const auto* box = std::get_if<BoxShape>(&shape))
    return std::make_shared<dd::BoxShape>(2.0 * vector(box->half_size));
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape))
    return std::make_shared<dd::CylinderShape>(cylinder->radius_m, 2.0 * cylinder->half_length_m);
  if (const auto* sphere = std::get_if<SphereShape>(&shape))
    return std::make_shared<dd::SphereShape>(sphere->radius_m);
  if (std::holds_alternative<HalfSpaceShape>(shape))
    return std::make_shared<dd::PlaneShape>(Eigen::Vector3d::UnitZ(), 0.0);
  if (const auto* mesh = std::get_if<MeshShape>(&shape))
    return std::make_shared<dd::MeshShape>(Eigen::Vector3d::Ones(), two_sided(*mesh));
  return nullptr;
}

dd::ShapeNode& add_shape(dd::BodyNode& body, dd::ShapePtr shape, const Eigen::Isometry3d& body_T_shape,
                         double friction = 1.0) {
  dd::ShapeNode* node = body.createShapeNodeWith<dd::CollisionAspect, dd::DynamicsAspect>(std::move(shape));
  node->setRelativeTransform(body_T_shape);
  node->getDynamicsAspect()->setFrictionCoeff(friction);
  return *node;
}

/// Returns the inertia of an upright cylinder about the z axis of its frame.
dd::Inertia cylinder_inertia(double mass_kg, double radius_m, double length_m, double height_m = 0.0) {
  const double r2 = radius_m * radius_m;
  const double across_kgm2 = mass_kg * (3.0 * r2 + length_m * length_m) / 12.0;
  const Eigen::Vector3d moments(across_kgm2, across_kgm2, 0.5 * mass_kg * r2);
  return {mass_kg, {0.0, 0.0, height_m}, moments.asDiagonal()};
}

/// Adds a wheel whose frame has z along the axle, to the left.
void add_wheel(dd::BodyNode& chassis, const std::string& side, double left_m, double radius_m) {
  // A thin wheel, because a robot that turns in place rolls on the inner edges.
  const double width_m = 0.04 * radius_m;
  dd::RevoluteJoint::Properties axle;
  axle.mName = side + "_wheel";
  axle.mAxis = Eigen::Vector3d::UnitZ();
  axle.mT_ParentBodyToJoint =
      at(0.0, left_m, radius_m) * Eigen::AngleAxisd(-0.5 * pi, Eigen::Vector3d::UnitX());
  axle.mActuatorType = dd::Joint::SERVO;
  auto [joint, wheel] =
      chassis.createChildJointAndBodyNodePair<dd::RevoluteJoint>(axle, dd::BodyNode::AspectProperties(side));
  wheel->setInertia(cylinder_inertia(wheel_kg, radius_m, width_m));
  add_shape(*wheel, std::make_shared<dd::CylinderShape>(radius_m, width_m), Eigen::Isometry3d::Identity());
}

}  // namespace

Outcome<dd::SkeletonPtr> rigid_yard(const std::vector<Solid>& solids) {
  auto yard = dd::Skeleton::create("yard");
  dd::BodyNode& body = *yard->createJointAndBodyNodePair<dd::WeldJoint>().second;
  for (const Solid& solid : solids) {
    auto shape = engine_shape(solid.shape);
    if (shape == nullptr) {
      return bad_input(
          fmt::format("'{}' is a {}, which the physics engine does not support; take 'kinematic'", solid.name,
                      kind(solid.shape)),
          "sim");
    }
    add_shape(body, std::move(shape), isometry(solid.world_T_solid));
  }
  yard->setMobile(false);
  return yard;
}

dd::SkeletonPtr rigid_robot(const RobotModel& robot, const Pose2& start, double floor_z_m) {
  const WheelBase base = wheel_base(robot);
  const double radius_m = 0.9 * robot.radius_m;
  const double low_m = 0.5 * base.wheel_radius_m;  // of the chassis above the floor
  const double length_m = robot.height_m - low_m;
  const double caster_m = base.wheel_radius_m / 3.0;
  auto skeleton = dd::Skeleton::create("robot");
  auto [joint, chassis] = skeleton->createJointAndBodyNodePair<dd::FreeJoint>(
      nullptr, dd::FreeJoint::Properties(), dd::BodyNode::AspectProperties("chassis"));
  chassis->setInertia(cylinder_inertia(chassis_kg, radius_m, length_m, base.wheel_radius_m));
  add_shape(*chassis, std::make_shared<dd::CylinderShape>(radius_m, length_m),
            at(0.0, 0.0, low_m + 0.5 * length_m));
  for (const double ahead_m : {base.half_track_m, -base.half_track_m}) {
    add_shape(*chassis, std::make_shared<dd::SphereShape>(caster_m), at(ahead_m, 0.0, caster_m), 0.0);
  }
  add_wheel(*chassis, "left", base.half_track_m, base.wheel_radius_m);
  add_wheel(*chassis, "right", -base.half_track_m, base.wheel_radius_m);
  joint->setRelativeTransform(at(start.position.x, start.position.y, floor_z_m) *
                              Eigen::AngleAxisd(start.heading_rad, Eigen::Vector3d::UnitZ()));
  return skeleton;
}

dd::SkeletonPtr rigid_ball(std::size_t number, Vec3 centre, double radius_m, Vec3 velocity_mps) {
  auto skeleton = dd::Skeleton::create(fmt::format("ball_{}", number));
  auto [joint, ball] = skeleton->createJointAndBodyNodePair<dd::FreeJoint>();
  const double mass_kg = water_kgpm3 * 4.0 / 3.0 * pi * radius_m * radius_m * radius_m;
  const double inertia_kgm2 = 0.4 * mass_kg * radius_m * radius_m;
  ball->setInertia({mass_kg, Eigen::Vector3d::Zero(), inertia_kgm2 * Eigen::Matrix3d::Identity()});
  add_shape(*ball, std::make_shared<dd::SphereShape>(radius_m), Eigen::Isometry3d::Identity());
  joint->setRelativeTransform(at(centre.x, centre.y, centre.z));
  joint->setLinearVelocity(vector(velocity_mps));
  return skeleton;
}

}  // namespace outrider
