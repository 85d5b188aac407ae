// The mission of guarding a yard.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "interruptible.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/guard/run/prepare.hpp"
#include "scenario.hpp"
#include "turn.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

std::unique_ptr<PreparedGuard> prepared(const py::handle& path, std::optional<std::int64_t> seed,
                                        const py::dict& set) {
  auto task = load_task_of<GuardJob>(path, seed, set);
  return value_of(interruptible([&](const std::stop_token& stop) {
    return prepare_guard(std::move(task->scenario), RunWatch{.stop = stop});
  }));
}

/// A mission that one thread steps at a time.
class Guarding {
 public:
  Guarding(const py::handle& path, std::optional<std::int64_t> seed, const py::dict& set)
      : guard_(prepared(path, seed, set)) {}

  std::optional<Command> step(const Observation& seen) {
    const auto turn = turn_.take("mission");
    if (over_) return std::nullopt;
    check_seen(seen);
    last_s_ = seen.time_s;
    const py::gil_scoped_release others_may_run;
    auto command = guard_->mission->step(seen);
    over_ = !command;
    return command;
  }
  [[nodiscard]] GuardVerdict verdict() {
    const auto turn = turn_.take("mission");
    return over_ ? verdict_of(*guard_->mission) : GuardVerdict{};
  }
  template <class Read>
  auto read(Read what) {
    const auto turn = turn_.take("mission");
    return what(*guard_);
  }

 private:
  /// Checks the properties of an observation that the mission relies on.
  void check_seen(const Observation& seen) const {
    if (!(seen.time_s >= last_s_))
      refuse(fmt::format("{} s comes after {} s; time goes on", seen.time_s, last_s_), "time");
    if (!seen.gun) refuse("there is no gun; give its yaw and pitch in rad", "gun");
    if (guard_->scenario.problem.supplies.any() && !seen.stores)
      refuse("water or charge is limited; give StoreLevels", "stores");
    if (!guard_->yard && !guard_->walkers) return;
    if (!seen.targets) refuse("intruders come or walk; give a TargetReport", "targets");
    for (const TargetArrival& arrival : seen.targets->arrivals) check_arrival(arrival);
    for (const TargetObservation& one : seen.targets->seen) check_sighting(one, seen.time_s);
  }
  void check_arrival(const TargetArrival& arrival) const {
    if (!guard_->yard) refuse("nobody arrives in this yard; give where intruders are seen", "arrivals");
    const auto& [target, settles_s, place] = arrival;
    if (target >= guard_->yard->intruders.size() || place >= guard_->yard->places())
      refuse(fmt::format("intruder {} at place {}: there are {} intruders and {} places", target, place,
                         guard_->yard->intruders.size(), guard_->yard->places()),
             "arrivals");
    for (const TargetArrival& inside : guard_->mission->arriving()->inside()) {
      if (inside.target == target) refuse(fmt::format("intruder {} is inside already", target), "arrivals");
    }
  }
  void check_sighting(const TargetObservation& one, double now_s) const {
    if (!guard_->walkers) return;
    const auto& tracks = guard_->mission->moving()->tracks();
    if (one.target >= tracks.size())
      refuse(fmt::format("target {}: there are {}", one.target, tracks.size()), "seen");
    const Track& track = tracks[one.target];
    if (one.time_s > now_s || (!track.empty() && one.time_s <= track.back().time_s))
      refuse(fmt::format("target {} was seen at {} s; give each sighting once, in the order of time",
                         one.target, one.time_s),
             "seen");
  }

  std::unique_ptr<PreparedGuard> guard_;
  double last_s_ = -std::numeric_limits<double>::infinity();
  bool over_ = false;
  Turn turn_;
};

py::list targets_of(const PreparedGuard& guard) {
  py::list targets;
  const auto& records = guard.mission->board().records();
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Target& target = guard.mission->board().problem().targets[i];
    py::dict one;
    one["name"] = target.name;
    one["position"] = py::make_tuple(target.base.x, target.base.y, target.base.z);
    one["status"] = std::string(to_string(records[i].status));
    one["reason"] = records[i].reason;
    one["shots"] = records[i].shots;
    targets.append(one);
  }
  return targets;
}

/// Returns the intruders of the scenario. A robot that is not simulated reports its own.
py::list intruders_of(const PreparedGuard& guard) {
  py::list intruders;
  if (!guard.yard) return intruders;
  for (const Intruder& intruder : guard.yard->intruders) {
    py::dict one;
    one["name"] = intruder.name;
    one["place"] = intruder.place;
    one["enters"] = intruder.enters_s;
    one["settles"] = intruder.settles_s;
    intruders.append(one);
  }
  return intruders;
}

py::list stations_of(const PreparedGuard& guard) {
  py::list stations;
  for (const Station& station : guard.scenario.problem.supplies.stations) {
    py::dict one;
    one["name"] = station.name;
    one["position"] = py::make_tuple(station.position.x, station.position.y);
    one["water"] = station.gives_water;
    one["charge"] = station.gives_charge;
    stations.append(one);
  }
  return stations;
}

py::array_t<double> stops_of(const PreparedGuard& guard) {
  std::vector<Vec2> stops;
  if (!guard.plan->tour) return array_of(stops);
  for (const PlannedStop& stop : guard.plan->tour->stops) stops.push_back(stop.position);
  return array_of(stops);
}

}  // namespace

void bind_guard(py::module_& module) {
  const auto get = [](auto what) { return [what](Guarding& guard) { return guard.read(what); }; };
  py::class_<Guarding>(module, "GuardMission")
      .def(py::init<const py::handle&, std::optional<std::int64_t>, const py::dict&>(), py::arg("scenario"),
           py::kw_only(), py::arg("seed") = py::none(), py::arg("set") = py::dict())
      .def("step", &Guarding::step, py::arg("observation"))
      .def_property_readonly("status", [](Guarding& guard) { return guard.verdict().status; })
      .def_property_readonly("reason", [](Guarding& guard) { return guard.verdict().reason; })
      .def_property_readonly(
          "start", get([](const PreparedGuard& guard) { return array_of(guard.scenario.problem.start); }))
      .def_property_readonly("stops", get(stops_of))
      .def_property_readonly("cost", get([](const PreparedGuard& guard) {
                               return guard.plan->tour ? guard.plan->tour->cost_s : 0.0;
                             }))
      .def_property_readonly("lower_bound", get([](const PreparedGuard& guard) {
                               return guard.plan->tour ? guard.plan->tour->lower_bound_s : 0.0;
                             }))
      .def_property_readonly("targets", get(targets_of))
      .def_property_readonly("intruders", get(intruders_of))
      .def_property_readonly("stations", get(stations_of));
}

}  // namespace outrider::python
