// Do counts grow as claimed? Each subject is a test; the harness itself is tried on growth that is known.
#include <gtest/gtest.h>

#include <cctype>
#include <ostream>

#include "subject.hpp"
#include "work.hpp"

namespace outrider::growth {

/// Tells gtest how a subject is shown.
void PrintTo(const Subject& subject, std::ostream* out) {
  *out << subject.name << " in " << subject.parameter;
}

namespace {

class Growths : public ::testing::TestWithParam<Subject> {};

TEST_P(Growths, KeepToTheirClaims) {
  const Subject& subject = GetParam();
  const std::vector<Growth> growths = measure(subject);
  ASSERT_EQ(growths.size(), subject.claims.size());
  for (std::size_t k = 0; k < growths.size(); ++k) {
    const Claim& claim = subject.claims[k];
    EXPECT_TRUE(keeps(growths[k])) << subject.name << ": " << claim.counted << " grow with exponent "
                                   << growths[k].exponent << " in " << subject.parameter << ", but "
                                   << subject.header << " claims " << claim.sentence << ", exponent "
                                   << growths[k].claimed_exponent << " at these sizes; find what grows, or "
                                   << "correct the claim";
    for (const double count : growths[k].counts) EXPECT_GT(count, 0.0) << subject.name << claim.counted;
  }
}

TEST_P(Growths, AreTheSameInEveryRun) {
  const Subject& subject = GetParam();
  (void)subject.run(subject.sizes.front());  // sets up what a process sets up once
  const std::vector<double> once = subject.run(subject.sizes.front());
  const std::vector<double> again = subject.run(subject.sizes.front());
  for (std::size_t k = 0; k < once.size(); ++k) {
    const bool is_memory = subject.claims[k].counted == "peak bytes";  // the allocator rounds up as it can
    EXPECT_NEAR(again[k], once[k], is_memory ? 0.02 * once[k] : 0.0) << subject.claims[k].counted;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Growths, ::testing::ValuesIn(subjects()), [](const auto& info) {
  std::string name;
  for (const char c : info.param.name + "_in_" + info.param.parameter) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
    if (c == ' ' || c == '_') name += '_';
  }
  return name;
});

/// Counts all pairs of the numbers, and the numbers.
std::vector<double> pairs_and_numbers(int size) {
  const std::vector<double> counts{static_cast<double>(size) * size, static_cast<double>(size)};
  return counts;
}

TEST(Growth, RefusesWhatIsQuadraticUnderALinearClaim) {
  const auto linear = [](double n) { return n; };
  const Subject subject{"pairs",
                        "numbers",
                        "",
                        {16, 32, 64, 128},
                        {{"pairs", "O(n)", linear}, {"numbers", "O(n)", linear}},
                        pairs_and_numbers};
  const std::vector<Growth> growths = measure(subject);
  EXPECT_NEAR(growths[0].exponent, 2.0, 1e-9);
  EXPECT_FALSE(keeps(growths[0]));
  EXPECT_NEAR(growths[1].exponent, 1.0, 1e-9);
  EXPECT_TRUE(keeps(growths[1]));
}

TEST(Growth, CountsWhatIsHeldAtOnce) {
  const Work work = work_of([] {
    for (int k = 0; k < 10; ++k) std::vector<double> part(1000, 1.0);
    std::vector<double> whole(5000, 1.0);
    whole.clear();
  });
  EXPECT_GE(work.allocations, 11.0);
  EXPECT_NEAR(work.peak_bytes, 40000.0, 100.0);
}

}  // namespace
}  // namespace outrider::growth
