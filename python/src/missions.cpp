// The missions of exploring, covering, driving and pursuing.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "interruptible.hpp"
#include "occupancy.hpp"
#include "options.hpp"
#include "outrider/estimate/planar_pnp.hpp"
#include "outrider/jobs/cover/mission/mission.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "outrider/jobs/drive/job.hpp"
#include "outrider/jobs/drive/mission/mission.hpp"
#include "outrider/jobs/explore/mission/mission.hpp"
#include "outrider/jobs/pursue/scenario.hpp"
#include "outrider/jobs/pursue/wall_watch.hpp"
#include "scenario.hpp"
#include "turn.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

/// An exploration that one thread steps at a time.
class Exploration {
 public:
  Exploration(const py::handle& start, const py::kwargs& values) : mission_(begun(start, values)) {}

  std::optional<Command> step(const Observation& seen) {
    const auto turn = turn_.take("mission");
    const py::gil_scoped_release others_may_run;
    return mission_.step(seen);
  }
  template <class Read>
  auto read(Read what) {
    const auto turn = turn_.take("mission");
    return what(mission_);
  }
  static std::vector<Option> options(ExploreTask& task) {
    std::vector<Option> options = joined(describe(task.explore), describe(task.rules));
    options = joined(std::move(options), prefixed("robot_", describe(task.robot)));
    options = joined(std::move(options), prefixed("slam_", describe(task.slam)));
    return joined(std::move(options), prefixed("map_", describe(task.slam.map)));
  }

 private:
  static ExploreMission begun(const py::handle& start, const py::kwargs& values) {
    ExploreTask task;
    task.start = pose_of(start, "start");
    set_options(options(task), values);
    return value_of(begin(task));
  }

  ExploreMission mission_;
  Turn turn_;
};

std::string text_of(DriveEnd end) {
  switch (end) {
    case DriveEnd::none: return "";
    case DriveEnd::done: return "done";
    case DriveEnd::unconfirmed: return "unconfirmed";
    case DriveEnd::doubtful: return "doubtful";
    case DriveEnd::lost: return "lost";
    case DriveEnd::stuck: return "stuck";
  }
  return "";
}

DriveTask wheel_task(const py::handle& path, const py::dict& set) {
  const auto job = load_task_of<DriveJob>(path, std::nullopt, set);
  if (job->scenario.loop == "laser")
    refuse("a drive by laser is simulated only, by run(); here give closed or open", "loop");
  return job->setup->task;
}

/// A drive that one thread steps at a time.
class Driving {
 public:
  Driving(const py::handle& path, const py::dict& set) : mission_(begin(wheel_task(path, set))) {}

  std::optional<Command> step(Observation seen) {
    const auto turn = turn_.take("mission");
    if (!(seen.time_s >= last_s_))
      refuse(fmt::format("{} s comes after {} s; time goes on", seen.time_s, last_s_), "time");
    last_s_ = seen.time_s;
    const py::gil_scoped_release others_may_run;
    if (seen.image) add_poses(*seen.image);
    return mission_.step(seen);
  }
  template <class Read>
  auto read(Read what) {
    const auto turn = turn_.take("mission");
    return what(mission_);
  }

 private:
  void add_poses(TagImage& image) const {
    const DriveTask& task = mission_.task;
    std::erase_if(image.sightings, [&](TagSighting& one) {
      const Tag* const tag = task.tags.find(one.id);
      const double size_m = tag != nullptr ? tag->size_m : default_tag_size_m;
      one.family = task.tags.family;
      one.poses = planar_pnp(task.eye.camera, size_m, one.corners_px);
      return one.poses.empty();
    });
  }

  DriveMission mission_;
  double last_s_ = -std::numeric_limits<double>::infinity();
  Turn turn_;
};

/// Returns the corners of each tag in the world by id, in the order of AprilTag.
py::dict tags_of(const DriveMission& mission) {
  py::dict tags;
  for (const Tag& tag : mission.task.tags.tags) {
    std::vector<double> numbers;
    for (const Vec3& corner : tag_corners(tag.size_m)) {
      const Vec3 at = tag.world_T_tag * corner;
      numbers.insert(numbers.end(), {at.x, at.y, at.z});
    }
    tags[py::int_(tag.id)] = array_of_shape({4, 3}, numbers.data());
  }
  return tags;
}

py::dict camera_of(const DriveMission& mission) {
  const TagEye& eye = mission.task.eye;
  py::dict camera;
  camera["width"] = eye.camera.width_px;
  camera["height"] = eye.camera.height_px;
  camera["matrix"] = array_of_shape(
      {3, 3},
      std::array{eye.camera.fx, 0.0, eye.camera.cx, 0.0, eye.camera.fy, eye.camera.cy, 0.0, 0.0, 1.0}.data());
  camera["distortion"] = array_of_shape({5}, eye.camera.distortion.data());
  camera["ahead"] = eye.ahead_m;
  camera["above"] = eye.height_m;
  return camera;
}

py::list arrivals_of(const DriveMission& mission) {
  py::list arrivals;
  for (const DriveArrival& one : mission.arrivals) {
    py::dict arrival;
    arrival["waypoint"] = one.waypoint;
    arrival["time"] = one.time_s;
    arrival["pose"] = array_of(one.belief.world_T_robot);
    arrival["doubt"] = one.doubt;
    arrivals.append(arrival);
  }
  return arrivals;
}

py::array_t<double> waypoints_of(const DriveMission& mission) {
  std::vector<Pose2> poses;
  for (const Waypoint& waypoint : mission.task.waypoints) poses.push_back(waypoint.pose);
  return array_of(poses);
}

py::tuple twist_of_wheels(const DriveMission& mission, const py::handle& speeds) {
  const std::vector<double> given = numbers_of_shape(speeds, {py::ssize_t{most_wheels}}, "speeds");
  WheelSpeeds4 wheels{};
  std::ranges::copy(given, wheels.begin());
  const Twist2 twist = twist_of(mission.task.chassis, wheels);
  return py::make_tuple(twist.ahead_mps, twist.left_mps, twist.turn_radps);
}

/// A pursuit that one thread steps at a time.
class Pursuing {
 public:
  Pursuing(const PursuitProblem& map, const py::kwargs& values) : map_(map), rules_(rules(values)) {
    mission_.emplace(map_, map_.target.size(), rules_, watch_);
  }

  std::optional<Command> step(const Observation& seen) {
    const auto turn = turn_.take("mission");
    if (over_) return std::nullopt;
    check_seen(seen);
    auto command = interruptible([&](const std::stop_token& stop) {
      rules_.budget.stop = stop;
      return mission_->step(seen);
    });
    if (mission_->fault) throw FaultError{*mission_->fault};
    over_ = !command;
    return command;
  }
  [[nodiscard]] PursuitRun run() {
    const auto turn = turn_.take("mission");
    return mission_->run;
  }
  [[nodiscard]] std::string status() {
    const auto turn = turn_.take("mission");
    if (!over_) return "";
    return mission_->run.state.caught ? "done" : "not_done";
  }
  [[nodiscard]] std::string reason() {
    if (status() != "not_done") return "";
    const int now_s = run().state.time_s;
    return now_s + 1 >= static_cast<int>(map_.target.size())
               ? fmt::format("the target was gone after {} s", now_s)
               : fmt::format("from second {} on no robot can catch the target", now_s);
  }
  static std::vector<Option> options(PursuitScenario& scenario) {
    std::vector<Option> options;
    for (const OptionGroup& group : describe(scenario)) {
      for (Option option : group.options) {
        if (group.name.empty() && (option.name == "map" || option.name == "starts" ||
                                   option.name == "pursuers" || option.name == "seed"))
          continue;
        if (!group.name.empty()) option.name = group.name + "_" + option.name;
        options.push_back(std::move(option));
      }
    }
    return options;
  }

 private:
  static PursuitRules rules(const py::kwargs& values) {
    PursuitScenario scenario;
    set_options(options(scenario), values);
    return value_of(rules_of(scenario));
  }

  /// Checks the properties that the mission relies on: the team keeps its size and stays on the map, and the
  /// cells of the target are known up to now.
  void check_seen(const Observation& seen) {
    if (!seen.grid) refuse("there are no cells; give a GridObservation each second", "grid");
    const GridObservation& grid = *seen.grid;
    const std::size_t team = mission_->run.state.robots.size();
    if (grid.robots.empty() || (team != 0 && grid.robots.size() != team))
      refuse(fmt::format("{} robots; give a cell for each one of the team, every time", grid.robots.size()),
             "robots");
    const GridFrame& frame = map_.costs->frame;
    for (const auto& [cells, name] : {std::pair{&grid.robots, "robots"}, {&grid.target, "target"}}) {
      for (const Cell cell : *cells) {
        if (!frame.contains(cell))
          refuse(fmt::format("({}, {}) is no cell of the map, which has {} x {}", cell.x, cell.y, frame.width,
                             frame.height),
                 name);
      }
    }
    const std::size_t now_s = team == 0 ? 0 : static_cast<std::size_t>(mission_->run.state.time_s) + 1;
    const std::size_t known = known_ + grid.target.size();
    if (known <= now_s || known > map_.target.size())
      refuse(fmt::format("{} cells of the target are known at second {}; give each one once, from second 0, "
                         "up to {} of them",
                         known, now_s, map_.target.size()),
             "target");
    known_ = known;
  }

  PursuitProblem map_;
  PursuitRules rules_;
  WallWatch watch_;
  std::optional<PursuitMission> mission_;
  std::size_t known_ = 0;
  bool over_ = false;
  Turn turn_;
};

void bind_pursuing(py::module_& module) {
  PursuitScenario scenario;
  py::class_<Pursuing>(module, "PursuitMission", options_text(Pursuing::options(scenario)).c_str())
      .def(py::init<const PursuitProblem&, const py::kwargs&>(), py::arg("problem"))
      .def("step", &Pursuing::step, py::arg("observation"))
      .def_property_readonly("status", &Pursuing::status)
      .def_property_readonly("reason", &Pursuing::reason)
      .def_property_readonly("caught", [](Pursuing& m) { return m.run().state.caught; })
      .def_property_readonly("time", [](Pursuing& m) { return m.run().state.time_s; })
      .def_property_readonly("cost", [](Pursuing& m) { return m.run().state.cost; })
      .def_property_readonly("lower_bound", [](Pursuing& m) { return m.run().lower_bound; })
      .def_property_readonly("paths", [](Pursuing& m) {
        py::list paths;
        for (const std::vector<Cell>& path : m.run().state.paths) paths.append(array_of(path));
        return paths;
      });
}

void bind_driving(py::module_& module) {
  const auto get = [](auto what) { return [what](Driving& drive) { return drive.read(what); }; };
  py::class_<Driving>(module, "DriveMission")
      .def(py::init<const py::handle&, const py::dict&>(), py::arg("scenario"), py::kw_only(),
           py::arg("set") = py::dict())
      .def("step", &Driving::step, py::arg("observation"))
      .def(
          "twist",
          [](Driving& drive, const py::handle& speeds) {
            return drive.read([&](const DriveMission& mission) { return twist_of_wheels(mission, speeds); });
          },
          py::arg("speeds"))
      .def_property_readonly("status", get([](const DriveMission& m) { return text_of(m.end); }))
      .def_property_readonly("reason", get([](const DriveMission& m) { return m.reason; }))
      .def_property_readonly(
          "pose", get([](const DriveMission& m) { return array_of(m.reckoning.belief.world_T_robot); }))
      .def_property_readonly("start", get([](const DriveMission& m) { return array_of(m.task.start); }))
      .def_property_readonly("waypoints", get(waypoints_of))
      .def_property_readonly("arrivals", get(arrivals_of))
      .def_property_readonly("tags", get(tags_of))
      .def_property_readonly("camera", get(camera_of));
}

void bind_exploring(py::module_& module) {
  ExploreTask task;
  const auto get = [](auto what) { return [what](Exploration& one) { return one.read(what); }; };
  py::class_<Exploration>(module, "ExploreMission", options_text(Exploration::options(task)).c_str())
      .def(py::init<const py::handle&, const py::kwargs&>(), py::arg("start") = py::make_tuple(0.0, 0.0, 0.0))
      .def("step", &Exploration::step, py::arg("observation"))
      .def_property_readonly("pose", get([](const ExploreMission& m) { return array_of(m.where().pose()); }))
      .def_property_readonly("stop_reason", get([](const ExploreMission& m) { return m.stop_reason(); }))
      .def_property_readonly("reason", get([](const ExploreMission& m) { return m.reason(); }))
      .def_property_readonly("home", get([](const ExploreMission& m) { return m.is_home(); }))
      .def_property_readonly("map", get([](const ExploreMission& m) {
                               return std::make_shared<Grid<std::uint8_t>>(m.explored_map());
                             }));
}

}  // namespace

void bind_missions(py::module_& module) {
  py::class_<CoverMission>(module, "CoverMission")
      .def(py::init([](const CoverPlan& plan, double pause) { return CoverMission(plan.track, pause); }),
           py::arg("plan"), py::kw_only(), py::arg("pause") = 0.0)
      .def("step", &CoverMission::step, py::arg("observation"));
  bind_exploring(module);
  bind_driving(module);
  bind_pursuing(module);
}

}  // namespace outrider::python
