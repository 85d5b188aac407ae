// The keys of covering in a report, each named once: `io` writes or reads the member that it is given.
#pragma once

#include <concepts>
#include <type_traits>

#include "outrider/report/page_report.hpp"

namespace outrider {

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportPass>
void members(Io& io, T& pass) {
  io.drawn("start_s", pass.start_s);
  io.drawn("end_s", pass.end_s);
  io("role", pass.role);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportCover>
void members(Io& io, T& cover) {
  io("width_m", cover.width_m);
  io.drawn("area", cover.area);
  io.drawn("reach", cover.reach);
  io.drawn("missed", cover.missed);
  io.drawn("overlap", cover.overlap);
  io.drawn("planned", cover.planned);
  io("passes", cover.passes);
  io("covered", cover.covered);
}

}  // namespace outrider
