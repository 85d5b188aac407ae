// The laws that every row of the catalogue of jobs keeps, and a job of one's own.
#include "job_contract.hpp"

#include "outrider/jobs/catalog.hpp"
#include "outrider/log/append.hpp"

namespace outrider {
namespace {

/// A small scenario of a job, and the files that its task leaves unread.
struct SmallScenario {
  std::string job;
  std::string text;  ///< of a scenario; SOURCE stands for the folder of scenarios
  std::set<std::string> unread = {};

  friend void PrintTo(const SmallScenario& row, std::ostream* out) { *out << row.job; }
};

const std::vector<SmallScenario>& small_scenarios() {
  static const std::vector<SmallScenario> rows = {
      {"cover", "area: SOURCE/cover/room.txt\nwidth: 0.4\n"},
      {"drive",
       "waypoints: \"0,0,0 1,0,0 1,1,180\"\ntags: \"1=2,1,180 2=1,2.5,-90\"\nfaults:\n  wheel_1: 0.985\n",
       {"map", "model_path"}},
      {"explore",
       "world: SOURCE/explore/leaking_yard.sdf\nstart: \"6.8,1.5,90\"\nrules:\n  most_time: 10\n",
       {"slices"}},
      {"fleet", "map: SOURCE/fleet/warehouse.map\nagents: SOURCE/fleet/warehouse.scen\n"},
      {"guard",
       "world: SOURCE/orchard/orchard.sdf\ntargets: SOURCE/orchard/targets.txt\nstart: \"0,-5,90\"\n"
       "plan:\n  resolution: 0.25\n  iterations: 20\n  refinements: 0\n",
       {"arrivals.list", "wander.history"}},
      {"plan",
       "map: SOURCE/maps/gallery.map\nfrom: \"1,1\"\nto: \"20,10\"\ncompare: true\n",
       {"model_path", "terrain"}},
      {"pursue", "map: SOURCE/pursuit/park.txt\nclock: virtual\n"},
      {"slam", "log: SOURCE/slam/posts.dat\ntruth: SOURCE/slam/posts_world.dat\n", {"resume"}},
  };
  return rows;
}

class JobContract : public testing::TestWithParam<SmallScenario> {
 protected:
  JobContract() {
    auto found = find_job(jobs(), GetParam().job);
    EXPECT_TRUE(found);
    job = *found;
    std::string text = "job: " + GetParam().job + "\n" + GetParam().text;
    const std::string scenarios = OUTRIDER_SOURCE_DIR "/scenarios";
    for (std::size_t at = 0; (at = text.find("SOURCE", at)) != std::string::npos;) {
      text.replace(at, 6, scenarios);
      at += scenarios.size();
    }
    scenario = folder.write("small.yaml", text);
  }

  test::Folder folder;
  Job job;
  std::string scenario;
};

INSTANTIATE_TEST_SUITE_P(Jobs, JobContract, testing::ValuesIn(small_scenarios()),
                         [](const auto& row) { return row.param.job; });

TEST(JobContracts, EveryJobHasASmallScenario) {
  std::set<std::string> known, named;
  for (const Job& job : jobs()) known.emplace(job.name);
  for (const SmallScenario& row : small_scenarios()) named.insert(row.job);
  EXPECT_EQ(named, known);
}

TEST_P(JobContract, StopsAtOnce) { test::stops_at_once(job, scenario); }
TEST_P(JobContract, StopsMidway) { test::stops_midway(job, scenario); }
TEST_P(JobContract, Repeats) { test::repeats(job, scenario); }
TEST_P(JobContract, TellsWhetherItIsSeeded) { test::tells_whether_it_is_seeded(job, scenario); }
TEST_P(JobContract, RefusesBadValues) { test::refuses_bad_values(job); }
TEST_P(JobContract, RefusesUnknownKeys) { test::refuses_unknown_keys(job); }
TEST_P(JobContract, RefusesMissingFiles) { test::refuses_missing_files(job, scenario, GetParam().unread); }
TEST_P(JobContract, OptionsRoundTrip) { test::options_round_trip(job, scenario); }

/// A job that is in no catalogue: counts.
class Count final : public JobTask {
 public:
  Count() : JobTask("count") {}
  Outcome<Warnings> load() override {
    if (list.empty()) return Warnings{};
    auto text = read_file(list);
    if (!text) return pass_on(text);
    return Warnings{};
  }
  Status run(Run& run, const RunWatch& watch) override {
    RunSteps steps(watch, 1);
    if (auto ok = steps.next("counting"); !ok) return ok;
    run.report.status = "done";
    for (std::int64_t i = 0; i < to && run.report.status == "done"; ++i) {
      const auto time_s = static_cast<double>(i);
      run.report.metrics = {{"count", time_s + 1.0}};
      log_event(run.log, time_s, "count", "one more");
      if (watch.stopped()) mark_cancelled(run.report, run.log, time_s);
    }
    return {};
  }

 protected:
  std::vector<OptionGroup> describe() override {
    return {{"",
             "the count",
             {{"to", "", 1, 100, "the last number", &to}, file_option("list", "file of names", &list)}},
            {"pace", "how fast", {{"turn", "deg", 0.1, 10.0, "angle of a number", &turn_rad}}}};
  }

 private:
  std::int64_t to = 3;
  std::string list;
  double turn_rad = 0.1;
};

TEST(JobContracts, AJobOfOnesOwnIsPutThroughThemToo) {
  const Job count{.name = "count", .sentence = "Count.", .blank = [] { return std::make_unique<Count>(); }};
  const test::Folder folder;
  test::job_contract(count, folder.write("count.yaml", "job: count\nto: 4\n"));
}

}  // namespace
}  // namespace outrider
