// Mapping with a laser, as scans grow in number: a robot that goes to and fro in a room of known walls.
#include <stdexcept>

#include "outrider/slam/laser/laser_slam.hpp"
#include "outrider/slam/map/map_check.hpp"
#include "subject.hpp"
#include "unit/slam/laser_room.hpp"
#include "work.hpp"

namespace outrider::growth {
namespace {

struct LaserRun {
  testing::Drive truth;
  std::vector<LaserScan> scans;
};

LaserRun to_and_fro(int count) {
  Rng rng = stream("laser", 0);
  std::vector<Vec2> corners{{0.5, 0.5}};
  LaserRun drive;
  while (drive.truth.poses.size() < static_cast<std::size_t>(count)) {
    corners.push_back(corners.size() % 2 == 1 ? Vec2{2.4, 0.5} : Vec2{0.5, 0.5});
    Rng errors = stream("odometry", 0);
    drive.truth = testing::drive_along(corners, 0.0, errors);
  }
  drive.truth.poses.resize(static_cast<std::size_t>(count));
  drive.truth.motions.resize(static_cast<std::size_t>(count));
  testing::Finder finder;
  finder.beams = 90;
  finder.step_rad *= 4.0;
  const std::vector<testing::Wall> walls = testing::furnished_room();
  for (const Pose2& pose : drive.truth.poses) drive.scans.push_back(scan_from(walls, pose, finder, rng));
  return drive;
}

std::vector<double> drawn_map(int count) {
  const LaserRun drive = to_and_fro(count);
  const Work work = work_of([&] {
    OccupancyMap map{OccupancyMapOptions{}};
    for (std::size_t i = 0; i < drive.scans.size(); ++i) map.insert(drive.truth.poses[i], drive.scans[i]);
  });
  return {work.blocks, work.peak_bytes};
}

std::vector<double> checked_map(int count) {
  const LaserRun drive = to_and_fro(count);
  std::vector<PlacedScan> scans;
  for (std::size_t i = 0; i < drive.scans.size(); ++i)
    scans.push_back({&drive.scans[i], drive.truth.poses[i], 0.04 * static_cast<double>(i), i});
  const Work work = work_of([&] { (void)check_map(scans); });
  return {work.blocks, work.peak_bytes};
}

std::vector<double> laser_mapped(int count) {
  const LaserRun drive = to_and_fro(count);
  LaserSlamOptions options;
  options.close_loops = false;  // each loop takes an optimisation of the graph
  LaserSlam slam = std::move(LaserSlam::begin(options, drive.truth.poses.front()).value());
  const Work work = work_of([&] {
    for (std::size_t i = 0; i < drive.scans.size(); ++i)
      (void)slam.advance(drive.truth.motions[i], drive.scans[i]).value();
  });
  return {work.blocks, work.peak_bytes};
}

/// The points of a scan cost as much as the poses of thousands of scans before.
double scans_and_some_pairs(double n) { return n + n * n / 5000.0; }

}  // namespace

std::vector<Subject> laser_subjects() {
  const std::vector<int> sizes{64, 128, 256, 512};
  return {{"occupancy map",
           "scans",
           "slam/map/occupancy_map.hpp",
           sizes,
           {{"blocks", "O(cells crossed) a scan", linear},
            {"peak bytes", "none is stated; held to the room", constant}},
           drawn_map},
          {"check_map",
           "scans",
           "slam/map/map_check.hpp",
           sizes,
           {{"blocks", "O(scans^2) distances and O(beams) for ten pairs per scan", squared},
            {"peak bytes", "none is stated; held to the scans", linear}},
           checked_map},
          {"laser SLAM without loops, all steps",
           "scans",
           "slam/laser/laser_slam.hpp",
           {256, 512, 1024, 2048},
           {{"blocks", "the points of a scan, and for a keyframe the poses of those before",
             scans_and_some_pairs},
            {"peak bytes", "none is stated; held to the scans", linear}},
           laser_mapped}};
}

}  // namespace outrider::growth
