#include "outrider/sweep/manifest.hpp"

#include <array>

#include "outrider/sweep/canary.hpp"
#include "sweep_job.hpp"

namespace outrider {
namespace {

using ManifestTest = testing::SweepFolder;

TEST_F(ManifestTest, IsReadAsItWasWritten) {
  const Manifest made = manifest(sweep({.runs = 3, .seed = 8, .vary = {"x=1,2"}, .compare = {"mode=a,b"}}));
  const auto read = read_manifest(manifest_text(made), "m");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(manifest_text(*read), manifest_text(made));
  EXPECT_TRUE(check_same(*read, made, "m"));
  ASSERT_EQ(made.inputs.size(), 1U);
  EXPECT_EQ(made.inputs[0].first, "input.txt");
  EXPECT_EQ(made.inputs[0].second, "87428fc522803d31065e7bce3cf03fe475096631e5e07bbd7a0fde60c4cf25c7");
  EXPECT_FALSE(made.build.empty());
}

TEST_F(ManifestTest, FilesThatVaryAreInputsToo) {
  write("other.txt", "b\n");
  EXPECT_EQ(manifest(sweep({.vary = {"file=" + path("input.txt") + "," + path("other.txt")}})).inputs.size(),
            2U);
  const auto none =
      make_manifest(sweep({.vary = {"file=" + path("none.txt") + "," + path("input.txt")}}), "1");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().where, path("none.txt"));
}

TEST_F(ManifestTest, TheFirstDifferenceIsNamed) {
  const Manifest made = manifest(sweep({.runs = 3}));
  const auto refused = [&](auto change, const std::string& says) {
    Manifest other = made;
    change(other);
    const auto same = check_same(made, other, "m.json");
    ASSERT_FALSE(same) << says;
    EXPECT_EQ(same.error().where, "m.json");
    EXPECT_NE(same.error().sentence.find(says), std::string::npos) << same.error().sentence;
  };
  refused([](Manifest& m) { m.version = "9"; }, "the version of Outrider");
  refused([](Manifest& m) { m.build = "9"; }, "the build of Outrider");
  refused([](Manifest& m) { m.scenario_hash = "9"; }, "the scenario");
  refused([](Manifest& m) { m.request.runs = 4; }, "--runs ('3' there, '4' here)");
  refused([](Manifest& m) { m.request.seed = 4; }, "--seed");
  refused([](Manifest& m) { m.request.vary = {"x=1,2"}; }, "--vary ('' there, 'x=1,2' here)");
  refused([](Manifest& m) { m.request.chunk_runs = 4; }, "--chunk-runs");
  refused([](Manifest& m) { m.inputs[0].second = "9"; }, "the input input.txt");
  refused([](Manifest& m) { m.inputs.clear(); }, "the input input.txt");
  refused([](Manifest& m) { m.mathematics[0].second = "9"; }, "computes sin otherwise");
  refused([](Manifest& m) { m.mathematics[2].second = m.mathematics[10].second = "9"; },
          "computes tan, exp ");
  Manifest moved = made;
  moved.request.scenario = "elsewhere/toy.yaml";
  EXPECT_TRUE(check_same(made, moved, "m.json")) << "the content counts, not where it lies";
}

TEST_F(ManifestTest, OtherTextIsRefused) {
  for (const char* text :
       {"", "{}", "[]", "{\"format\": 2}", "{\"format\": 1}", "null", "{\"format\": \"1\"}"}) {
    const auto read = read_manifest(text, "m.json");
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().where, "m.json");
  }
}

TEST_F(ManifestTest, OnlyWholeNumbersInRangeAreRead) {
  const std::string text = manifest_text(manifest(sweep({.runs = 3, .seed = 8})));
  const auto with = [&](const std::string& key, const std::string& old, const std::string& value) {
    std::string changed = text;
    const std::string before = "\"" + key + "\": ";
    const std::size_t at = changed.find(before + old);
    EXPECT_NE(at, std::string::npos) << key;
    return changed.replace(at + before.size(), old.size(), value);
  };
  ASSERT_TRUE(read_manifest(with("seed", "8", "1000000000000000"), "m.json"));
  for (const auto& [key, old, value] :
       std::vector<std::array<std::string, 3>>{{"seed", "8", "-1"},
                                               {"seed", "8", "1e19"},
                                               {"seed", "8", "10000000000000000000"},
                                               {"seed", "8", "1000000000000001"},
                                               {"seed", "8", "1.5"},
                                               {"seed", "8", "8.0"},
                                               {"seed", "8", "\"8\""},
                                               {"seed", "8", "[8]"},
                                               {"runs", "3", "0"},
                                               {"runs", "3", "-3"},
                                               {"runs", "3", "3.5"},
                                               {"chunk_runs", "1000", "0"},
                                               {"chunk_runs", "1000", "1e3"},
                                               {"chunk_runs", "1000", "null"}}) {
    const auto read = read_manifest(with(key, old, value), "m.json");
    ASSERT_FALSE(read) << key << value.substr(0, 20);
    EXPECT_EQ(read.error().where, "m.json");
    EXPECT_TRUE(read.error().sentence.starts_with(key + " '")) << read.error().sentence;
    EXPECT_LT(read.error().sentence.size(), 200U);
  }
}

TEST_F(ManifestTest, ItsHashIsThatOfWhatTheRunsDependOn) {
  const Manifest made = manifest(sweep({.runs = 3}));
  std::set<std::string> hashes = {manifest_hash(made)};
  const auto differs = [&](auto change) {
    Manifest other = made;
    change(other);
    EXPECT_TRUE(hashes.insert(manifest_hash(other)).second) << hashes.size();
  };
  differs([](Manifest& m) { m.version = "9"; });
  differs([](Manifest& m) { m.build = "9"; });
  differs([](Manifest& m) { m.job = "9"; });
  differs([](Manifest& m) { m.scenario_hash = "9"; });
  differs([](Manifest& m) { m.request.runs = 4; });
  differs([](Manifest& m) { m.request.seed = 4; });
  differs([](Manifest& m) { m.request.vary = {"x=1,2"}; });
  differs([](Manifest& m) { m.request.vary = {"x=1", "mode=2"}; });
  differs([](Manifest& m) { m.request.vary = {"x=1 mode=2"}; });
  differs([](Manifest& m) { m.request.compare = {"x=1,2"}; });
  differs([](Manifest& m) { m.request.chunk_runs = 4; });
  differs([](Manifest& m) { m.inputs[0].second = "9"; });
  differs([](Manifest& m) { m.mathematics[0].second = "9"; });
  Manifest moved = made;
  moved.request.scenario = "elsewhere/toy.yaml";
  EXPECT_EQ(manifest_hash(moved), manifest_hash(made));
}

TEST(Canary, IsTheSameInOneProcess) {
  const auto hashes = mathematics_canary();
  EXPECT_EQ(hashes, mathematics_canary());
  EXPECT_EQ(hashes.size(), 20U);
  std::set<std::string> different;
  for (const auto& [name, hash] : hashes) different.insert(hash);
  EXPECT_EQ(different.size(), hashes.size());
}

}  // namespace
}  // namespace outrider
