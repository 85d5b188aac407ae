// The keys of exploring in a report, each named once: `io` writes or reads the member that it is given.
#pragma once

#include <concepts>
#include <type_traits>

#include "json_drive.hpp"
#include "outrider/report/page_report.hpp"

namespace outrider {

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportMap>
void members(Io& io, T& map) {
  io.drawn("origin", map.origin);
  io.drawn("cell_m", map.cell_m);
  io("columns", map.columns);
  io("rows", map.rows);
  io.runs("state_runs", map.state_runs, map.columns, map.rows);
  io.drawn("step_s", map.step_s);
  io.runs("known_runs", map.known_runs, map.columns, map.rows);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportDecision>
void members(Io& io, T& decision) {
  io.drawn("time_s", decision.time_s);
  io("kind", decision.kind);
  io.drawn("goal", decision.goal);
  io.drawn("waypoints", decision.waypoints);
  io("frontiers", decision.frontiers);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportRefusal>
void members(Io& io, T& refusal) {
  io.drawn("position", refusal.position);
  io("reason", refusal.reason);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportLaser>
void members(Io& io, T& laser) {
  io("beams", laser.beams);
  io.drawn("range_m", laser.range_m);
  io.drawn("height_m", laser.height_m);
  io.drawn("mount", laser.mount);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportExplore>
void members(Io& io, T& explore) {
  io("map", explore.map);
  io.drawn("walls", explore.walls);
  io("beliefs", explore.beliefs);
  io("decisions", explore.decisions);
  io("refused", explore.refused);
  io.optional("laser", explore.laser);
}

}  // namespace outrider
