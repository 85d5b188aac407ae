// Measures planners and solvers of Outrider beside libraries that Debian has, on the same problems in one
// process: Boost.Graph and LEMON on grids, OMPL among polygons, CBC on tours. Problems whose library is not
// installed are left out. The times do not include the preparation of maps and graphs. Answers of Outrider
// are checked.
//
//   bench_peers [--json]
//
// A row: how many problems it answered, the median and mean time of a problem, the mean time over that of the
// fastest planner of Outrider in the task, and the mean and the worst of cost over the least cost. Ends with
// 1 if an answer is wrong or exact methods disagree.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>

#include "peers.hpp"

namespace outrider::bench {
namespace {

double mean_us(const PeerRow& row) {
  return std::accumulate(row.times_us.begin(), row.times_us.end(), 0.0) /
         static_cast<double>(row.times_us.size());
}

double median_us(const PeerRow& row) {
  std::vector<double> sorted = row.times_us;
  std::ranges::sort(sorted);
  return sorted[sorted.size() / 2];
}

/// The best values among the answers to a task.
struct Task {
  std::vector<double> least_cost;
  double least_mean_us = std::numeric_limits<double>::infinity();  ///< of Outrider
};

std::map<std::string, Task> tasks_of(const std::vector<PeerRow>& rows) {
  std::map<std::string, Task> tasks;
  for (const PeerRow& row : rows) {
    Task& task = tasks[row.task];
    if (task.least_cost.empty()) task.least_cost = row.costs;
    for (std::size_t i = 0; i < row.costs.size(); ++i) {
      task.least_cost[i] = std::fmin(task.least_cost[i], row.costs[i]);
    }
    if (row.whose == Whose::ours) task.least_mean_us = std::min(task.least_mean_us, mean_us(row));
  }
  return tasks;
}

nlohmann::ordered_json summary_of(const PeerRow& row, const Task& task) {
  double sum = 0.0, worst = 0.0;
  std::size_t answered = 0;
  for (std::size_t i = 0; i < row.costs.size(); ++i) {
    if (!std::isfinite(row.costs[i])) continue;
    const double ratio = row.costs[i] / task.least_cost[i];
    sum += ratio;
    worst = std::max(worst, ratio);
    ++answered;
  }
  const auto rounded = [](double value) { return std::stod(fmt::format("{:.5g}", value)); };
  return {{"task", row.task},
          {"solver", row.solver},
          {"answered", fmt::format("{} of {}", answered, row.costs.size())},
          {"median us", rounded(median_us(row))},
          {"mean us", rounded(mean_us(row))},
          {"times as long", rounded(mean_us(row) / task.least_mean_us)},
          {"mean cost over least", rounded(sum / static_cast<double>(std::max<std::size_t>(1, answered)))},
          {"worst", rounded(worst)}};
}

int run(bool json) {
  std::vector<PeerRow> rows;
  for (auto* make : {grid_rows, polygon_rows, tour_rows}) {
    for (PeerRow& row : make()) rows.push_back(std::move(row));
  }
  const auto tasks = tasks_of(rows);
  bool right = true;
  auto all = nlohmann::ordered_json::array();
  for (const PeerRow& row : rows) {
    all.push_back(summary_of(row, tasks.at(row.task)));
    for (std::size_t i = 0; i < row.costs.size() && row.whose != Whose::sampling_peer; ++i) {
      right = right && std::abs(row.costs[i] / tasks.at(row.task).least_cost[i] - 1.0) < 1e-6;
    }
    if (!json) fmt::print("{}\n", all.back().dump());
  }
  if (json) fmt::print("{}\n", nlohmann::ordered_json{{"rows", all}}.dump());
  if (!right) fmt::print(stderr, "an exact method gave another cost, or none\n");
  return right ? 0 : 1;
}

}  // namespace
}  // namespace outrider::bench

int main(int count, char** words) {
  return outrider::bench::run(count > 1 && std::string_view(words[1]) == "--json");
}
