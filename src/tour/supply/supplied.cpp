#include "supply/supplied.hpp"

namespace outrider::tour {
namespace {

bool holds(double left, double full) { return !(left < -store_rounding * full); }

/// Drives to a stop: its time passes and its charge is gone.
void go(const Supplied& supplied, Fuel& fuel, std::uint32_t stop) {
  if (stop == fuel.state.stop) return;
  const std::size_t arc = supplied.instance.arc(fuel.state.stop, stop);
  const double seconds = drive(supplied.instance, fuel.state, stop);
  fuel.time += seconds;
  fuel.charge -= supplied.per_metre * supplied.metres[arc] + supplied.per_second * seconds;
}

void pass(const Supplied& supplied, Fuel& fuel, double seconds) {
  fuel.time += seconds;
  fuel.charge -= supplied.per_second * seconds;
}

}  // namespace

Outcome<Supplied> compile(const SupplyProblem& problem) {
  std::vector<std::size_t> kept;
  for (const TourStation& station : problem.stations) kept.push_back(station.stop);
  auto instance = compile(problem.table, kept);
  if (!instance) return pass_on(instance);
  Supplied supplied{std::move(*instance),
                    {},
                    problem.water,
                    problem.charge,
                    problem.water_per_shot,
                    problem.charge_per_shot,
                    problem.charge_per_metre,
                    problem.charge_per_second,
                    {},
                    false};
  const auto& names = supplied.instance.stop_name;
  for (const std::size_t from : names) {
    for (const std::size_t to : names) {
      supplied.metres.push_back(problem.lengths_m[from * problem.table.services.size() + to]);
    }
  }
  for (std::size_t f = 0; f < problem.stations.size(); ++f) {
    const TourStation& station = problem.stations[f];
    const auto stop = std::ranges::find(names, station.stop);
    if (stop == names.end()) continue;
    supplied.depots.push_back({static_cast<std::uint32_t>(stop - names.begin()), station.store,
                               station.fixed_s, station.per_unit_s, f});
    supplied.returns = supplied.returns || station.store == Store::charge;
  }
  return supplied;
}

Fuel full_at_start(const Supplied& supplied) {
  return {start_of(supplied.instance), 0.0, supplied.water, supplied.charge};
}

double charge_home(const Supplied& supplied, const State& state) {
  if (!supplied.returns) return 0.0;
  double least = infinity;
  for (const FuelStation& depot : supplied.depots) {
    if (depot.store != Store::charge) continue;
    Fuel fuel{state, 0.0, 0.0, 0.0};
    go(supplied, fuel, depot.stop);
    least = std::min(least, -fuel.charge);
  }
  return least;
}

bool serve(const Supplied& supplied, Fuel& fuel, const TourNode& node) {
  go(supplied, fuel, node.stop);
  pass(supplied, fuel, advance(supplied.instance, fuel.state, node));
  fuel.water -= supplied.per_shot;
  fuel.charge -= supplied.charge_per_shot;
  if (!holds(fuel.water, supplied.water)) return false;
  return std::isinf(fuel.charge) || holds(fuel.charge - charge_home(supplied, fuel.state), supplied.charge);
}

bool fill(const Supplied& supplied, Fuel& fuel, const FuelStation& depot) {
  go(supplied, fuel, depot.stop);
  State& state = fuel.state;
  pass(supplied, fuel, aim_time(supplied.instance, wrap_angle(state.yaw), state.pitch, 0.0, 0.0));
  state.yaw = 0.0;
  state.pitch = 0.0;
  if (!holds(fuel.charge, supplied.charge)) return false;
  double& level = depot.store == Store::water ? fuel.water : fuel.charge;
  const double full = depot.store == Store::water ? supplied.water : supplied.charge;
  fuel.time += depot.fixed + depot.per_unit * std::max(0.0, full - level);
  level = full;
  return true;
}

std::vector<SupplyStep> steps_of(const Supplied& supplied, const std::vector<std::uint32_t>& choices) {
  const Instance& instance = supplied.instance;
  std::vector<SupplyStep> steps;
  for (const std::uint32_t choice : choices) {
    if (choice >= instance.nodes.size()) {
      const FuelStation& depot = supplied.depots[choice - instance.nodes.size()];
      steps.push_back({instance.stop_name[depot.stop], {}, depot.name});
      continue;
    }
    const TourNode& node = instance.nodes[choice];
    const std::size_t stop = instance.stop_name[node.stop];
    if (steps.empty() || steps.back().station || steps.back().stop != stop) steps.push_back({stop, {}, {}});
    steps.back().goals.push_back(node.goal);
  }
  return steps;
}

}  // namespace outrider::tour
