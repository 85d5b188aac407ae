#include "outrider/sweep/run_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "outrider/core/sha256.hpp"
#include "outrider/io/files/file_lock.hpp"
#include "outrider/io/files/text.hpp"
#include "sweep_job.hpp"

namespace outrider {
namespace {

using RunSweep = testing::SweepFolder;

SweepRequest toy_request(std::uint64_t chunk_runs = 7) {
  return {.runs = 60,
          .seed = 5,
          .vary = {"x=uniform(0,10)", "mode=a,b"},
          .compare = {},
          .chunk_runs = chunk_runs};
}

TEST_F(RunSweep, TheTableDoesNotDependOnChunksOrTheirOrder) {
  const std::string once = table(sweep(toy_request(1000)), "once");
  EXPECT_EQ(table(sweep(toy_request(7)), "seven"), once);
  EXPECT_EQ(table(sweep(toy_request(1)), "single"), once);
  const Sweep all = sweep(toy_request(7));
  ASSERT_TRUE(begin_sweep(manifest(all), path("backwards")));
  for (std::uint64_t chunk = all.chunks(); chunk-- > 0;) {
    ASSERT_TRUE(
        compute_chunks(all, {.folder = path("backwards"), .first_chunk = chunk, .end_chunk = chunk + 1}));
  }
  const auto hash = merge(all, "backwards");
  ASSERT_TRUE(hash);
  EXPECT_EQ(*hash, sha256(once));
  EXPECT_EQ(read_file(path("backwards/table.csv")).value_or(""), once);
}

/// Every line is what a run by itself comes to.
TEST_F(RunSweep, ALineIsARun) {
  const Sweep all = sweep(toy_request());
  std::string text = table(all, "out");
  std::string_view rest = text;
  EXPECT_EQ(take_line(rest), "run,seed,x,mode,status,reason,y,twice");
  std::set<std::string> statuses;
  std::uint64_t count = 0;
  for (; !rest.empty(); ++count) {
    const auto fields = csv_fields(take_line(rest));
    ASSERT_EQ(fields.size(), 8U);
    statuses.insert(fields[4]);
    const double x = std::stod(fields[2]);
    if (x > 9.5) {
      EXPECT_EQ(fields[4], "bug");
      EXPECT_EQ(fields[5], "this is a bug: x is too large");
      continue;
    }
    const auto alone = run_job(testing::toy_jobs(), path("toy.yaml"),
                               {{"seed", fields[1]}, {"x", fields[2]}, {"mode", fields[3]}});
    if (!alone) {
      EXPECT_EQ(fields[4], "refused");
      EXPECT_EQ(fields[5], to_string(alone.error()));
      continue;
    }
    EXPECT_EQ(fields[4], alone->report.status);
    EXPECT_EQ(fields[5], alone->report.reason);
    EXPECT_EQ(std::stod(fields[6]), metric(alone->report, "y"));
    EXPECT_EQ(fields[7].empty(), fields[3] == "a");
  }
  EXPECT_EQ(count, all.total);
  EXPECT_EQ(statuses, (std::set<std::string>{"bug", "done", "not_done", "refused"}));
}

/// A planner that has no answer makes runs that are not done, even if it has none in any of them.
TEST_F(RunSweep, RunsWithoutAPathAreNotDone) {
  std::string text = table(sweep({.runs = 3, .seed = 5, .vary = {"x=0"}}), "out");
  std::string_view rest = text;
  EXPECT_EQ(take_line(rest), "run,seed,x,status,reason");
  for (int i = 0; i < 3; ++i) {
    const auto fields = csv_fields(take_line(rest));
    ASSERT_EQ(fields.size(), 5U);
    EXPECT_EQ(fields[3], "not_done");
    EXPECT_EQ(fields[4], "there is no path to 0");
  }
}

TEST_F(RunSweep, ASweepThatWasStoppedIsContinued) {
  const Sweep all = sweep(toy_request());
  const std::string once = table(all, "once");
  ASSERT_TRUE(begin_sweep(manifest(all), path("out")));
  std::stop_source stop;
  const auto stopped = compute_chunks(all, {.folder = path("out"), .end_chunk = all.chunks()},
                                      {stop.get_token(), [&](const SweepProgress& now) {
                                         if (now.done == 30) stop.request_stop();
                                       }});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, FaultCode::cancelled);
  const auto missing = missing_chunks(all, path("out"));
  EXPECT_EQ(missing.front(), 4U);
  EXPECT_FALSE(merge(all, "out"));
  EXPECT_EQ(table(all, "out"), once);
}

TEST_F(RunSweep, AChunkThatCannotBeWrittenEndsTheSweep) {
  const Sweep all = sweep(toy_request());
  for (const std::uint64_t chunk :
       {std::uint64_t{0}, all.chunks() - 1}) {  // one while others follow, and the last
    ASSERT_TRUE(begin_sweep(manifest(all), path("out")));
    const auto taken_away = [&](const SweepProgress&) { std::filesystem::remove_all(path("out/chunks")); };
    const auto computed = compute_chunks(
        all, {.folder = path("out"), .first_chunk = chunk, .end_chunk = all.chunks()}, {{}, taken_away});
    ASSERT_FALSE(computed);
    EXPECT_TRUE(computed.error().where.starts_with(path("out/chunks/"))) << to_string(computed.error());
  }
  EXPECT_EQ(table(all, "out"), table(all, "once"));
}

TEST_F(RunSweep, ChunksThatOthersComputeAreLeftToThem) {
  const Sweep all = sweep(toy_request());
  ASSERT_TRUE(begin_sweep(manifest(all), path("out")));
  {
    const auto lock = FileLock::take(path("out/chunks/000002.csv.lock"));
    ASSERT_TRUE(lock && lock->held());
    const auto others = compute_chunks(all, {.folder = path("out"), .end_chunk = all.chunks()});
    ASSERT_TRUE(others);
    EXPECT_EQ(*others, std::vector<std::uint64_t>{2});
    EXPECT_EQ(missing_chunks(all, path("out")), std::vector<std::uint64_t>{2});
  }
  EXPECT_EQ(table(all, "out"), table(all, "once"));
}

TEST_F(RunSweep, ALockThatAKilledProcessLeftGoesAway) {
  const Sweep all = sweep(toy_request());
  const std::string whole = table(all, "out");
  write("out/chunks/000001.csv.lock", "");  // killed before it took the lock away
  write("out/chunks/000002.csv.lock", "");  // killed before its chunk was there
  std::filesystem::remove(path("out/chunks/000002.csv"));
  EXPECT_EQ(table(all, "out"), whole);
  EXPECT_FALSE(file_exists(path("out/chunks/000001.csv.lock")));
  EXPECT_FALSE(file_exists(path("out/chunks/000002.csv.lock")));
}

TEST_F(RunSweep, ADamagedChunkIsRefusedByItsName) {
  const Sweep all = sweep(toy_request());
  const std::string whole = table(all, "out");
  const std::string second = read_file(path("out/chunks/000001.csv")).value_or("");
  std::string changed = second;
  changed[changed.find("\n7,") + 1] = '8';
  const std::string third = read_file(path("out/chunks/000002.csv")).value_or("");
  for (const std::string& bad : {std::string(), std::string("\n# "), second.substr(0, second.size() / 2),
                                 second.substr(0, second.size() - 1), second + "x", changed, third}) {
    write("out/chunks/000001.csv", bad);
    const auto merged = merge(all, "out");
    ASSERT_FALSE(merged) << bad;
    EXPECT_EQ(merged.error().where, path("out/chunks/000001.csv"));
    EXPECT_NE(merged.error().sentence.find("damaged"), std::string::npos);
    EXPECT_EQ(read_file(path("out/table.csv")).value_or(""), whole) << "the old table stays";
    EXPECT_FALSE(file_exists(path("out/table.part")));
  }
  std::filesystem::remove(path("out/chunks/000001.csv"));
  EXPECT_EQ(table(all, "out"), whole);
}

/// Each of these sweeps has whole chunks of the same names; none may become part of the table of another.
TEST_F(RunSweep, AChunkOfAnotherSweepIsRefusedBeforeAnyRun) {
  const Sweep all = sweep(toy_request());
  const std::string whole = table(all, "out");
  std::vector<std::pair<SweepRequest, std::string>> others(6, {toy_request(), ""});
  others[0].first.seed = 6;
  others[0].second = "the seed of its first run ('";
  others[1].first.vary[0] = "x=uniform(0,9)";
  others[1].second = "the x of its first run ('";
  others[2].first.vary = {"x=uniform(0,10)"};
  others[2].second = "the keys that vary";
  others[3].first.chunk_runs = 8;
  others[3].second = "the number of its first run ('8' there, '7' here)";
  others[4].first.runs = 61;
  others[4].second = "--runs";
  others[5].second = "a file that the scenario reads";
  std::filesystem::rename(path("out/chunks/000003.csv"), path("mine.csv"));
  for (std::size_t i = 0; i < others.size(); ++i) {
    SCOPED_TRACE(others[i].second);
    if (i == 5) write("input.txt", "b\n");
    const std::string folder = "other" + std::to_string(i);
    ASSERT_FALSE(table(sweep(others[i].first), folder).empty());
    std::filesystem::copy_file(path(folder + "/chunks/000001.csv"), path("out/chunks/000001.csv"),
                               std::filesystem::copy_options::overwrite_existing);
    int runs = 0;
    const auto computed = compute_chunks(all, {.folder = path("out"), .end_chunk = all.chunks()},
                                         {{}, [&](const SweepProgress&) { ++runs; }});
    std::filesystem::copy_file(path("mine.csv"), path("out/chunks/000003.csv"));
    const auto merged = merge(all, "out");
    std::filesystem::remove(path("out/chunks/000003.csv"));
    ASSERT_FALSE(computed);
    ASSERT_FALSE(merged);
    EXPECT_EQ(runs, 0);
    EXPECT_EQ(computed.error().sentence, merged.error().sentence);
    EXPECT_EQ(computed.error().where, path("out/chunks/000001.csv"));
    EXPECT_NE(computed.error().sentence.find("differs in "), std::string::npos);
    EXPECT_NE(computed.error().sentence.find(others[i].second), std::string::npos)
        << computed.error().sentence;
    EXPECT_NE(computed.error().sentence.find("remove the chunk"), std::string::npos);
    EXPECT_EQ(read_file(path("out/table.csv")).value_or(""), whole) << "the old table stays";
  }
  write("input.txt", "a\n");
  std::filesystem::remove(path("out/chunks/000001.csv"));
  EXPECT_EQ(table(all, "out"), whole);
}

TEST_F(RunSweep, AFolderWithOtherFilesIsLeftAlone) {
  const Sweep all = sweep(toy_request());
  write("out.txt", "mine");
  const auto begun = begin_sweep(manifest(all), home_.string());
  ASSERT_FALSE(begun);
  EXPECT_NE(begun.error().sentence.find("name an empty folder"), std::string::npos);
}

TEST_F(RunSweep, CsvFieldsComeBack) {
  const std::vector<std::string> fields = {"a", "", "b,c", "say \"no\"", "", "\"", "#"};
  std::string line = csv_line(fields);
  line.pop_back();
  EXPECT_EQ(csv_fields(line), fields);
  EXPECT_TRUE(csv_fields("a,\"b").empty());
}

TEST(TimeLeft, IsAnIntervalAboutTheMean) {
  EXPECT_FALSE(time_left({.done = 7, .left = 10, .elapsed_s = 1.0, .run_s = 1.0, .run_squares = 1.0}));
  // 100 runs of 2 s on 4 threads; 50 are left: 25 s, without any doubt.
  const auto even =
      time_left({.done = 100, .left = 50, .elapsed_s = 50.0, .run_s = 200.0, .run_squares = 400.0});
  ASSERT_TRUE(even);
  EXPECT_NEAR(even->low_s, 25.0, 1e-9);
  EXPECT_NEAR(even->high_s, 25.0, 1e-9);
}

/// The interval of 95 % holds what the runs that are left take.
TEST(TimeLeft, IsRightAsOftenAsItSays) {
  Rng rng(3);
  int right = 0;
  constexpr int trials = 400;
  for (int i = 0; i < trials; ++i) {
    SweepProgress now{.left = 100};
    for (int k = 0; k < 60; ++k) {
      const double run_s = -std::log(1.0 - rng.uniform());
      ++now.done;
      now.run_s += run_s;
      now.run_squares += run_s * run_s;
    }
    now.elapsed_s = now.run_s;
    double rest_s = 0.0;
    for (int k = 0; k < 100; ++k) rest_s -= std::log(1.0 - rng.uniform());
    const auto left = time_left(now);
    right += left->low_s <= rest_s && rest_s <= left->high_s ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(right) / trials, 0.95, 0.03);
}

}  // namespace
}  // namespace outrider
