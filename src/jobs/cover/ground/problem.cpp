#include "outrider/jobs/cover/ground/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/text.hpp"

namespace outrider {
namespace {

constexpr double arc_part = 2.5e-4;       // of the stride, between a true arc and its chords
constexpr double least_bar = 1e-3;        // of the width of a bar: its least length
constexpr double most_bar = 100.0;        // widths of a bar: its length, and how far ahead it is
constexpr double turning_room = 1.0002;   // for a bar: the judge's polygons about its turns
constexpr double most_strips = 10'000.0;  // side by side: more would take days to put in order and to measure
constexpr double most_turning =
    5000.0;  // the same times the strips in a turning radius: some 6 min of planning
constexpr double transfer_margin = 10.0;  // widths around all areas that transfers may use

Status check_outline(const AreaOutline& outline, const std::string& of) {
  if (auto good = check_polygon(outline.boundary, "the boundary"); !good) {
    good.error().where = "boundary" + of;
    return good;
  }
  const Region inside = region_of(outline.boundary, {});
  for (std::size_t i = 0; i < outline.holes.size(); ++i) {
    const std::string name = fmt::format("hole {}{}", i + 1, of);
    if (auto good = check_polygon(outline.holes[i], name); !good) {
      good.error().where = name;
      return good;
    }
    const double out = area_of(without(region_of(outline.holes[i], {}), inside));
    if (out <= 1e-6 * area_of(inside)) continue;
    return bad_input(
        fmt::format("{:.4g} m2 of it lie outside the boundary; cut it off or move the hole in", out), name);
  }
  return {};
}

Status check_polygons(const CoverProblem& problem) {
  if (auto good = check_outline({problem.boundary, problem.holes}, ""); !good) return good;
  for (std::size_t i = 0; i < problem.others.size(); ++i) {
    auto good = check_outline(problem.others[i], fmt::format(" of area {}", i + 2));
    if (!good) return good;
  }
  return {};
}

/// The tracking error may be at most half of what neighbouring strips share.
Status check_tracking_error(const CoverProblem& problem) {
  const double most_error_m = 0.5 * problem.width_m * problem.overlap, error_m = problem.tracking_error_m;
  if (error_m >= 0.0 && error_m <= most_error_m * (1.0 + 1e-9)) return {};
  const double enough = 2.0 * std::abs(error_m) / problem.width_m;
  const auto rounded_up = [](double value) { return std::ceil(1e4 * value - 1e-6) * 1e-4; };
  const std::string remedy =
      enough <= most_overlap
          ? fmt::format("an overlap of at least {:.4f}", rounded_up(enough))
          : fmt::format(
                "an overlap of {:g} with a width of at least {:.4f} m; at this width no overlap is enough",
                most_overlap, rounded_up(2.0 * std::abs(error_m) / most_overlap));
  return bad_input(
      fmt::format(
          "strips of {:g} m that share {:g} of their width leave gaps when the tracking error is {:g} "
          "m; give a tracking error of 0 to {:g} m, or {}",
          problem.width_m, problem.overlap, error_m, most_error_m, remedy),
      "tracking_error");
}

Status check_turning(const CoverProblem& problem) {
  const double radius_m = problem.turning_radius_m;
  if (!(radius_m == 0.0 || (radius_m >= least_polygon_radius_m && radius_m <= most_polygon_radius_m))) {
    return bad_input(
        fmt::format("a turning radius of {:g} m is none; give {:g} to {:g} m, or 0 for a robot that "
                    "turns in place",
                    radius_m, least_polygon_radius_m, most_polygon_radius_m),
        "turning_radius");
  }
  if (!(problem.headland >= 0 && problem.headland <= most_headland)) {
    return bad_input(
        fmt::format("a headland of {} laps is none; give 1 to {}, or 0 for as many as turns need",
                    problem.headland, most_headland),
        "headland");
  }
  if (!problem.curves() && (problem.reverse || problem.headland > 0)) {
    return bad_input(fmt::format("'{}' is for a robot with a turning radius; give one, or leave it out",
                                 problem.reverse ? "reverse" : "headland"),
                     problem.reverse ? "reverse" : "headland");
  }
  if (problem.curves() && problem.transfers) {
    return bad_input(
        "transfers between areas are planned for robots that turn in place only; leave out the turning "
        "radius, or cover one area at a time",
        "transfers");
  }
  return {};
}

Status check_tool(const CoverProblem& problem) {
  const CoverTool& tool = problem.tool;
  if (tool.shape != "disk" && tool.shape != "bar") {
    return bad_input(fmt::format("'{}' is no shape of a tool; give disk or bar", excerpt(tool.shape)),
                     "tool.shape");
  }
  const auto bar = problem.bar();
  if (!bar) return {};
  if (!(bar->width_m >= 2.0 * least_polygon_radius_m && bar->width_m <= 2.0 * most_polygon_radius_m)) {
    return bad_input(
        fmt::format("a bar {:g} m wide is none; give {:g} to {:g} m, or 0 for the width of the robot",
                    bar->width_m, 2.0 * least_polygon_radius_m, 2.0 * most_polygon_radius_m),
        "tool.width");
  }
  const double least_m = least_bar * bar->width_m, most_m = most_bar * bar->width_m;
  if (!(bar->length_m >= least_m && bar->length_m <= most_m)) {
    return bad_input(fmt::format("a bar {:g} m wide is not {:g} m long; give {:g} to {:g} m", bar->width_m,
                                 bar->length_m, least_m, most_m),
                     "tool.length");
  }
  if (!(std::abs(bar->forward_m) <= most_m && problem.radius_m() <= most_polygon_radius_m)) {
    return bad_input(fmt::format("a bar {:g} m wide is not {:g} m ahead of its robot; give at most {:g} m",
                                 bar->width_m, bar->forward_m, std::min(most_m, 0.5 * most_polygon_radius_m)),
                     "tool.forward");
  }
  if (problem.tracking_error_m != 0.0) {
    return bad_input(
        fmt::format(
            "with a bar nothing is proven for a tracking error, and {:g} m is one; give 0, or a bar that is "
            "so much narrower on each side",
            problem.tracking_error_m),
        "tracking_error");
  }
  if (problem.transfers) {
    return bad_input(
        "transfers between areas are planned for disks only; cover one area at a time with a bar",
        "transfers");
  }
  return {};
}

Status check_numbers(const CoverProblem& problem) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  if (!within(problem.width_m, 2.0 * least_polygon_radius_m, 2.0 * most_polygon_radius_m)) {
    return bad_input(fmt::format("a robot {:g} m wide is none; give {:g} to {:g} m", problem.width_m,
                                 2.0 * least_polygon_radius_m, 2.0 * most_polygon_radius_m),
                     "width");
  }
  if (!within(problem.overlap, 0.0, most_overlap)) {
    return bad_input(fmt::format("{:g} is no part of the width that strips share; give 0 to {:g}",
                                 problem.overlap, most_overlap),
                     "overlap");
  }
  if (!within(problem.uncovered, 0.0, 0.5)) {
    return bad_input(
        fmt::format("{:g} is no part of the area that may stay uncovered; give 0 to 0.5", problem.uncovered),
        "uncovered");
  }
  if (auto good = check_tool(problem); !good) return good;
  if (auto good = check_tracking_error(problem); !good) return good;
  if (auto good = check_turning(problem); !good) return good;
  return check(problem.pace);
}

/// The widest disk that may stand somewhere, m, from below: where half the size of the area is bisected.
double widest_m(const Region& area) {
  const Vec2 size = bounds_of(area).size();
  double low = 0.0, high = std::min(size.x, size.y);
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (shrunk(area, 0.5 * middle, 1e-3 * middle).empty() ? high : low) = middle;
  }
  return low;
}

Outcome<PolygonGround> ground_of(const AreaOutline& outline, double radius_m) {
  return PolygonGround::of(outline.boundary, outline.holes, radius_m);
}

tl::unexpected<Fault> fits_nowhere(const CoverProblem& problem, const Region& area) {
  if (problem.bar()) {
    return bad_input(fmt::format("a robot {:g} m wide with its bar turns in a disk of {:.4g} m, which fits "
                                 "nowhere in the area; the "
                                 "widest that does has {:.3g} m",
                                 problem.width_m, 2.0 * problem.radius_m(), widest_m(area)),
                     "tool.width");
  }
  return bad_input(
      fmt::format("a robot {:g} m wide fits nowhere in the area; the widest that does has {:.3g} m",
                  problem.width_m, widest_m(area)),
      "width");
}

/// Checks that the robot can stand at its start.
Status check_start(const CoverProblem& problem, const PolygonGround& ground) {
  if (!problem.start) return {};
  const Vec2 at = problem.start->position;
  if (ground.outside(at)) {
    return fault(FaultCode::outside_map, place_text(problem.frame, at) + " lies outside the area", "start");
  }
  if (ground.point_free(at)) return {};
  return fault(FaultCode::start_blocked,
               fmt::format("a robot {:g} m wide cannot stand at {}, {:.4g} m from an edge", problem.width_m,
                           place_text(problem.frame, at), ground.edge_distance(at)),
               "start");
}

/// Returns the part of a room that the start lies in or is nearest to; the largest without a start.
const RingedPolygon& part_of(const CoverProblem& problem, const Region& room) {
  const RingedPolygon* chosen = &room.front();
  for (const RingedPolygon& part : room) {
    if (area_of(part) > area_of(*chosen)) chosen = &part;
  }
  if (!problem.start) return *chosen;
  const Vec2 at = problem.start->position;
  double nearest = std::numeric_limits<double>::infinity();
  for (const RingedPolygon& part : room) {
    if (contains(part, at)) return part;
    const double away = distance_to_border(part, at);
    if (away < nearest) chosen = &part;
    nearest = std::min(nearest, away);
  }
  return *chosen;
}

/// Prepares an area by itself. All of its standing room is kept.
Outcome<CoverField> field_of(const CoverProblem& problem, const AreaOutline& outline, double arc_m) {
  auto ground = ground_of(outline, problem.radius_m());
  if (!ground) return pass_on(ground);
  CoverField field;
  field.area = region_of(outline.boundary, outline.holes);
  field.standing = shrunk(field.area, problem.radius_m(), arc_m);
  if (field.standing.empty()) return fits_nowhere(problem, field.area);
  field.ground = std::make_shared<const PolygonGround>(std::move(*ground));
  return field;
}

/// With a bar, the reach is that of a disk as wide, from wherever such a disk comes to from the standing
/// room.
void set_reach(CoverField& field, const CoverProblem& problem, double arc_m) {
  const double radius_m = 0.5 * problem.strip_m();
  Region room = problem.bar() ? shrunk(field.area, radius_m, arc_m) : field.standing;
  if (problem.bar()) {
    std::erase_if(room, [&](const RingedPolygon& part) { return common({part}, field.standing).empty(); });
  }
  field.reach = common(grown(room, radius_m, arc_m), field.area);
}

/// Returns the areas with those that touch or overlap united.
std::vector<AreaOutline> outlines_apart(const CoverProblem& problem) {
  if (problem.others.empty()) return {{problem.boundary, problem.holes}};
  std::vector<Region> all{region_of(problem.boundary, problem.holes)};
  for (const AreaOutline& other : problem.others) all.push_back(region_of(other.boundary, other.holes));
  std::vector<AreaOutline> apart;
  for (const RingedPolygon& polygon : united(all)) apart.push_back({polygon.outer, polygon.holes});
  return apart;
}

/// Returns the room of drives between areas: a box around all, without the holes.
Outcome<AreaOutline> open_outline(const CoverProblem& problem, const Region& area) {
  const Box2 box = bounds_of(area).grown(transfer_margin * problem.width_m);
  AreaOutline outline{{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}, {}};
  std::vector<Region> holes;
  for (const RingedPolygon& polygon : area) {
    for (const auto& hole : polygon.holes) holes.push_back(region_of(hole, {}));
  }
  for (const RingedPolygon& hole : without(united(holes), area)) {
    if (!hole.holes.empty()) {
      return bad_input("an area lies in a hole of another, and no drive crosses a hole; cut the hole open",
                       "area");
    }
    outline.holes.push_back(hole.outer);
  }
  return outline;
}

/// Restricts the fields to what is connected by transfers, and sets the ground of these.
Status connect(CoverageArea& made, const CoverProblem& problem) {
  auto outline = open_outline(problem, made.area);
  if (!outline) return pass_on(outline);
  auto ground = ground_of(*outline, problem.radius_m());
  if (!ground) return pass_on(ground);
  if (auto good = check_start(problem, *ground); !good) return good;
  const Region open = shrunk(region_of(outline->boundary, outline->holes), problem.radius_m(), made.arc_m);
  const Region room{part_of(problem, open)};
  for (CoverField& field : made.fields) {
    std::erase_if(field.standing, [&](const RingedPolygon& part) {
      return area_of(common({part}, room)) < 0.5 * area_of(part);
    });
    if (field.standing.empty()) {
      return bad_input("holes of the areas enclose one of them, so no drive leads to it", "area");
    }
  }
  made.ground = std::make_shared<const PolygonGround>(std::move(*ground));
  return {};
}

/// Refuses areas whose strips are hopelessly many.
Status check_strips(const CoverProblem& problem, const std::vector<AreaOutline>& outlines) {
  const double stride_m = problem.stride_m(), turning = problem.turning_radius_m / stride_m;
  const double most = std::min(most_strips, most_turning / turning);
  for (const AreaOutline& outline : outlines) {
    const Region area = region_of(outline.boundary, outline.holes);
    const Vec2 size = bounds_of(area).size();
    const double strips = std::max(size.x, size.y) / stride_m;
    if (strips <= most) continue;
    auto what = fmt::format("its {:.4g} x {:.4g} m take up to {:.0f} strips {:.4g} m apart, {:.3g} km in all",
                            size.x, size.y, strips, stride_m, 1e-3 * area_of(area) / stride_m);
    if (most < most_strips) what += fmt::format(", and curves are {:.3g} strips wide", turning);
    what += fmt::format("; at most {:.0f} are planned: give a wider robot, or cover it in parts", most);
    return bad_input(what, "area");
  }
  return {};
}

}  // namespace

std::vector<Option> describe(CoverTool& tool) {
  return {
      {"shape", "", 0, 0,
       "disk: the robot itself; bar: a rectangle fixed to it, as a mower deck or spray boom", &tool.shape},
      {"width", "m", 0.0, 2.0 * most_polygon_radius_m,
       "of a bar, across the heading; 0: as wide as the robot", &tool.width_m},
      {"length", "m", 0.0, most_polygon_radius_m, "of a bar, along the heading", &tool.length_m},
      {"forward", "m", -most_polygon_radius_m, most_polygon_radius_m,
       "of the middle of a bar, ahead of the robot's centre; negative: behind it", &tool.forward_m}};
}

std::vector<Option> describe(CoverProblem& problem) {
  return {
      {"transfers", "", 0, 0, "several areas: the robot may drive between them, over all that is no hole",
       &problem.transfers},
      {"width", "m", 2.0 * least_polygon_radius_m, 2.0 * most_polygon_radius_m,
       "of the robot, a disk, and of the strip it covers unless it carries a bar", &problem.width_m},
      {"overlap", "", 0.0, most_overlap, "part of the width that neighbouring strips share",
       &problem.overlap},
      {"tracking_error", "m", 0.0, most_polygon_radius_m, "largest distance of the robot from its track",
       &problem.tracking_error_m},
      {"uncovered", "", 0.0, 0.5,
       "part of the area that may stay uncovered where only a detour would cover it", &problem.uncovered},
      {"turning_radius", "m", 0.0, most_polygon_radius_m,
       "of the tightest curve that the robot can drive; 0: it turns in place", &problem.turning_radius_m},
      {"reverse", "", 0, 0,
       "the robot with a turning radius may drive backwards: Reeds-Shepp turns, else Dubins turns",
       &problem.reverse},
      {"headland", "", 0.0, static_cast<double>(most_headland),
       "laps along every border, in which the robot with a turning radius turns; 0: as many as turns need",
       &problem.headland}};
}

std::optional<Bar> CoverProblem::bar() const {
  if (tool.shape != "bar") return std::nullopt;
  return Bar{tool.width_m != 0.0 ? tool.width_m : width_m, tool.length_m, tool.forward_m};
}

double CoverProblem::radius_m() const {
  const auto one = bar();
  return one ? std::max(body_radius_m(), turning_room * one->reach_m()) : body_radius_m();
}

double CoverProblem::strip_m() const {
  const auto one = bar();
  return one ? one->width_m : width_m;
}

Outcome<CoverageArea> cover_ground(const CoverProblem& problem) {
  if (auto good = check_numbers(problem); !good) return pass_on(good);
  if (auto good = check_polygons(problem); !good) return pass_on(good);
  CoverageArea made;
  made.arc_m = arc_part * problem.stride_m();
  const std::vector<AreaOutline> outlines = outlines_apart(problem);
  if (auto good = check_strips(problem, outlines); !good) return pass_on(good);
  if (outlines.size() > 1 && !problem.transfers) {
    return bad_input(
        fmt::format("{} areas lie apart; allow transfers, which cross the ground between them, or "
                    "give one area",
                    outlines.size()),
        "transfers");
  }
  for (const AreaOutline& outline : outlines) {
    auto field = field_of(problem, outline, made.arc_m);
    if (!field) return pass_on(field);
    made.area.insert(made.area.end(), field->area.begin(), field->area.end());
    made.fields.push_back(std::move(*field));
  }
  if (problem.transfers) {
    if (auto good = connect(made, problem); !good) return pass_on(good);
  } else {
    CoverField& field = made.fields.front();
    if (auto good = check_start(problem, *field.ground); !good) return pass_on(good);
    field.standing = Region{part_of(problem, field.standing)};
    made.ground = field.ground;
  }
  for (CoverField& field : made.fields) {
    set_reach(field, problem, made.arc_m);
    made.standing.insert(made.standing.end(), field.standing.begin(), field.standing.end());
    made.reach.insert(made.reach.end(), field.reach.begin(), field.reach.end());
  }
  return made;
}

}  // namespace outrider
