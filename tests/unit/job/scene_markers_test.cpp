#include "outrider/job/scene_markers.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/messages/ros_marker_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

using visualization_msgs::Marker;

outrider_msgs::Solid box_solid(double low_z, double high_z, bool blocks) {
  return {"crate", "box", {{{{1.0, 1.0}, {3.0, 1.0}, {3.0, 2.0}, {1.0, 2.0}}, 0.0}}, low_z, high_z, blocks};
}

std::vector<Marker> markers_of(const Log& log) {
  const auto* scene = log.latest<visualization_msgs::MarkerArray>(topic::scene);
  return scene == nullptr ? std::vector<Marker>{} : scene->markers;
}

/// Returns the volume between the triangles and the plane z = 0, by the divergence theorem. The triangles
/// look outwards.
double volume_above_zero(const Marker& marker) {
  double volume = 0.0;
  for (std::size_t i = 0; i + 2 < marker.points.size(); i += 3) {
    const auto &a = marker.points[i], &b = marker.points[i + 1], &c = marker.points[i + 2];
    const double area_xy = 0.5 * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
    volume += area_xy * (a.z + b.z + c.z) / 3.0;
  }
  return volume;
}

TEST(SceneMarkers, ASolidIsAPrismOverItsFootprint) {
  Log log;
  log.append(topic::solids, 0.0, outrider_msgs::Solids{{box_solid(0.0, 1.5, true)}});
  log_markers(log);
  const auto markers = markers_of(log);
  ASSERT_EQ(markers.size(), 1U);
  EXPECT_EQ(markers[0].shape, Marker::triangle_list);
  EXPECT_EQ(markers[0].header.frame_id, "map");
  EXPECT_EQ(markers[0].points.size(), 3U * (2U + 4U * 2U));
  EXPECT_NEAR(volume_above_zero(markers[0]), 2.0 * 1.0 * 1.5, 1e-12);
}

TEST(SceneMarkers, AThinWallHasBothFaces) {
  Log log;
  log.append(topic::solids, 0.0,
             outrider_msgs::Solids{{{"wall", "box", {{{{1.0, 1.0}, {3.0, 1.0}}, 0.0}}, 0.0, 0.5, true}}});
  log_markers(log);
  const auto markers = markers_of(log);
  ASSERT_EQ(markers.size(), 1U);
  EXPECT_EQ(markers[0].points.size(), 3U * 2U * 2U);
  for (const auto& point : markers[0].points) EXPECT_EQ(point.y, 1.0);
}

TEST(SceneMarkers, ASolidWithoutEndIsDrawnAndOneOverheadIsApart) {
  Log log;
  constexpr double inf = std::numeric_limits<double>::infinity();
  log.append(topic::solids, 0.0,
             outrider_msgs::Solids{{box_solid(-inf, inf, true), box_solid(2.0, 3.0, false)}});
  log_markers(log);
  const auto markers = markers_of(log);
  ASSERT_EQ(markers.size(), 2U);
  EXPECT_EQ(markers[0].ns, "solids");
  EXPECT_EQ(markers[1].ns, "overhead");
  for (const Marker& marker : markers) {
    for (const auto& point : marker.points) EXPECT_TRUE(std::isfinite(point.z));
  }
}

TEST(SceneMarkers, TerrainKeepsItsHeightsAndTargetsTheirNames) {
  Log log;
  outrider_msgs::Terrain terrain;
  terrain.columns = 3;
  terrain.rows = 2;
  terrain.spacing = {2.0, 1.0};
  terrain.heights = {0.0, 1.0, 2.0, 0.0, 1.0, 2.0};  // a slope
  log.append(topic::terrain, 0.0, terrain);
  log_markers(log, {{"fox", {1.0, 0.5, 0.2}, 0.5, {0.3, 0.2, 0.4}}});
  const auto markers = markers_of(log);
  ASSERT_EQ(markers.size(), 3U);
  EXPECT_EQ(markers[0].points.size(), 4U * 3U);
  for (const auto& point : markers[0].points) EXPECT_EQ(point.z, 0.5 * point.x);
  EXPECT_EQ(markers[1].ns, "targets");
  EXPECT_EQ(markers[1].scale.y, 0.2);
  EXPECT_NEAR(heading_of(markers[1].pose.orientation), 0.5, 1e-12);
  EXPECT_EQ(markers[2].text, "fox");
}

TEST(SceneMarkers, NoTwoMarkersShareNameAndNumberAndNothingMakesNone) {
  Log log;
  log_markers(log);
  EXPECT_TRUE(log.channels().empty());
  outrider_msgs::Tags tags;
  tags.tags = {{1, {0.0, 0.0, 1.0}, 0.0, 0.2}, {2, {1.0, 0.0, 1.0}, 0.0, 0.2}};
  log.append(topic::tags, 0.0, tags);
  log_markers(log, {{"a", {}, 0.0, {1, 1, 1}}, {"b", {}, 0.0, {1, 1, 1}}});
  std::set<std::pair<std::string, std::int32_t>> names;
  for (const Marker& marker : markers_of(log)) EXPECT_TRUE(names.emplace(marker.ns, marker.id).second);
  EXPECT_EQ(names.size(), 6U);
}

}  // namespace
}  // namespace outrider
