// Localisation and mapping with laser scans, and with landmarks.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "mapper.hpp"
#include "occupancy.hpp"
#include "options.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

template <class Matrix>
py::array_t<double> matrix_of(const Matrix& matrix) {
  py::array_t<double> result(
      {py::ssize_t{Matrix::RowsAtCompileTime}, py::ssize_t{Matrix::ColsAtCompileTime}});
  auto to = result.mutable_unchecked<2>();
  for (int i = 0; i < matrix.rows(); ++i) {
    for (int j = 0; j < matrix.cols(); ++j) to(i, j) = matrix(i, j);
  }
  return result;
}

LaserScan make_scan(const py::handle& ranges, double first_rad, double step_rad, double least_m,
                    double most_m, double time_s) {
  LaserScan scan{time_s, first_rad, step_rad, least_m, most_m, ranges_of(ranges, "ranges")};
  require(check(scan));
  return scan;
}

std::vector<Option> options_of(LaserSlamOptions& options) {
  return joined(describe(options), prefixed("map_", describe(options.map)));
}

std::unique_ptr<Laser> begin_laser(const py::handle& start, const py::kwargs& values) {
  LaserSlamOptions options;
  set_options(options_of(options), values);
  return std::make_unique<Laser>(value_of(LaserSlam::begin(options, pose_of(start, "start"))));
}

std::unique_ptr<Landmarks> begin_landmarks(const py::handle& start, const py::kwargs& values) {
  LandmarkSlamOptions options;
  set_options(describe(options), values);
  return std::make_unique<Landmarks>(value_of(LandmarkSlam::begin(options, pose_of(start, "start"))));
}

py::dict advance_laser(Laser& mapper, const py::handle& motion, const LaserScan& scan) {
  const Pose2 moved = pose_of(motion, "motion");
  const LaserSlamStep step = value_of(mapper.with([&](LaserSlam& slam) {
    auto done = slam.advance(moved, scan);
    if (done) mapper.changes.note(done->update, slam.map().occupancy().cells.size());
    return done;
  }));
  py::dict result;
  result["pose"] = array_of(step.pose);
  result["matched"] = step.matched;
  result["lost"] = step.lost;
  result["closed_loop"] = step.closed_loop;
  return result;
}

void settle(Laser& mapper) {
  mapper.with([&](LaserSlam& slam) {
    slam.settle();
    mapper.changes.note({true, {}}, 0);
  });
}

LogStep step_of(const py::handle& odometry, const py::handle& covariance, const py::handle& positions,
                const py::handle& covariances, const py::object& ids) {
  LogStep step;
  step.odometry = pose_of(odometry, "odometry");
  const std::vector<double> noise = numbers_of_shape(covariance, {3, 3}, "covariance");
  for (int i = 0; i < 9; ++i) step.covariance(i / 3, i % 3) = noise[static_cast<std::size_t>(i)];
  const std::vector<double> at = numbers_of_shape(positions, {-1, 2}, "positions");
  const std::vector<double> noises = numbers_of_shape(covariances, {-1, 2, 2}, "covariances");
  std::vector<std::int64_t> names;
  if (!ids.is_none()) names = integers_of_row(ids, "ids");
  const std::size_t count = at.size() / 2;
  if (noises.size() != 4 * count || (!ids.is_none() && names.size() != count)) {
    refuse(fmt::format("{} positions with {} covariances and {} ids; give one for each", count,
                       noises.size() / 4, names.size()),
           "positions");
  }
  for (std::size_t i = 0; i < count; ++i) {
    LandmarkSighting sighting{{}, {at[2 * i], at[2 * i + 1]}};
    if (!names.empty()) sighting.id = names[i];
    sighting.covariance << noises[4 * i], noises[4 * i + 1], noises[4 * i + 2], noises[4 * i + 3];
    step.sightings.push_back(sighting);
  }
  return step;
}

py::dict advance_landmarks(Landmarks& mapper, const py::handle& odometry, const py::handle& covariance,
                           const py::handle& positions, const py::handle& covariances,
                           const py::object& ids) {
  const LogStep step = step_of(odometry, covariance, positions, covariances, ids);
  const StepOutcome outcome = value_of(mapper.with([&](LandmarkSlam& slam) { return slam.advance(step); }));
  py::dict result;
  result["used"] = outcome.used;
  result["refused"] = outcome.refused;
  result["waiting"] = outcome.waiting;
  result["added"] = outcome.added;
  result["removed"] = outcome.removed;
  result["lost"] = outcome.lost;
  return result;
}

py::dict landmarks_of(Landmarks& mapper) {
  const LandmarkMap map = mapper.with([](LandmarkSlam& slam) { return slam.landmarks(); });
  const auto count = static_cast<py::ssize_t>(map.size());
  py::array_t<std::int64_t> ids(count), sightings(count);
  py::array_t<double> covariances({count, py::ssize_t{2}, py::ssize_t{2}});
  std::vector<Vec2> positions;
  for (py::ssize_t i = 0; i < count; ++i) {
    const LandmarkEstimate& landmark = map[static_cast<std::size_t>(i)];
    ids.mutable_at(i) = landmark.id;
    sightings.mutable_at(i) = landmark.sightings;
    positions.push_back(landmark.position);
    for (int j = 0; j < 4; ++j) covariances.mutable_at(i, j / 2, j % 2) = landmark.covariance(j / 2, j % 2);
  }
  py::dict result;
  result["id"] = ids;
  result["position"] = array_of(positions);
  result["covariance"] = covariances;
  result["sightings"] = sightings;
  return result;
}

/// Binds the estimates that both mappers give.
template <class Class>
void bind_estimates(Class& type) {
  using M = typename Class::type;
  type.def_property_readonly(
          "pose",
          [](M& mapper) { return array_of(mapper.with([](auto& slam) { return Pose2(slam.pose()); })); })
      .def_property_readonly(
          "covariance",
          [](M& mapper) { return matrix_of(mapper.with([](auto& slam) { return slam.pose_covariance(); })); })
      .def_property_readonly("trajectory", [](M& mapper) {
        return array_of(mapper.with([](auto& slam) { return slam.trajectory(); }));
      });
}

void bind_laser(py::module_& module) {
  py::class_<LaserScan>(module, "LaserScan")
      .def(py::init(&make_scan), py::arg("ranges"), py::kw_only(), py::arg("first"), py::arg("step"),
           py::arg("least"), py::arg("most"), py::arg("time") = 0.0)
      .def_property_readonly("ranges",
                             [](const LaserScan& scan) {
                               return py::array_t<float>(static_cast<py::ssize_t>(scan.ranges_m.size()),
                                                         scan.ranges_m.data());
                             })
      .def_readonly("first", &LaserScan::first_rad)
      .def_readonly("step", &LaserScan::step_rad)
      .def_readonly("least", &LaserScan::least_m)
      .def_readonly("most", &LaserScan::most_m)
      .def_readonly("time", &LaserScan::time_s);
  LaserSlamOptions options;
  py::class_<Laser> laser(module, "LaserSlam", options_text(options_of(options)).c_str());
  laser.def(py::init(&begin_laser), py::arg("start") = py::make_tuple(0.0, 0.0, 0.0))
      .def("advance", &advance_laser, py::arg("motion"), py::arg("scan"))
      .def("settle", &settle)
      .def_property_readonly(
          "map", [](Laser& mapper) { return mapper.with([&](LaserSlam&) { return mapper.snapshot(); }); })
      .def_property_readonly(
          "graph",
          [](Laser& mapper) { return mapper.with([](LaserSlam& slam) { return slam.pose_graph(); }); })
      .def_property_readonly(
          "loops", [](Laser& mapper) { return mapper.with([](LaserSlam& slam) { return slam.loops(); }); });
  bind_estimates(laser);
}

}  // namespace

void bind_slam(py::module_& module) {
  bind_laser(module);
  LandmarkSlamOptions options;
  py::class_<Landmarks> landmarks(module, "LandmarkSlam", options_text(describe(options)).c_str());
  landmarks.def(py::init(&begin_landmarks), py::arg("start") = py::make_tuple(0.0, 0.0, 0.0))
      .def_static(
          "load",
          [](const std::string& state) {
            return std::make_unique<Landmarks>(value_of(LandmarkSlam::load(state)));
          },
          py::arg("state"))
      .def("advance", &advance_landmarks, py::arg("odometry"), py::arg("covariance"), py::kw_only(),
           py::arg("positions"), py::arg("covariances"), py::arg("ids") = py::none())
      .def("settle", [](Landmarks& mapper) { mapper.with([](LandmarkSlam& slam) { slam.settle(); }); })
      .def_property_readonly("landmarks", &landmarks_of)
      .def_property_readonly(
          "cost",
          [](Landmarks& mapper) { return mapper.with([](LandmarkSlam& slam) { return slam.cost(); }); })
      .def_property_readonly("state", [](Landmarks& mapper) {
        return mapper.with([](LandmarkSlam& slam) { return slam.state(); });
      });
  bind_estimates(landmarks);
}

}  // namespace outrider::python
