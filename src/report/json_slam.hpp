// The keys of mapping in a report, each named once: `io` writes or reads the member that it is given.
#pragma once

#include <concepts>
#include <type_traits>

#include "json_explore.hpp"
#include "outrider/report/page_report.hpp"

namespace outrider {

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportLoop>
void members(Io& io, T& loop) {
  io.drawn("time_s", loop.time_s);
  io.drawn("from", loop.from);
  io.drawn("to", loop.to);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportLandmark>
void members(Io& io, T& landmark) {
  io("id", landmark.id);
  io.drawn("first_s", landmark.first_s);
  io.drawn("position", landmark.position);
  io.drawn("sigma_x_m", landmark.sigma_x_m);
  io.drawn("sigma_y_m", landmark.sigma_y_m);
  io.drawn("correlation", landmark.correlation);
  io("sightings", landmark.sightings);
  io.optional("truth", landmark.truth);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportScan>
void members(Io& io, T& scan) {
  io.drawn("time_s", scan.time_s);
  io.drawn("points", scan.points);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportSlam>
void members(Io& io, T& slam) {
  io("engine", slam.engine);
  io("beliefs", slam.beliefs);
  io.drawn("odometry", slam.odometry);
  io.drawn("reference", slam.reference);
  io("loops", slam.loops);
  io("landmarks", slam.landmarks);
  io("scans", slam.scans);
  io.optional("map", slam.map);
}

}  // namespace outrider
