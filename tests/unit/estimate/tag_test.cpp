#include "outrider/estimate/tag.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

TEST(Tag, UprightTagsLookAtTheirReader) {
  // On a wall to the east that looks west: the reader's right is south.
  const Tag tag = upright_tag(3, {2.0, 1.0, 0.3}, pi, 0.2);
  const auto corners = tag_corners(tag.size_m);
  const Vec3 lower_left = tag.world_T_tag * corners[0], upper_right = tag.world_T_tag * corners[2];
  EXPECT_NEAR(lower_left.x, 2.0, 1e-12);
  EXPECT_NEAR(lower_left.y, 1.1, 1e-12);
  EXPECT_NEAR(lower_left.z, 0.2, 1e-12);
  EXPECT_NEAR(upper_right.y, 0.9, 1e-12);
  EXPECT_NEAR(upper_right.z, 0.4, 1e-12);
  EXPECT_NEAR((tag.world_T_tag * Vec3{0, 0, 1}).x, 3.0, 1e-12) << "into the wall";
}

TEST(Tag, RefusesMapsThatCannotBe) {
  TagMap map{{upright_tag(1, {}, 0.0), upright_tag(2, {}, 0.0)}};
  EXPECT_TRUE(check_tags(map));
  EXPECT_EQ(map.find(2), &map.tags[1]);
  EXPECT_EQ(map.find(3), nullptr);
  map.tags[1].id = 1;
  EXPECT_NE(check_tags(map).error().sentence.find("hangs twice"), std::string::npos);
  map.tags[1].id = 587;
  EXPECT_NE(check_tags(map).error().sentence.find("0 to 586"), std::string::npos);
  map.family = TagFamily::tag36h10;
  EXPECT_TRUE(check_tags(map));
  map.tags[1] = upright_tag(2, {}, 0.0, 0.0);
  EXPECT_NE(check_tags(map).error().sentence.find("above 0"), std::string::npos);
}

}  // namespace
}  // namespace outrider
