// The keys of a drive in a report, each named once: `io` writes or reads the member that it is given.
#pragma once

#include <concepts>
#include <type_traits>

#include "outrider/report/page_report.hpp"

namespace outrider {

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportTag>
void members(Io& io, T& tag) {
  io("id", tag.id);
  io("position", tag.position);
  io("facing_rad", tag.facing_rad);
  io("size_m", tag.size_m);
  io.optional("height_m", tag.height_m);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportCamera>
void members(Io& io, T& camera) {
  io("width_px", camera.width_px);
  io("height_px", camera.height_px);
  io.drawn("fx", camera.fx);
  io.drawn("fy", camera.fy);
  io.drawn("cx", camera.cx);
  io.drawn("cy", camera.cy);
  io.drawn("ahead_m", camera.ahead_m);
  io.drawn("height_m", camera.height_m);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportStop>
void members(Io& io, T& stop) {
  io("pose", stop.pose);
  io("stop", stop.stop);
  io("time_s", stop.time_s);
  io("error", stop.error);
  io("heading_error_rad", stop.heading_error_rad);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportBelief>
void members(Io& io, T& belief) {
  io.drawn("time_s", belief.time_s);
  io.drawn("pose", belief.pose);
  io.drawn("sigma_x_m", belief.sigma_x_m);
  io.drawn("sigma_y_m", belief.sigma_y_m);
  io.drawn("correlation", belief.correlation);
  io.drawn("sigma_rad", belief.sigma_rad);
  io("corrected", belief.corrected);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportDrive>
void members(Io& io, T& drive) {
  io("loop", drive.loop);
  io("tags", drive.tags);
  io("stops", drive.stops);
  io("beliefs", drive.beliefs);
  io.optional("camera", drive.camera);
}

}  // namespace outrider
