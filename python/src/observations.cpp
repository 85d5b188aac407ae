// The measurements of robots in the form that missions take.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

double finite_of(double value, const char* name, const char* remedy) {
  if (std::isfinite(value)) return value;
  refuse(fmt::format("{} is no {}; give {}", value, name, remedy), name);
}

double level_of(double value, const char* name) {
  if (!std::isnan(value)) return value;
  refuse("nan is no level; give a number, inf for an unlimited store", name);
}

/// Sightings without poses: DriveMission computes those, since it knows the camera and the sizes of the tags.
TagImage make_image(double taken_s, const std::map<int, py::object>& corners) {
  TagImage image{finite_of(taken_s, "taken", "seconds"), {}};
  for (const auto& [id, points] : corners) {
    const std::vector<double> px = numbers_of_shape(points, {4, 2}, "corners");
    TagSighting sighting;
    sighting.id = id;
    for (std::size_t i = 0; i < 4; ++i) sighting.corners_px[i] = {px[2 * i], px[2 * i + 1]};
    image.sightings.push_back(std::move(sighting));
  }
  return image;
}

py::dict corners_of(const TagImage& image) {
  py::dict corners;
  for (const TagSighting& one : image.sightings)
    corners[py::int_(one.id)] = array_of(std::vector<Vec2>(one.corners_px.begin(), one.corners_px.end()));
  return corners;
}

Observation make_observation(double time_s, const py::handle& odometry, const std::optional<LaserScan>& scan,
                             bool touching, std::optional<double> touch_rad,
                             const std::optional<TagImage>& image, const py::object& gun,
                             const std::vector<ShotResult>& shots, const std::optional<StoreLevels>& stores,
                             const std::optional<TargetReport>& targets,
                             const std::optional<GridObservation>& grid) {
  Observation seen{finite_of(time_s, "time", "seconds"), pose_of(odometry, "odometry")};
  seen.scan = scan;
  seen.touching = touching;
  if (touch_rad) seen.touch_rad = finite_of(*touch_rad, "touch", "a bearing in rad");
  seen.image = image;
  if (!gun.is_none()) {
    const Vec2 angles = point_of(gun, "gun");
    seen.gun = GunState{angles.x, angles.y};
  }
  seen.shots = shots;
  seen.stores = stores;
  seen.targets = targets;
  seen.grid = grid;
  return seen;
}

void bind_targets(py::module_& module) {
  py::class_<ShotResult>(module, "ShotResult")
      .def(py::init([](std::size_t target, bool hit, double landed) {
             return ShotResult{target, hit, finite_of(landed, "landed", "seconds")};
           }),
           py::kw_only(), py::arg("target"), py::arg("hit"), py::arg("landed"))
      .def_readonly("target", &ShotResult::target)
      .def_readonly("hit", &ShotResult::hit)
      .def_readonly("landed", &ShotResult::landed_s);
  py::class_<TargetArrival>(module, "TargetArrival")
      .def(py::init([](std::size_t target, std::size_t place, double settles) {
             return TargetArrival{target, finite_of(settles, "settles", "seconds"), place};
           }),
           py::kw_only(), py::arg("target"), py::arg("place"), py::arg("settles"))
      .def_readonly("target", &TargetArrival::target)
      .def_readonly("place", &TargetArrival::place)
      .def_readonly("settles", &TargetArrival::settles_s);
  py::class_<TargetObservation>(module, "TargetObservation")
      .def(py::init([](std::size_t target, double time, const py::handle& position) {
             return TargetObservation{target, finite_of(time, "time", "seconds"),
                                      point_of(position, "position")};
           }),
           py::kw_only(), py::arg("target"), py::arg("time"), py::arg("position"))
      .def_readonly("target", &TargetObservation::target)
      .def_readonly("time", &TargetObservation::time_s)
      .def_property_readonly("position", [](const TargetObservation& one) {
        return py::make_tuple(one.position.x, one.position.y);
      });
  py::class_<TargetReport>(module, "TargetReport")
      .def(py::init([](std::vector<TargetArrival> arrivals, std::vector<TargetObservation> seen,
                       bool more_to_come) {
             return TargetReport{std::move(arrivals), std::move(seen), more_to_come};
           }),
           py::kw_only(), py::arg("arrivals") = std::vector<TargetArrival>(),
           py::arg("seen") = std::vector<TargetObservation>(), py::arg("more_to_come") = false)
      .def_readonly("arrivals", &TargetReport::arrivals)
      .def_readonly("seen", &TargetReport::seen)
      .def_readonly("more_to_come", &TargetReport::more_to_come);
}

void bind_devices(py::module_& module) {
  py::class_<TagImage>(module, "TagImage")
      .def(py::init(&make_image), py::kw_only(), py::arg("taken"), py::arg("corners"))
      .def_readonly("taken", &TagImage::taken_s)
      .def_property_readonly("corners", &corners_of);
  py::class_<StoreLevels>(module, "StoreLevels")
      .def(py::init([](double water, double charge) {
             return StoreLevels{level_of(water, "water"), level_of(charge, "charge")};
           }),
           py::kw_only(), py::arg("water") = unlimited, py::arg("charge") = unlimited)
      .def_readonly("water", &StoreLevels::water)
      .def_readonly("charge", &StoreLevels::charge_j);
  py::class_<GridObservation>(module, "GridObservation")
      .def(py::init([](const py::handle& robots, const py::handle& target) {
             return GridObservation{cell_list_of(robots, "robots"), cell_list_of(target, "target")};
           }),
           py::kw_only(), py::arg("robots"), py::arg("target"))
      .def_property_readonly("robots", [](const GridObservation& grid) { return array_of(grid.robots); })
      .def_property_readonly("target", [](const GridObservation& grid) { return array_of(grid.target); });
}

}  // namespace

void bind_observations(py::module_& module) {
  bind_targets(module);
  bind_devices(module);
  py::class_<Observation>(module, "Observation")
      .def(py::init(&make_observation), py::kw_only(), py::arg("time"), py::arg("odometry"),
           py::arg("scan") = py::none(), py::arg("touching") = false, py::arg("touch") = py::none(),
           py::arg("image") = py::none(), py::arg("gun") = py::none(),
           py::arg("shots") = std::vector<ShotResult>(), py::arg("stores") = py::none(),
           py::arg("targets") = py::none(), py::arg("grid") = py::none())
      .def_readonly("time", &Observation::time_s)
      .def_property_readonly("odometry", [](const Observation& seen) { return array_of(seen.odometry); })
      .def_readonly("scan", &Observation::scan)
      .def_readonly("touching", &Observation::touching)
      .def_readonly("touch", &Observation::touch_rad)
      .def_readonly("image", &Observation::image)
      .def_property_readonly("gun",
                             [](const Observation& seen) {
                               return seen.gun
                                          ? py::object(py::make_tuple(seen.gun->yaw_rad, seen.gun->pitch_rad))
                                          : py::object(py::none());
                             })
      .def_readonly("shots", &Observation::shots)
      .def_readonly("stores", &Observation::stores)
      .def_readonly("targets", &Observation::targets)
      .def_readonly("grid", &Observation::grid);
}

}  // namespace outrider::python
