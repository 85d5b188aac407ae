// The keys of ground that is not flat in a report, each named once: `io` writes or reads the member that it
// is given.
#pragma once

#include <concepts>
#include <type_traits>

#include "outrider/report/page_report.hpp"

namespace outrider {

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportContour>
void members(Io& io, T& contour) {
  io.drawn("height_m", contour.height_m);
  io.drawn("points", contour.points);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportRelief>
void members(Io& io, T& relief) {
  io.drawn("origin", relief.origin);
  io.drawn("spacing_m", relief.spacing_m);
  io("columns", relief.columns);
  io("rows", relief.rows);
  io.drawn("heights_m", relief.heights_m);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportTerrain>
void members(Io& io, T& terrain) {
  io("contours", terrain.contours);
  io("steep", terrain.steep);
  io.optional("relief", terrain.relief);
}

}  // namespace outrider
