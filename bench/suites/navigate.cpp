// The time that a step of the navigator takes, against what it has to deal with.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "goal_drive.hpp"
#include "outrider/core/rng.hpp"
#include "rows.hpp"

namespace outrider::bench {
namespace {

constexpr double big_hall_m = 24.0;  // of the hall
constexpr double step_rate_hz = 20.0;
constexpr Vec2 big_hall_corners[] = {{9.0, 9.0}, {-9.0, -9.0}, {9.0, -9.0}, {-9.0, 9.0}};

/// The surroundings that a navigator has to deal with.
struct Load {
  std::string varied;
  std::int64_t beams = 360, posts = 40, people = 0;
};

struct StepRow {
  Load load;
  double marks = 0.0, followed = 0.0;  ///< means
  double median_us = 0.0, most_us = 0.0, mean_us = 0.0;
  double robots = 0.0;    ///< that one core carries
  double exponent = 0.0;  ///< power with which the median grows in these rows

  /// Returns the amount that is varied.
  [[nodiscard]] double amount() const {
    if (load.varied == "beams") return static_cast<double>(load.beams);
    return load.varied == "marks" ? marks : static_cast<double>(load.people);
  }
};

nlohmann::ordered_json row_json(const StepRow& row) {
  return {{"varied", row.load.varied}, {"beams", row.load.beams},  {"marks", row.marks},
          {"moving", row.load.people}, {"followed", row.followed}, {"median_us", row.median_us},
          {"us_99", row.most_us},      {"mean_us", row.mean_us},   {"robots", row.robots},
          {"exponent", row.exponent}};
}

std::string table_text(const std::vector<StepRow>& rows) {
  std::string text = fmt::format(
      "varied  beams  marks  moving  followed  median us  99 % us  mean us  "
      "robots at {:.0f} Hz  exponent\n",
      step_rate_hz);
  for (const StepRow& row : rows) {
    text += fmt::format("{:7} {:5}  {:5.0f}  {:6}  {:8.1f}  {:9.0f}  {:7.0f}  {:7.0f}  {:15.1f}  {:8.2f}\n",
                        row.load.varied, row.load.beams, row.marks, row.load.people, row.followed,
                        row.median_us, row.most_us, row.mean_us, row.robots, row.exponent);
  }
  return text;
}

World big_hall(std::int64_t posts) {
  World world;
  world.name = "hall";
  const double half_m = 0.5 * big_hall_m;
  world.bounds = {{-half_m, -half_m}, {half_m, half_m}};
  for (const double side : {-half_m, half_m}) {
    world.solids.push_back({"wall", {{side, 0.0, 0.5}, {}}, BoxShape{{0.1, half_m, 0.5}}});
    world.solids.push_back({"wall", {{0.0, side, 0.5}, {}}, BoxShape{{half_m, 0.1, 0.5}}});
  }
  Rng rng(1);
  for (std::int64_t i = 0; i < posts;) {
    const double x = rng.uniform(-11.0, 11.0);
    const Vec2 at{x, rng.uniform(-11.0, 11.0)};
    if (norm(at) < 1.0 ||
        std::ranges::any_of(big_hall_corners, [&](Vec2 c) { return distance(at, c) < 1.0; }))
      continue;
    world.solids.push_back({"post", {{at.x, at.y, 0.5}, {}}, CylinderShape{0.2, 0.5}});
    ++i;
  }
  return world;
}

/// Drives from corner to corner, and measures each step.
StepRow measure_steps(const Load& load, std::int64_t steps, const std::function<double()>& processor_s) {
  NavigatorSetup setup = jackal("sampled");
  setup.robot.speed_mps = 1.0;
  ExplorerSimParams devices = jackal_devices(setup);
  devices.laser.beams = load.beams;
  devices.laser.view_rad = 2.0 * pi;
  devices.laser.rate_hz = step_rate_hz;
  devices.faults.walk_ins.people = load.people;
  devices.faults.walk_ins.people_social = true;
  SimulatedRobot robot = simulated_explorer(big_hall(load.posts), {}, setup.robot, devices, 1);
  auto navigator = Navigator::make(setup, Pose2{});
  StepRow row;
  row.load = load;
  std::vector<double> taken_us;
  std::size_t corner = 0;
  for (std::int64_t step = 0; step < steps; ++step) {
    const Observation seen = robot.sense();
    const double begin_s = processor_s();
    const Situation now = navigator->perceive(seen);
    const Command command = navigator->act(GoTo{big_hall_corners[corner % std::size(big_hall_corners)], 0.3});
    taken_us.push_back(1e6 * (processor_s() - begin_s));
    robot.act(command);
    if (step > 0 && now.progress.state != Progress::State::underway) ++corner;
    row.marks += static_cast<double>(navigator->map().marks().size()) / static_cast<double>(steps);
    row.followed += static_cast<double>(navigator->moving().size()) / static_cast<double>(steps);
  }
  row.median_us = quantile(taken_us, 0.5);
  row.most_us = quantile(taken_us, 0.99);
  for (const double one_us : taken_us) row.mean_us += one_us / static_cast<double>(steps);
  row.robots = 1e6 / step_rate_hz / row.mean_us;
  return row;
}

/// Fits the median as a power of the amount, by least squares of the logarithms.
double exponent_of(const std::vector<StepRow>& rows) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const StepRow& row : rows) {
    if (row.amount() <= 0.0) continue;
    const double u = std::log(row.amount()), v = std::log(row.median_us);
    n += 1.0, x += u, y += v, xx += u * u, xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

const std::vector<std::vector<Load>>& loads() {
  static const std::vector<std::vector<Load>> loads = {
      {{"beams", 180}, {"beams", 360}, {"beams", 720}, {"beams", 1440}},
      {{"marks", 360, 0}, {"marks", 360, 20}, {"marks", 360, 60}, {"marks", 360, 180}},
      {{"moving", 360, 0, 0}, {"moving", 360, 0, 5}, {"moving", 360, 0, 15}, {"moving", 360, 0, 30}},
  };
  return loads;
}

}  // namespace

Outcome<BenchResult> measure_navigate(const NavigateRequest& request, const BenchObserver& observer) {
  begin_steps(observer, loads().size() * loads().front().size());
  std::vector<StepRow> rows;
  for (const std::vector<Load>& group : loads()) {
    std::vector<StepRow> measured;
    for (const Load& load : group) {
      next_step(observer, fmt::format("{} beams, {} posts, {} people", load.beams, load.posts, load.people));
      measured.push_back(measure_steps(load, request.steps, observer.processor_s));
    }
    const double exponent = exponent_of(measured);
    for (StepRow& row : measured) row.exponent = exponent;
    rows.insert(rows.end(), measured.begin(), measured.end());
  }
  return result_of(rows);
}

}  // namespace outrider::bench
