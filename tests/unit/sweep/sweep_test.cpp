#include "outrider/sweep/sweep.hpp"

#include <fmt/format.h>

#include <set>

#include "sweep_job.hpp"

namespace outrider {
namespace {

using SweepTest = testing::SweepFolder;

TEST_F(SweepTest, EverySampleIsRunAtEveryPointAndOnBothSides) {
  const Sweep all = sweep({.runs = 5,
                           .seed = 3,
                           .vary = {"x=1,2,3", "file=choice(input.txt,other.txt)"},
                           .compare = {"mode=a,b"}});
  EXPECT_EQ(all.points, 3U);
  EXPECT_EQ(all.total, 30U);
  std::set<std::string> seen;
  for (std::uint64_t i = 0; i < all.total; ++i) {
    const SweepRun run = run_of(all, i);
    const SweepRun first = run_of(all, run.sample * 6);
    EXPECT_EQ(run.seed, first.seed);
    EXPECT_EQ(run.values[1], first.values[1]) << "random values belong to the sample";
    seen.insert(fmt::format("{} {} {}", run.sample, run.values[0], run.values[2]));
    EXPECT_EQ(run.values[2], i % 2 == 0 ? "a" : "b");
  }
  EXPECT_EQ(seen.size(), all.total);
}

TEST_F(SweepTest, SeedsAreChildrenOfTheSeed) {
  const Sweep all = sweep({.runs = 4, .seed = 9});
  for (std::uint64_t i = 0; i < 4; ++i) {
    EXPECT_EQ(run_of(all, i).seed, Rng(9).child(i).below(1'000'000'000'000'000));
    EXPECT_EQ(changes_of(all, run_of(all, i)).front().first, "seed");
  }
}

TEST_F(SweepTest, WhatCannotBeSweptIsRefusedWithItsKey) {
  struct Case {
    SweepRequest request;
    const char *where, *says;
  };
  std::string long_grid = "x=1";
  for (int i = 0; i < 2000; ++i) long_grid += ",1";
  std::string other_grid = "mode" + long_grid.substr(1);
  for (const Case& one :
       {Case{{.runs = 0}, "--runs", "from 1"}, Case{{.runs = 1'000'000'000'000}, "--runs", "10000000"},
        Case{{.vary = {"y=1"}}, "y", "no option 'y'"}, Case{{.vary = {"x=1,11"}}, "x", "'11'"},
        Case{{.vary = {"x=uniform(1,11)"}}, "x", "'11'"}, Case{{.vary = {"x=1", "x=2"}}, "x", "twice"},
        Case{{.vary = {"x=1"}, .compare = {"x=1,2"}}, "x", "twice"},
        Case{{.vary = {"seed=1,2"}}, "seed", "--seed"}, Case{{.vary = {"job=toy"}}, "job", "one job"},
        Case{{.compare = {"x=1,2,3"}}, "--compare", "two different"},
        Case{{.compare = {"x=2,2"}}, "--compare", "two different"},
        Case{{.runs = 5, .vary = {long_grid, other_grid}}, "mode", "too many points"},
        Case{{.runs = 10'000'000, .vary = {"x=1,2"}}, "x", "too many points"},
        Case{{.runs = 10'000'000, .compare = {"x=1,2"}}, "--runs", "half"},
        Case{{.chunk_runs = 0}, "--chunk-runs", "from 1"}}) {
    SweepRequest request = one.request;
    request.scenario = path("toy.yaml");
    const auto made = prepare_sweep(testing::toy_jobs(), request);
    ASSERT_FALSE(made) << one.where;
    EXPECT_EQ(made.error().where, one.where);
    EXPECT_NE(made.error().sentence.find(one.says), std::string::npos) << made.error().sentence;
  }
}

}  // namespace
}  // namespace outrider
