#include "supply_programme.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "supply_graph.hpp"

#ifdef OUTRIDER_WITH_CBC
#include <coin/Cbc_C_Interface.h>
#endif

namespace outrider {

#ifndef OUTRIDER_WITH_CBC

bool supply_programme_is_available() { return false; }

Outcome<SupplyProgramme> solve_by_programme(const SupplyProblem&, std::int64_t) {
  return bad_input("these tests were built without CBC; install coinor-libcbc-dev and build again");
}

#else

namespace {

constexpr int most_columns = 40'000;
constexpr double no_end = 1e30;  // CBC's infinity is larger

struct Entry {
  int row = 0;
  double value = 0.0;
};

/// Columns with their entries, rows with their limits.
struct Programme {
  std::vector<std::vector<Entry> > columns;
  std::vector<double> objective, column_high;
  std::vector<char> whole;
  std::vector<double> row_low, row_high;

  int add_column(double cost, double high, bool is_whole) {
    columns.emplace_back();
    objective.push_back(cost);
    column_high.push_back(high);
    whole.push_back(is_whole ? 1 : 0);
    return static_cast<int>(columns.size()) - 1;
  }
  int add_row(double low, double high) {
    row_low.push_back(low);
    row_high.push_back(high);
    return static_cast<int>(row_low.size()) - 1;
  }
  void put(int row, int column, double value) {
    if (value != 0.0) columns[static_cast<std::size_t>(column)].push_back({row, value});
  }
};

/// A flow along the arcs, with one row for each vertex: out of it less into it.
struct Flow {
  std::vector<int> column;   // by arc
  std::vector<int> balance;  // by vertex
};

class Formulation {
 public:
  Formulation(const SupplyProblem& problem, const tour::SupplyGraph& graph)
      : problem_(problem), graph_(graph) {
    for (const tour::SupplyArc& arc : graph.arcs) x_.push_back(programme.add_column(arc.time, 1.0, true));
    visit_once();
    serve_each_goal();
    count_goals();
    if (std::isfinite(problem.water)) carry_water();
    if (std::isfinite(problem.charge)) carry_charge();
    take_copies_in_order();
  }

  /// The steps along the arcs taken, from the start on.
  [[nodiscard]] std::vector<SupplyStep> read(const double* solution) const {
    std::vector<SupplyStep> steps;
    for (std::size_t at = 0; at < graph_.vertices.size();) {
      std::size_t next = graph_.vertices.size();
      for (std::size_t a = 0; a < graph_.arcs.size(); ++a) {
        if (graph_.arcs[a].from == at && solution[x_[a]] > 0.5) next = graph_.arcs[a].to;
      }
      if (next == graph_.vertices.size()) break;
      const tour::SupplyVertex& vertex = graph_.vertices[next];
      const bool same =
          vertex.goal && !steps.empty() && !steps.back().station && steps.back().stop == vertex.stop;
      if (!same) steps.push_back({vertex.stop, {}, vertex.station});
      if (vertex.goal) steps.back().goals.push_back(*vertex.goal);
      at = next;
    }
    return steps;
  }

  Programme programme;

 private:
  [[nodiscard]] bool is_end(std::size_t vertex) const { return vertex == graph_.vertices.size(); }
  [[nodiscard]] bool fills(std::size_t vertex, Store store) const {
    const auto& station = graph_.vertices[vertex].station;
    return station && problem_.stations[*station].store == store;
  }

  void visit_once() {
    std::vector<int> into, through;
    for (std::size_t v = 0; v < graph_.vertices.size(); ++v) {
      into.push_back(programme.add_row(0.0, v == 0 ? 0.0 : 1.0));
      through.push_back(v == 0 ? programme.add_row(1.0, 1.0) : programme.add_row(0.0, 0.0));
    }
    const int end = programme.add_row(1.0, 1.0);
    for (std::size_t a = 0; a < x_.size(); ++a) {
      const auto& [from, to, time, charge] = graph_.arcs[a];
      programme.put(through[from], x_[a], 1.0);
      programme.put(is_end(to) ? end : into[to], x_[a], 1.0);
      if (!is_end(to)) programme.put(through[to], x_[a], -1.0);
    }
  }

  void serve_each_goal() {
    std::vector<int> rows;
    for (std::size_t g = 0; g < problem_.table.goals; ++g) rows.push_back(programme.add_row(1.0, 1.0));
    for (std::size_t a = 0; a < x_.size(); ++a) {
      const std::size_t to = graph_.arcs[a].to;
      if (!is_end(to) && graph_.vertices[to].goal) programme.put(rows[*graph_.vertices[to].goal], x_[a], 1.0);
    }
  }

  /// A flow of at most `most` on each arc taken; `starts` leaves the start.
  Flow add_flow(double most, double starts) {
    Flow flow;
    for (std::size_t v = 0; v < graph_.vertices.size(); ++v) {
      const double leaves = v == 0 ? starts : 0.0;
      flow.balance.push_back(programme.add_row(leaves, leaves));
    }
    for (std::size_t a = 0; a < x_.size(); ++a) {
      const int column = programme.add_column(0.0, most, false);
      flow.column.push_back(column);
      const int cap = programme.add_row(-no_end, 0.0);
      programme.put(cap, column, 1.0);
      programme.put(cap, x_[a], -most);
      programme.put(flow.balance[graph_.arcs[a].from], column, 1.0);
    }
    return flow;
  }

  void count_goals() {
    const Flow flow = add_flow(static_cast<double>(problem_.table.goals), 0.0);
    for (std::size_t a = 0; a < x_.size(); ++a) {
      const std::size_t to = graph_.arcs[a].to;
      if (is_end(to)) continue;
      programme.put(flow.balance[to], flow.column[a], -1.0);
      if (graph_.vertices[to].goal) programme.put(flow.balance[to], x_[a], -1.0);
    }
  }

  /// Adds the time to fill up at the end of an arc, where `used` of the store goes on the arc itself.
  void price_fill(std::size_t a, int flow_column, double full, double used) {
    const TourStation& station = problem_.stations[*graph_.vertices[graph_.arcs[a].to].station];
    programme.objective[static_cast<std::size_t>(x_[a])] +=
        station.fixed_s + station.per_unit_s * full * (1.0 + used);
    programme.objective[static_cast<std::size_t>(flow_column)] -= station.per_unit_s * full;
  }

  void carry_water() {
    const Flow flow = add_flow(1.0, 1.0);
    for (std::size_t a = 0; a < x_.size(); ++a) {
      const std::size_t to = graph_.arcs[a].to;
      if (is_end(to)) continue;
      if (fills(to, Store::water)) {
        programme.put(flow.balance[to], x_[a], -1.0);
        price_fill(a, flow.column[a], problem_.water, 0.0);
        continue;
      }
      programme.put(flow.balance[to], flow.column[a], -1.0);
      if (graph_.vertices[to].goal) {
        programme.put(flow.balance[to], x_[a], problem_.water_per_shot / problem_.water);
      }
    }
  }

  void carry_charge() {
    const Flow flow = add_flow(1.0, 1.0);
    std::vector<int> home;
    for (std::size_t v = 0; v < graph_.vertices.size(); ++v) home.push_back(programme.add_row(0.0, no_end));
    for (std::size_t a = 0; a < x_.size(); ++a) {
      const auto& [from, to, time, charge] = graph_.arcs[a];
      const double used = charge / problem_.charge;
      const int enough = programme.add_row(0.0, no_end);
      programme.put(enough, flow.column[a], 1.0);
      programme.put(enough, x_[a], -used);
      programme.put(home[from], flow.column[a], 1.0);
      programme.put(home[from], x_[a], -graph_.vertices[from].home / problem_.charge);
      if (is_end(to)) continue;
      if (fills(to, Store::charge)) {
        programme.put(flow.balance[to], x_[a], -1.0);
        price_fill(a, flow.column[a], problem_.charge, used);
        continue;
      }
      programme.put(flow.balance[to], flow.column[a], -1.0);
      programme.put(flow.balance[to], x_[a], used);
    }
  }

  /// Copies are alike: the second one is taken only when the first one is.
  void take_copies_in_order() {
    std::vector<int> after(graph_.vertices.size(), -1);
    for (std::size_t v = 1; v < graph_.vertices.size(); ++v) {
      if (graph_.vertices[v].copy > 0) after[v] = programme.add_row(0.0, no_end);
    }
    for (std::size_t a = 0; a < x_.size(); ++a) {
      const std::size_t to = graph_.arcs[a].to;
      if (is_end(to)) continue;
      if (after[to] >= 0) programme.put(after[to], x_[a], -1.0);
      if (to + 1 < after.size() && after[to + 1] >= 0) programme.put(after[to + 1], x_[a], 1.0);
    }
  }

  const SupplyProblem& problem_;
  const tour::SupplyGraph& graph_;
  std::vector<int> x_;
};

using Solver = std::unique_ptr<Cbc_Model, void (*)(Cbc_Model*)>;

Solver load(const Programme& programme) {
  std::vector<CoinBigIndex> first{0};
  std::vector<int> rows;
  std::vector<double> values;
  for (const auto& column : programme.columns) {
    for (const Entry& entry : column) {
      rows.push_back(entry.row);
      values.push_back(entry.value);
    }
    first.push_back(static_cast<CoinBigIndex>(rows.size()));
  }
  const std::vector<double> low(programme.columns.size(), 0.0);
  Solver solver(Cbc_newModel(), Cbc_deleteModel);
  Cbc_loadProblem(solver.get(), static_cast<int>(programme.columns.size()),
                  static_cast<int>(programme.row_low.size()), first.data(), rows.data(), values.data(),
                  low.data(), programme.column_high.data(), programme.objective.data(),
                  programme.row_low.data(), programme.row_high.data());
  for (std::size_t c = 0; c < programme.whole.size(); ++c) {
    if (programme.whole[c] != 0) Cbc_setInteger(solver.get(), static_cast<int>(c));
  }
  return solver;
}

}  // namespace

bool supply_programme_is_available() { return true; }

Outcome<SupplyProgramme> solve_by_programme(const SupplyProblem& problem, std::int64_t nodes) {
  if (auto ok = check(problem); !ok) return pass_on(ok);
  SupplyProgramme answer;
  if (problem.table.goals == 0) {
    answer.tour.proven_optimal = true;
    return answer;
  }
  const tour::SupplyGraph graph = tour::supply_graph(problem);
  const Formulation formulation(problem, graph);
  const Programme& programme = formulation.programme;
  answer.columns = programme.columns.size();
  answer.rows = programme.row_low.size();
  if (answer.columns > most_columns) {
    return bad_input(
        fmt::format("the programme has {} columns; at most {} are solved, give fewer goals or stops",
                    answer.columns, most_columns));
  }
  const Solver solver = load(programme);
  Cbc_setParameter(solver.get(), "log", "0");
  Cbc_setParameter(solver.get(), "ratioGap", "0");
  Cbc_setParameter(solver.get(), "allowableGap", "1e-7");
  Cbc_setParameter(solver.get(), "maxNodes", std::to_string(nodes).c_str());
  Cbc_solve(solver.get());
  if (Cbc_isProvenInfeasible(solver.get()) != 0) {
    return fault(FaultCode::no_path, "no tour serves every goal on these supplies");
  }
  if (Cbc_bestSolution(solver.get()) == nullptr) {
    return fault(FaultCode::budget_exhausted, fmt::format("no tour was found in {} nodes", nodes));
  }
  answer.objective_s = Cbc_getObjValue(solver.get());
  answer.tour.steps = formulation.read(Cbc_bestSolution(solver.get()));
  answer.tour.proven_optimal = Cbc_isProvenOptimal(solver.get()) != 0;
  const auto after = levels(problem, answer.tour.steps);
  if (!after) return pass_on(after);
  answer.tour.cost_s = after->back().time_s;
  return answer;
}

#endif

}  // namespace outrider
