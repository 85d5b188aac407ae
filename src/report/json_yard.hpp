// The keys of a yard, of what happened in it and of a pursuit, each named once: `io` writes or reads the
// member that it is given.
#pragma once

#include <concepts>
#include <type_traits>

#include "outrider/report/page_report.hpp"

namespace outrider {

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, RoundedPolygon>
void members(Io& io, T& shape) {
  io.drawn("core", shape.core);
  io.drawn("radius_m", shape.radius_m);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportSolid>
void members(Io& io, T& solid) {
  io("name", solid.name);
  io("kind", solid.kind);
  io("low_z_m", solid.low_z_m);
  io("high_z_m", solid.high_z_m);
  io("blocks_driving", solid.blocks_driving);
  io("footprint", solid.footprint);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ProfilePiece>
void members(Io& io, T& piece) {
  io("name", piece.name);
  io.drawn("polygon", piece.polygon);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportVisit>
void members(Io& io, T& visit) {
  io("entrance", visit.entrance);
  io("from", visit.from);
  io("enters_s", visit.enters_s);
  io("settles_s", visit.settles_s);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportMove>
void members(Io& io, T& move) {
  io("time_s", move.time_s);
  io("position", move.position);
  io("believed", move.believed);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportTarget>
void members(Io& io, T& target) {
  io("name", target.name);
  io("status", target.status);
  io("reason", target.reason);
  io("pose", target.pose);
  io("pitch_rad", target.pitch_rad);
  io("yaw_rad", target.shot_yaw_rad);
  io("speed_mps", target.speed_mps);
  io("clearance_m", target.clearance_m);
  io("done_s", target.done_s);
  io("shots", target.shots);
  io("centre", target.centre);
  io("size", target.size);
  io("box_yaw_rad", target.yaw_rad);
  io.optional("visit", target.visit);
  io.optional("moves", target.moves);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportPath>
void members(Io& io, T& path) {
  io("start_s", path.start_s);
  io("end_s", path.end_s);
  io("waypoints", path.waypoints);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportShot>
void members(Io& io, T& shot) {
  io("target", shot.target);
  io("attempt", shot.attempt);
  io("time_s", shot.time_s);
  io("flight_s", shot.flight_s);
  io("muzzle", shot.muzzle);
  io("velocity_mps", shot.velocity_mps);
  io("contact", shot.contact);
  io("contact_point", shot.contact_point);
  io("hit", shot.hit);
  io("hit_by_reference_rule", shot.hit_by_reference_rule);
  io("clearance_m", shot.clearance_m);
  io("profile", shot.profile);
  io.optional("path", shot.path);
  io.optional("platform_velocity_mps", shot.platform_velocity_mps);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportEvent>
void members(Io& io, T& event) {
  io("time_s", event.time_s);
  io("kind", event.kind);
  io("text", event.text);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportStation>
void members(Io& io, T& station) {
  io("name", station.name);
  io("position", station.position);
  io("gives_water", station.gives_water);
  io("gives_charge", station.gives_charge);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportSupplies>
void members(Io& io, T& supplies) {
  io("tank", supplies.tank);
  io("battery_j", supplies.battery_j);
  io("stations", supplies.stations);
  io("levels", supplies.levels);
}

template <class Io, class T>
  requires std::same_as<std::remove_const_t<T>, ReportPursuit>
void members(Io& io, T& pursuit) {
  io("columns", pursuit.columns);
  io("rows", pursuit.rows);
  io("cell_m", pursuit.cell_m);
  io.runs("cost_runs", pursuit.cost_runs, pursuit.columns, pursuit.rows);
  io("target", pursuit.target);
  io("robots", pursuit.robots);
  io("paid", pursuit.paid);
  io("bounds", pursuit.bounds);
}

}  // namespace outrider
