// Areas in which things stand that the robot is not told of: all that it can reach is covered, without a
// contact and without leaving the area.
#include "outrider/jobs/cover/mission/navigated.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/job/scene.hpp"
#include "outrider/jobs/cover/scenario.hpp"
#include "outrider/log/log.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

CoverProblem area(Rng& rng) {
  CoverProblem problem = testing::random_cover_problem(rng);
  problem.tracking_error_m = 0.02;
  problem.overlap = 0.15;
  problem.pace = {0.5, 0.3, 0.5, 1.5, 0.7, 4.0, 0.0};
  return problem;
}

struct Post {
  Vec2 at;
  double radius_m = 0.0;
};

/// Three posts in the area, none where the robot starts.
std::vector<Post> posts_in(const CoverProblem& problem, Vec2 start, Rng& rng) {
  const Region region = region_of(problem.boundary, problem.holes);
  std::vector<Post> posts;
  while (posts.size() < 3) {
    const Post post{testing::random_point(rng, 6.0), rng.uniform(0.08, 0.4)};
    if (contains(region, post.at) && distance(post.at, start) > post.radius_m + problem.width_m)
      posts.push_back(post);
  }
  return posts;
}

struct CoverCase {
  CoverProblem problem;
  CoverPlan plan;
  std::vector<Post> posts;
  std::string things;
};

CoverCase make_case(int k) {
  Rng rng(static_cast<std::uint64_t>(k) + 100);
  CoverCase one{area(rng), {}, {}, {}};
  one.plan = *find_cover_method("quickest")->plan(*kept_inside(one.problem), testing::any_order(), {});
  one.posts = posts_in(one.problem, one.plan.track.start.position, rng);
  for (const Post& post : one.posts)
    one.things += fmt::format("{:.3f},{:.3f},{:.3f} ", post.at.x, post.at.y, post.radius_m);
  return one;
}

Outcome<NavigatedCover> drive(const CoverCase& one, const NavigationOptions& navigation) {
  Log log;
  return drive_with_navigator(one.problem, *find_cover_method("quickest"), testing::any_order(), one.plan,
                              navigation, one.things, 1, log, {}, [](const PieceDrive&) {});
}

/// The distance of a point from the nearest leg of the way.
double to_way_m(Vec2 p, const std::vector<Vec2>& way) {
  double least = 1e9;
  for (std::size_t i = 1; i < way.size(); ++i)
    least = std::min(least, distance(p, Segment{way[i - 1], way[i]}));
  return least;
}

TEST(NavigatedCover, CoversWhatItCanReachAmongThingsThatItWasNotToldOf) {
  for (int k = 0; k < testing::cases(1); ++k) {
    SCOPED_TRACE(k);
    const CoverCase one = make_case(k);
    const auto done = drive(one, CoverScenario::default_navigation());
    ASSERT_TRUE(done) << done.error().sentence;
    EXPECT_TRUE(done->finished);
    EXPECT_EQ(done->contacts, 0);
    EXPECT_EQ(done->left_ground, 0U);
    // It may believe that it fits through a passage into which it does not; then it says what is left.
    EXPECT_TRUE(done->believed_complete || done->left_m2 > 0.0) << done->reason;
    EXPECT_GT(done->driven.fraction, 0.99);
    EXPECT_LT(done->drive.length_m, 2.0 * one.plan.sums.length_m);
    // The same by points: those with room for a smaller robot that the walls and posts leave are covered.
    const double radius_m = one.problem.body_radius_m();
    int missed = 0, looked_at = 0;
    Rng rng(9);
    for (int i = 0; i < 2000; ++i) {
      const Vec2 p = testing::random_point(rng, 6.0);
      if (!contains(done->reach, p)) continue;
      ++looked_at;
      if (to_way_m(p, done->drive.way) > radius_m) ++missed;
    }
    ASSERT_GT(looked_at, 200);
    EXPECT_LE(missed, looked_at / 100);
    double gap_m = 1e9;
    for (const Vec2 place : done->drive.way) {
      for (const Post& post : one.posts)
        gap_m = std::min(gap_m, distance(place, post.at) - post.radius_m - radius_m);
    }
    EXPECT_GT(gap_m, 0.0);
  }
}

TEST(NavigatedCover, TakesAreasThatTouchForOne) {
  CoverProblem problem = make_case(0).problem;
  problem.boundary = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  problem.holes.clear();
  problem.others = {{{{2, 0}, {4, 0}, {4, 2}, {2, 2}}, {}}};
  const auto inside = kept_inside(problem);
  ASSERT_TRUE(inside);
  EXPECT_TRUE(inside->others.empty());
  EXPECT_NEAR(area_of(region_of(inside->boundary, inside->holes)), 3.96 * 1.96, 1e-3);
}

TEST(NavigatedCover, RefusesAThingWhereTheRobotStarts) {
  CoverCase one = make_case(0);
  const Vec2 start = one.plan.track.start.position;
  one.things = fmt::format("{},{},0.1", start.x, start.y);
  const auto refused = drive(one, CoverScenario::default_navigation());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where, "things");
}

TEST(NavigatedCover, DoesNotCallCompleteWhatIsBehindAWall) {
  CoverCase one = make_case(0);
  one.problem.boundary = {{0, 0}, {6, 0}, {6, 3}, {0, 3}};
  one.problem.holes.clear();
  one.problem.start = Pose2{{1.0, 1.5}, 0.0};
  one.plan = *find_cover_method("quickest")->plan(*kept_inside(one.problem), testing::any_order(), {});
  one.things = "3,1.5,0.2,3.0";
  const auto done = drive(one, CoverScenario::default_navigation());
  ASSERT_TRUE(done);
  // All on its side of the wall is covered, and that is what can be.
  EXPECT_TRUE(done->believed_complete) << done->reason;
  EXPECT_GT(done->driven.fraction, 0.99);
  EXPECT_LT(area_of(done->reach), 9.0);
  EXPECT_EQ(done->contacts, 0);
}

}  // namespace
}  // namespace outrider
