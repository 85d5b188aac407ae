#include "research/guard/pddl.hpp"

#include <fmt/format.h>

#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/robot/supplies.hpp"
#include "research/guard/pddl_names.hpp"

namespace outrider {
namespace {

/// Without an exponent, which planners do not read.
std::string plain(double value) {
  std::string text = fmt::format("{:.12f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

/// The kinds of supplies that the domain describes.
struct Ends {
  bool water;
  bool charge;
  bool stations;
  explicit Ends(const SupplyProblem& problem)
      : water(std::isfinite(problem.water)),
        charge(std::isfinite(problem.charge)),
        stations(!problem.stations.empty()) {}
};

constexpr const char* head = R"(; The mission of a robot with a water gun, as durative actions.
; Times in s, angles in rad. ?w is the way round that the gun takes: direct, or by a full turn more or less.
(define (domain guard)
  (:requirements :typing :fluents :durative-actions :duration-inequalities)
)";

/// That the gun needs to get from where it is to a yaw and a pitch, on both axes; `more` comes on top.
std::string aim(const char* yaw, const char* pitch, const char* more) {
  std::string text = "(and";
  for (const auto& [time, to, now] :
       {std::tuple{"yaw-time", fmt::format("(+ {} (full-turn ?w))", yaw), "gun-yaw"},
        std::tuple{"pitch-time", std::string(pitch), "gun-pitch"}}) {
    const std::string there = fmt::format("(* ({}) (- {} ({})))", time, to, now);
    const std::string back = fmt::format("(* ({}) (- ({}) {}))", time, now, to);
    for (const std::string& way : {there, back}) {
      text +=
          fmt::format("\n      (>= ?duration {})", *more == 0 ? way : fmt::format("(+ {} {})", more, way));
    }
  }
  return text + ")";
}

std::string action(std::string_view name, std::string_view parameters, const std::string& duration,
                   const std::vector<std::string>& conditions, const std::vector<std::string>& effects) {
  std::string text = fmt::format(
      "  (:durative-action {}\n    :parameters ({})\n    :duration {}\n    :condition (and (at start (free))",
      name, parameters, duration);
  for (const std::string& condition : conditions) text += "\n      (" + condition + ")";
  text += ")\n    :effect (and (at start (not (free))) (at end (free))";
  for (const std::string& effect : effects) text += "\n      (" + effect + ")";
  return text + "))\n";
}

std::string drive_action(const Ends& ends) {
  std::vector<std::string> conditions{"at start (robot-at ?from)", "at start (road ?from ?to)"};
  std::vector<std::string> effects{"at start (not (robot-at ?from))", "at end (robot-at ?to)"};
  if (ends.charge) {
    conditions.emplace_back("at end (>= (charge) 0)");
    effects.emplace_back("at start (decrease (charge) (drive-charge ?from ?to))");
  }
  return action("drive", "?from ?to - pose", "(= ?duration (drive-time ?from ?to))", conditions, effects);
}

std::string shoot_action(const Ends& ends) {
  std::vector<std::string> conditions{"at start (robot-at ?p)", "at start (sees ?p ?t)",
                                      "at start (waits ?t)"};
  std::vector<std::string> effects{"at start (not (waits ?t))", "at end (hit ?t)",
                                   "at end (assign (gun-yaw) (shot-yaw ?p ?t))",
                                   "at end (assign (gun-pitch) (shot-pitch ?p ?t))"};
  if (ends.stations) effects.emplace_back("at start (not (rested))");
  if (ends.water) {
    conditions.emplace_back("at start (>= (water) (shot-water))");
    effects.emplace_back("at start (decrease (water) (shot-water))");
  }
  if (ends.charge) {
    conditions.emplace_back("at end (>= (charge) (homeward-charge ?p))");
    effects.emplace_back("at start (decrease (charge) (+ (shot-charge) (* (power) ?duration)))");
  }
  return action("shoot", "?p - pose ?t - target ?w - way",
                aim("(shot-yaw ?p ?t)", "(shot-pitch ?p ?t)", "(flight-time ?p ?t)"), conditions, effects);
}

std::string rest_action(const Ends& ends) {
  std::vector<std::string> conditions;
  std::vector<std::string> effects{"at end (rested)", "at end (assign (gun-yaw) 0)",
                                   "at end (assign (gun-pitch) 0)"};
  if (ends.charge) {
    conditions.emplace_back("at end (>= (charge) 0)");
    effects.emplace_back("at start (decrease (charge) (* (power) ?duration))");
  }
  return action("rest", "?w - way", aim("0", "0", ""), conditions, effects);
}

std::string fill_action(Store store) {
  const std::string what(to_string(store));
  return action(
      pddl_fill(store), "?f - station ?p - pose",
      fmt::format("(= ?duration (+ (fill-time ?f) (* (fill-time-per-unit ?f) (- (full-{0}) ({0})))))", what),
      {"at start (robot-at ?p)", fmt::format("at start (gives-{} ?f ?p)", what), "at start (rested)"},
      {fmt::format("at end (assign ({0}) (full-{0}))", what)});
}

std::string value(const std::string& what, double number) {
  return fmt::format("    (= ({}) {})\n", what, plain(number));
}

/// Numbers of the robot, and where everything is at first.
std::string beginning(const TemporalProblem& problem, const Ends& ends, const PddlNames& names) {
  const SupplyProblem& supplies = problem.supplies;
  std::string text = "    (free) (robot-at p0-0)\n" + value("gun-yaw", 0.0) + value("gun-pitch", 0.0) +
                     value("yaw-time", 1.0 / supplies.table.yaw_rate_radps) +
                     value("pitch-time", 1.0 / supplies.table.pitch_rate_radps);
  for (const WayRound way : {WayRound::direct, WayRound::plus, WayRound::minus}) {
    text += value(fmt::format("full-turn {}", pddl_name(way)), turn_of(way));
  }
  if (ends.stations) text += "    (rested)\n";
  if (ends.water) text += value("water", supplies.water) + value("shot-water", supplies.water_per_shot);
  if (ends.charge) {
    text += value("charge", supplies.charge) + value("shot-charge", supplies.charge_per_shot) +
            value("power", supplies.charge_per_second);
  }
  for (std::size_t f = 0; f < supplies.stations.size(); ++f) {
    const TourStation& station = supplies.stations[f];
    const std::string store(to_string(station.store));
    text += value("fill-time " + names.stations[f], station.fixed_s) +
            value("fill-time-per-unit " + names.stations[f], station.per_unit_s);
    for (std::size_t p = 0; p < problem.poses.size(); ++p) {
      if (problem.poses[p].stop != station.stop) continue;
      text += fmt::format("    (gives-{} {} {})\n", store, names.stations[f], names.poses[p]);
    }
  }
  if (ends.stations && ends.water) text += value("full-water", supplies.water);
  if (ends.stations && ends.charge) text += value("full-charge", supplies.charge);
  for (const std::string& target : names.targets) text += fmt::format("    (waits {})\n", target);
  return text;
}

std::string shots(const TemporalProblem& problem, const PddlNames& names) {
  std::string text;
  for (std::size_t p = 0; p < problem.poses.size(); ++p) {
    for (const Service& service : problem.supplies.table.services[problem.poses[p].stop]) {
      const std::string pair = names.poses[p] + " " + names.targets[service.goal];
      text += fmt::format("    (sees {})\n", pair) + value("shot-yaw " + pair, problem.shot_yaw(p, service)) +
              value("shot-pitch " + pair, service.pitch_rad) +
              value("flight-time " + pair, service.duration_s);
    }
  }
  return text;
}

std::string roads(const TemporalProblem& problem, const Ends& ends, const PddlNames& names) {
  std::string text;
  for (std::size_t p = 0; p < problem.poses.size(); ++p) {
    if (ends.charge) text += value("homeward-charge " + names.poses[p], problem.homeward_charge(p));
    for (std::size_t stop = 0; stop < problem.stops(); ++stop) {
      const std::size_t to = problem.after[p * problem.stops() + stop];
      if (to == TemporalProblem::none) continue;
      const std::string pair = names.poses[p] + " " + names.poses[to];
      text += fmt::format("    (road {})\n", pair) + value("drive-time " + pair, problem.drive_s(p, to));
      if (ends.charge) text += value("drive-charge " + pair, problem.drive_charge(p, to));
    }
  }
  return text;
}

std::string comments(const TemporalProblem& problem, const PddlNotes& notes, const PddlNames& names) {
  std::string text = fmt::format("; {}: {} targets, {} stops, {} poses.\n", excerpt(notes.yard),
                                 names.targets.size(), problem.stops(), names.poses.size());
  const Ends ends(problem.supplies);
  if (!ends.water && !ends.charge) text += "; Water and charge have no end here: there are no stations.\n";
  for (const std::string& name : notes.left_out)
    text += fmt::format("; {} is left out: nothing hits it.\n", excerpt(name));
  for (std::size_t g = 0; g < notes.targets.size(); ++g)
    text += fmt::format("; t{} is {}\n", g, excerpt(notes.targets[g]));
  for (std::size_t f = 0; f < notes.stations.size(); ++f) {
    text += fmt::format("; f{} is {}, which gives {}\n", f, excerpt(notes.stations[f]),
                        to_string(problem.supplies.stations[f].store));
  }
  for (std::size_t p = 0; p < problem.poses.size() && !notes.places.empty(); ++p) {
    const Vec2 place = notes.places[problem.poses[p].stop];
    text += fmt::format("; {} is ({:.3f}, {:.3f}) m, heading {:.2f} deg\n", names.poses[p], place.x, place.y,
                        degrees(wrap_angle(problem.poses[p].heading_rad)));
  }
  return text;
}

std::string objects(const std::vector<std::string>& names, const char* type) {
  if (names.empty()) return {};
  return fmt::format("    {} - {}\n", fmt::join(names, " "), type);
}

}  // namespace

std::string pddl_domain(const TemporalProblem& problem) {
  const Ends ends(problem.supplies);
  std::string text = head;
  text += ends.stations ? "  (:types pose target way station)\n" : "  (:types pose target way)\n";
  text +=
      "  (:constants direct plus minus - way)\n  (:predicates (free) (robot-at ?p - pose) (road ?from ?to - "
      "pose)\n"
      "    (sees ?p - pose ?t - target) (waits ?t - target) (hit ?t - target)";
  if (ends.stations) text += "\n    (rested)";
  if (ends.stations && ends.water) text += " (gives-water ?f - station ?p - pose)";
  if (ends.stations && ends.charge) text += " (gives-charge ?f - station ?p - pose)";
  text +=
      ")\n  (:functions (drive-time ?from ?to - pose) (gun-yaw) (gun-pitch) (yaw-time) (pitch-time)\n"
      "    (full-turn ?w - way) (shot-yaw ?p - pose ?t - target) (shot-pitch ?p - pose ?t - target)\n"
      "    (flight-time ?p - pose ?t - target)";
  if (ends.water) text += "\n    (water) (full-water) (shot-water)";
  if (ends.charge) {
    text +=
        "\n    (charge) (full-charge) (shot-charge) (power) (drive-charge ?from ?to - pose) (homeward-charge "
        "?p - pose)";
  }
  if (ends.stations) text += "\n    (fill-time ?f - station) (fill-time-per-unit ?f - station)";
  text += ")\n" + drive_action(ends) + shoot_action(ends);
  if (ends.stations) text += rest_action(ends);
  if (ends.stations && ends.water) text += fill_action(Store::water);
  if (ends.stations && ends.charge) text += fill_action(Store::charge);
  return text + ")\n";
}

std::string pddl_problem(const TemporalProblem& problem, const PddlNotes& notes) {
  const Ends ends(problem.supplies);
  const PddlNames names(problem);
  std::string text = comments(problem, notes, names);
  text += "(define (problem yard) (:domain guard)\n  (:objects\n" + objects(names.poses, "pose") +
          objects(names.targets, "target") + objects(names.stations, "station") + "  )\n  (:init\n";
  text += beginning(problem, ends, names) + shots(problem, names) + roads(problem, ends, names) +
          "  )\n  (:goal (and";
  for (const std::string& target : names.targets) text += fmt::format(" (hit {})", target);
  return text + "))\n  (:metric minimize (total-time)))\n";
}

}  // namespace outrider
