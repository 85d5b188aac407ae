// The job of examples/10_own_job.cpp keeps the contract of every job, without another file touched.
#include "job_contract.hpp"

namespace outrider {

Job patrol_job();  // examples/10_own_job.cpp, which is compiled into this program

namespace {

TEST(JobOfAStranger, KeepsTheContract) {
  const test::Folder folder;
  const std::string world = OUTRIDER_SOURCE_DIR "/scenarios/arena/arena.sdf";
  const std::string scenario =
      folder.write("patrol.yaml", "job: patrol\nworld: " + world +
                                      "\npoints: \"2.5,0.5 2.5,2.5 2.5,0.5 0.5,0.5\"\nrounds: 2\n");
  test::job_contract(patrol_job(), scenario);
}

}  // namespace
}  // namespace outrider
