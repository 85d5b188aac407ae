#include "outrider/nodes/missions/tag_sight.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "outrider/job/sensor_log.hpp"
#include "outrider/log/messages/conversions.hpp"

namespace outrider {
namespace {

TagMap one_tag() {
  TagMap tags;
  tags.tags = {upright_tag(7, {3.0, 0.2, 0.4}, 3.1)};
  return tags;
}

/// Returns what a camera with a lens sees of the tag.
TagImage seen_by(const Camera& camera) {
  const Pose3 world_T_camera = looking_ahead({0.1, 0.0, 0.3});
  TagSighting sighting;
  sighting.id = 7;
  const Tag tag = one_tag().tags.front();
  const auto corners = tag_corners(tag.size_m);
  for (std::size_t i = 0; i < 4; ++i) {
    sighting.corners_px[i] = *project(camera, world_T_camera.to_local(tag.world_T_tag * corners[i]));
  }
  return {2.5, {sighting}};
}

TEST(TagSight, CornersComeBackThroughTheRectifiedImage) {
  Camera camera;
  camera.distortion = {-0.2, 0.05, 0.001, -0.002, 0.0};
  TagSight sight(one_tag());
  ASSERT_TRUE(sight.take(camera_message(camera)));
  const TagImage image = seen_by(camera);
  ASSERT_TRUE(sight.take(detections_of(image, camera, header_of(2.5, "camera"))));
  ASSERT_TRUE(sight.newest());
  EXPECT_EQ(sight.newest()->taken_s, 2.5);
  ASSERT_EQ(sight.newest()->sightings.size(), 1U);
  const TagSighting& back = sight.newest()->sightings.front();
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT(distance(back.corners_px[i], image.sightings.front().corners_px[i]), 1e-6);
  ASSERT_FALSE(back.poses.empty());
  EXPECT_NEAR(back.poses.front().camera_T_tag.position.z, 2.9, 0.02);  // the tag is so far ahead
}

TEST(TagSight, HostileMessagesAreRefusedWithASentence) {
  TagSight sight(one_tag());
  const Camera camera;
  auto detections = detections_of(seen_by(camera), camera, header_of(1.0, "camera"));
  EXPECT_NE(sight.take(detections).error().sentence.find("no camera_info has come yet"), std::string::npos);
  ASSERT_TRUE(sight.take(camera_message(camera)));
  detections.header = header_of(2.0, "camera");
  detections.detections.front().corners[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(sight.take(detections).error().sentence.find("a corner of tag 7"), std::string::npos);
  detections.detections.resize(1001);
  EXPECT_NE(sight.take(detections).error().sentence.find("it has 1001 detections"), std::string::npos);
  detections.detections.resize(0);
  detections.header = header_of(1.0, "camera");
  EXPECT_NE(sight.take(detections).error().sentence.find("the time goes back"), std::string::npos);
  sensor_msgs::Image image;
  image.header = header_of(3.0, "camera");
  image.encoding = "mono8";
  image.width = image.height = image.step = 4;
  image.data.resize(16);
  EXPECT_NE(sight.take(image).error().sentence.find("it has 4 x 4 pixels"), std::string::npos);
  image.width = 65536;
  EXPECT_FALSE(sight.take(image));
  auto info = camera_message(camera);
  info.k[0] = 0.0;
  EXPECT_FALSE(sight.take(info));
  EXPECT_FALSE(sight.newest());
}

TEST(TagSight, TagsOfOtherFamiliesAndOffTheMapDoNotCount) {
  TagSight sight(one_tag());
  const Camera camera;
  ASSERT_TRUE(sight.take(camera_message(camera)));
  auto detections = detections_of(seen_by(camera), camera, header_of(1.0, "camera"));
  detections.detections.push_back(detections.detections.front());
  detections.detections[0].family = "tag16h5";
  detections.detections[1].id = 8;
  ASSERT_TRUE(sight.take(detections));
  EXPECT_TRUE(sight.newest()->sightings.empty());
}

}  // namespace
}  // namespace outrider
