// Worlds read by Outrider and by sdformat, the library of Gazebo, which shares no code with it: the same
// solids at the same places within 1e-9. Skipped where sdformat is not installed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#ifndef OUTRIDER_WITH_SDFORMAT

TEST(SdfOracle, IsSkippedWithoutSdformat) { GTEST_SKIP() << "install libsdformat-dev for these tests"; }

#else

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sdf/sdf.hh>
#include <set>

#include "outrider/core/rng.hpp"
#include "outrider/io/files/files.hpp"
#include "sdf/sdf_scene.hpp"
#include "sdf/sdf_shapes.hpp"
#include "sdf_texts.hpp"
#include "support/data.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;
using Placed = std::pair<std::string, Pose3>;  // "model/link/collision shape", world_T_collision

constexpr double tolerance = 1e-9;

template <class Vector>
Vec3 vec(const Vector& v) {
  return {v.X(), v.Y(), v.Z()};
}

template <class Pose>
Pose3 pose(const Pose& p) {
  return {vec(p.Pos()), {{vec(p.Rot().XAxis()), vec(p.Rot().YAxis()), vec(p.Rot().ZAxis())}}};
}

/// Returns what sdformat reads.
struct Peer {
  std::vector<Placed> placed;
  std::string error;
  bool is_whole = true;  ///< false if a mesh was not found, which sdformat does not look for

  void walk(const sdf::Model& model, const std::string& name, const std::string& in, const Pose3& outer) {
    const Pose3 world_T_model = outer * resolved(model.SemanticPose(), in);
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& link = *model.LinkByIndex(i);
      const Pose3 world_T_link = world_T_model * resolved(link.SemanticPose(), "__model__");
      for (std::uint64_t k = 0; k < link.CollisionCount(); ++k) {
        const sdf::Collision& collision = *link.CollisionByIndex(k);
        if (collision.Geom()->Type() == sdf::GeometryType::EMPTY) continue;
        placed.emplace_back(name + link.Name() + '/' + collision.Name() + shape(*collision.Geom()),
                            world_T_link * resolved(collision.SemanticPose(), link.Name()));
      }
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const sdf::Model& nested = *model.ModelByIndex(i);
      walk(nested, name + nested.Name() + '/', "__model__", world_T_model);
    }
  }

  Pose3 resolved(const sdf::SemanticPose& semantic, const std::string& in) {
    std::remove_cvref_t<decltype(sdf::Link().RawPose())> found;
    const auto errors = semantic.Resolve(found, in);
    if (!errors.empty()) error = errors.front().Message();
    return pose(found);
  }

  static std::string shape(const sdf::Geometry& geometry) {
    switch (geometry.Type()) {
      case sdf::GeometryType::BOX: return text(0.5 * vec(geometry.BoxShape()->Size()));
      case sdf::GeometryType::CYLINDER:
        return text({geometry.CylinderShape()->Radius(), 0.5 * geometry.CylinderShape()->Length(), 0});
      case sdf::GeometryType::SPHERE: return text({geometry.SphereShape()->Radius(), 0, 0});
      default: return "";
    }
  }
  static std::string text(Vec3 v) { return fmt::format(" {:.9g} {:.9g} {:.9g}", v.x, v.y, v.z); }
};

Peer read_by_sdformat(const std::string& text, const std::string& path) {
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::LOG);
  SdfFiles files("");
  config.SetFindCallback([&](const std::string& uri) {
    return files
        .find(uri.starts_with('/')                   ? uri
              : uri.find("://") == std::string::npos ? "model://" + uri
                                                     : uri,
              fs::path(path).parent_path().string())
        .value_or("");
  });
  ::testing::internal::CaptureStderr();
  sdf::Root root;
  Peer peer;
  try {
    for (const auto& error : root.LoadSdfString(text, config)) peer.error = error.Message();
  } catch (const std::exception& error) {
    peer.error = error.what();
  }
  if (root.WorldCount() == 0) peer.error += "no world";
  if (root.Model() != nullptr) peer.walk(*root.Model(), root.Model()->Name() + '/', "", {});
  for (std::uint64_t i = 0; peer.error.empty() && i < root.WorldByIndex(0)->ModelCount(); ++i) {
    const sdf::Model& model = *root.WorldByIndex(0)->ModelByIndex(i);
    peer.walk(model, model.Name() + '/', "world", {});
  }
  (void)::testing::internal::GetCapturedStderr();
  return peer;
}

/// Returns the poses that Outrider reads.
Peer read_by_us(const std::string& text, const std::string& path) {
  Peer ours;
  SdfFiles files("");
  SdfMeshes meshes;
  const auto file = files.parse(text, path);
  const auto scene = file ? scan_sdf(files, **file) : Outcome<SdfScene>(tl::unexpected(file.error()));
  const auto poses =
      scene ? collision_poses(*scene) : Outcome<std::vector<Pose3> >(tl::unexpected(scene.error()));
  if (!poses) return {{}, to_string(poses.error())};
  for (std::size_t i = 0; i < poses->size(); ++i) {
    const SdfCollision& one = scene->collisions[i];
    const SdfFrame& link = scene->frames[one.link];
    std::string name = scene->scopes[link.scope].name + '/' + link.name + '/' + one.name;
    if (one_of(one.shape.name(), {"box", "cylinder", "sphere"})) {
      const auto pieces = sdf_pieces(files, *one.file, one.shape, one.mesh, meshes);
      if (!pieces) return {{}, to_string(pieces.error())};
      const Shape& shape = pieces->front().shape;
      if (const auto* box = std::get_if<BoxShape>(&shape)) name += Peer::text(box->half_size);
      if (const auto* cylinder = std::get_if<CylinderShape>(&shape))
        name += Peer::text({cylinder->radius_m, cylinder->half_length_m, 0});
      if (const auto* sphere = std::get_if<SphereShape>(&shape)) name += Peer::text({sphere->radius_m, 0, 0});
    }
    ours.placed.emplace_back(name, (*poses)[i]);
  }
  ours.is_whole = files.warnings.first_missing().empty();
  return ours;
}

/// Returns a name without its levels: sdformat makes models of links "model::link" of SDF 1.7, Outrider does
/// not.
std::string flat(std::string name) {
  std::ranges::replace(name, '/', '_');
  return name;
}

void expect_same(const Peer& theirs, const Peer& ours, const std::string& name) {
  ASSERT_EQ(ours.error, "") << name;
  ASSERT_EQ(ours.placed.size(), theirs.placed.size()) << name;
  for (std::size_t i = 0; i < ours.placed.size(); ++i) {
    EXPECT_EQ(flat(ours.placed[i].first), flat(theirs.placed[i].first)) << name;
    const Pose3& a = ours.placed[i].second;
    const Pose3& b = theirs.placed[i].second;
    double off = norm(a.position - b.position);
    for (std::size_t k = 0; k < 3; ++k) off = std::max(off, norm(a.rotation.axes[k] - b.rotation.axes[k]));
    EXPECT_LE(off, tolerance) << name << ": " << ours.placed[i].first;
  }
}

// ---- Frames --------------------------------------------------------------------------------------

/// Writes models of links, frames, joints and nested models whose poses are relative to each other.
class RandomModels {
 public:
  explicit RandomModels(Rng& rng) : rng_(rng) {}

  std::string world() {
    std::string text = "<sdf version='1.9'><world name='w'>";
    std::vector<std::string> known = {"world"};
    for (int i = 0; i < 4; ++i) {
      const std::string name = fmt::format("m{}", i);
      text += model(name, known, 2);
      known.push_back(name);
      known.push_back(name + "::l0");
      text += fmt::format("<frame name='f{}' {}>{}</frame>", i, maybe("attached_to", known), pose(known));
      known.push_back(fmt::format("f{}", i));
    }
    return text + "</world></sdf>";
  }

 private:
  int below(int n) { return static_cast<int>(rng_.uniform(0.0, n)); }
  const std::string& one(const std::vector<std::string>& known) {
    return known[static_cast<std::size_t>(below(static_cast<int>(known.size())))];
  }
  std::string maybe(const std::string& attribute, const std::vector<std::string>& known) {
    return below(2) == 0 ? "" : fmt::format("{}='{}'", attribute, one(known));
  }
  std::string pose(const std::vector<std::string>& known) {
    if (below(5) == 0) return "";
    const auto v = [&] { return rng_.uniform(-3.0, 3.0); };
    const std::string base = maybe("relative_to", known);
    if (below(4) == 0) {  // sdformat leaves a quaternion as long as it is
      const double half = v();
      return fmt::format("<pose {} rotation_format='quat_xyzw'>{} {} {} {} 0 0 {}</pose>", base, v(), v(),
                         v(), std::sin(half), std::cos(half));
    }
    const bool degrees = below(3) == 0;
    return fmt::format("<pose {} {}>{} {} {} {} {} {}</pose>", base, degrees ? "degrees='true'" : "", v(),
                       v(), v(), v(), v(), v());
  }
  std::string link(const std::string& name, const std::vector<std::string>& known) {
    return fmt::format(
        "<link name='{0}'>{1}<collision "
        "name='c'>{2}<geometry><sphere><radius>0.5</radius></sphere></geometry>"
        "</collision></link>",
        name, pose(known), pose(known));
  }
  std::string model(const std::string& name, const std::vector<std::string>& outside, int levels) {
    std::vector<std::string> known = {"__model__"};
    std::string text;
    for (int i = 0; i < 3; ++i) {
      text += link(fmt::format("l{}", i), known);
      known.push_back(fmt::format("l{}", i));
      text += fmt::format("<frame name='f{}' {}>{}</frame>", i, maybe("attached_to", known), pose(known));
      known.push_back(fmt::format("f{}", i));
      if (i > 0) {
        text +=
            fmt::format("<joint name='j{0}' type='fixed'><parent>l0</parent><child>l{0}</child>{1}</joint>",
                        i, pose(known));
        known.push_back(fmt::format("j{}", i));
      }
      if (levels == 0 || i != 1) continue;
      const std::string nested = fmt::format("n{}", i);
      text += model(nested, known, levels - 1);
      known.insert(known.end(), {nested, nested + "::l1", nested + "::f2", nested + "::__model__"});
    }
    return fmt::format("<model name='{}' {}>{}{}</model>", name, maybe("placement_frame", known),
                       pose(outside), text);
  }

  Rng& rng_;
};

TEST(SdfOracle, RandomFramesStandWhereSdformatPutsThem) {
  Rng rng(11);
  std::size_t collisions = 0;
  for (int i = 0; i < testing::cases(10); ++i) {
    const std::string text = RandomModels(rng).world();
    const Peer theirs = read_by_sdformat(text, "w.sdf");
    ASSERT_EQ(theirs.error, "") << text;
    expect_same(theirs, read_by_us(text, "w.sdf"), fmt::format("case {}", i));
    collisions += theirs.placed.size();
  }
  EXPECT_GE(collisions, 10U * 4U * 9U);
}

TEST(SdfOracle, FramesThatHangInTheAirAreRefusedByBoth) {
  const std::string link =
      "<link name='l'><collision name='c'><geometry>" + unit_box + "</geometry></collision></link>";
  const auto at = [](const std::string& frame) {
    return "<pose relative_to='" + frame + "'>1 2 3 0 0 0</pose>";
  };
  for (const std::string& content :
       {"<model name='m'>" + at("nothing") + link + "</model>",
        "<model name='m'>" + at("m") + link + "</model>", "<model name='m'>" + at("m::l") + link + "</model>",
        "<model name='a'>" + at("b") + link + "</model><model name='b'>" + at("a") + link + "</model>",
        "<model name='m' placement_frame='nothing'>" + link + "</model>",
        "<model name='m'><link name='l'><collision name='c'>" + at("n::x") + "<geometry>" + unit_box +
            "</geometry></collision></link><model name='n'>" + link + "</model></model>"}) {
    EXPECT_NE(read_by_sdformat(world_of(content, "1.9"), "w.sdf").error, "") << content;
    const std::string refused = read_by_us(world_of(content, "1.9"), "w.sdf").error;
    EXPECT_TRUE(refused.starts_with("w.sdf:3: the pose of '")) << content << ": " << refused;
  }
}

TEST(SdfOracle, RandomRobotsOfUrdfStandWhereSdformatPutsThem) {
  Rng rng(5);
  const auto origin = [&] {
    const auto v = [&] { return rng.uniform(-1.5, 1.5); };
    return fmt::format("<origin xyz='{} {} {}' rpy='{} {} {}'/>", v(), v(), v(), v(), v(), v());
  };
  for (int i = 0; i < testing::cases(10); ++i) {
    std::string text = "<robot name='r'>";
    for (int k = 0; k < 8; ++k) {
      text += fmt::format(
          "<link name='l{}'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
          "iyz='0'/>"
          "</inertial><collision name='c'>{}<geometry><sphere radius='0.5'/></geometry></collision></link>",
          k, origin());
      if (k == 0) continue;
      text += fmt::format(
          "<joint name='j{0}' type='continuous'><parent link='l{1}'/><child link='l{0}'/>{2}<axis xyz='0 0 "
          "1'/></joint>",
          k, static_cast<int>(rng.uniform(0.0, k)), origin());
    }
    Peer theirs = read_by_sdformat(text + "</robot>", "r.urdf");
    Peer ours = read_by_us(text + "</robot>", "r.urdf");
    const auto link_of = [](const Placed& one) { return one.first.substr(0, one.first.find('/', 2)); };
    for (Peer* peer : {&theirs, &ours}) {
      for (Placed& one : peer->placed) one.first = link_of(one);
      std::ranges::sort(peer->placed, {}, &Placed::first);
    }
    ASSERT_EQ(theirs.placed.size(), 8U) << theirs.error;
    theirs.error.clear();
    expect_same(theirs, ours, fmt::format("case {}", i));
  }
}

// ---- Worlds --------------------------------------------------------------------------------------

TEST(SdfOracle, WorldsOfOursAndOthersAreReadAsBySdformat) {
  std::vector<fs::path> roots = {fs::path(OUTRIDER_SOURCE_DIR) / "scenarios", test::data_folder()};
  if (const char* more = std::getenv("OUTRIDER_WORLDS"))
    roots.emplace_back(more);  // a folder of public worlds
  int same = 0;
  int ours_alone = 0;
  int refused = 0;
  std::set<fs::path> paths;
  for (const fs::path& root : roots) {
    if (!fs::exists(root)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root))
      if (one_of(entry.path().extension().string(), {".sdf", ".world"})) paths.insert(entry.path());
  }
  for (const fs::path& path : paths) {
    const auto text = read_file(path.string());
    if (!text || text->find("<world") == std::string::npos) continue;
    const Peer theirs = read_by_sdformat(*text, path.string());
    const Peer ours = read_by_us(*text, path.string());
    // sdformat 12 reads no saved states, cones and polylines, and merges no models into a world.
    const bool beyond =
        std::ranges::any_of(std::initializer_list<const char*>{"<state", "<cone", "<polyline", "merge="},
                            [&](const char* word) { return text->find(word) != std::string::npos; });
    if (theirs.error.empty() && ours.is_whole && !beyond) expect_same(theirs, ours, path.string());
    ++(!ours.error.empty() ? refused : theirs.error.empty() ? same : ours_alone);
  }
  std::cout << same << " worlds read by both, " << ours_alone << " by Outrider alone, " << refused
            << " refused\n";
  EXPECT_GE(same, 8);
}

}  // namespace
}  // namespace outrider

#endif
