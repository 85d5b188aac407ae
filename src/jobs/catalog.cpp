#include "outrider/jobs/catalog.hpp"

#include "outrider/jobs/cover/job.hpp"
#include "outrider/jobs/drive/job.hpp"
#include "outrider/jobs/explore/job.hpp"
#include "outrider/jobs/fleet/job.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/plan/job.hpp"
#include "outrider/jobs/pursue/job.hpp"
#include "outrider/jobs/slam/job.hpp"

namespace outrider {

const std::vector<Job>& jobs() {
  static const std::vector<Job> all = {cover_job(), drive_job(), explore_job(), fleet_job(),
                                       guard_job(), plan_job(),  pursue_job(),  slam_job()};
  return all;
}

Outcome<Run> run_job(const std::string& scenario_path, const Changes& changes, const RunWatch& watch) {
  return run_job(jobs(), scenario_path, changes, watch);
}

}  // namespace outrider
