// Measures the pose graphs and laser logs of a folder, and compares graphs with Ceres.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "laser.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/log/g2o.hpp"
#include "outrider/slam/bounds/pose_graph_bound.hpp"
#include "rows.hpp"
#include "slam_peer.hpp"
#include "stopwatch.hpp"

namespace outrider::bench {
namespace {

struct GraphRow {
  std::string name;
  std::size_t nodes = 0;
  std::size_t edges = 0;
  double cost = 0.0;
  std::string start;
  std::int64_t iterations = 0;
  bool converged = false;
  double time_s = HUGE_VAL;
  std::optional<double> bound;  ///< no poses cost less
  double bound_s = HUGE_VAL;
  std::optional<PeerResult> peer;

  /// Returns true if the peer found a lower cost, by more than 0.01 %.
  [[nodiscard]] bool beaten() const { return peer && peer->cost < cost * (1.0 - 1e-4); }
  /// Returns by which part of it the cost can be above the least, as far as is proven.
  [[nodiscard]] std::optional<double> gap() const {
    return bound && cost > 0.0 ? std::optional(std::max(0.0, cost - *bound) / cost) : std::nullopt;
  }
};

struct Files {
  std::vector<std::string> graphs;
  std::vector<std::string> logs;
};

Outcome<Files> files_in(const std::string& folder) {
  namespace fs = std::filesystem;
  Files files;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".g2o") || name.ends_with(".g2o.gz")) files.graphs.push_back(entry.path().string());
    if (name.ends_with(".log") || name.ends_with(".log.gz")) files.logs.push_back(entry.path().string());
  }
  if (files.graphs.empty() && files.logs.empty()) {
    return bad_input("there are no .g2o and no .log files; name their folder", folder);
  }
  std::sort(files.graphs.begin(), files.graphs.end());
  std::sort(files.logs.begin(), files.logs.end());
  return files;
}

template <class Pose>
Outcome<GraphRow> measure(const Outcome<PoseGraphOf<Pose>>& graph, const std::string& path, int repeat) {
  if (!graph) return pass_on(graph);
  const std::string name = std::filesystem::path(path).filename().string();
  GraphRow row;
  row.name = name.substr(0, name.find(".g2o"));
  row.nodes = graph->nodes.size();
  row.edges = graph->edges.size();
  for (int i = 0; i < repeat; ++i) {
    const Stopwatch watch;
    const auto solution = optimise(*graph, {}, {});
    row.time_s = std::min(row.time_s, watch.seconds());
    if (!solution) return bad_input(solution.error().sentence, path);
    row.cost = solution->cost;
    row.start = solution->start;
    row.iterations = solution->iterations;
    row.converged = solution->converged;
    const Stopwatch bound_watch;
    const auto bound = least_cost_bound(*graph, solution->poses);
    row.bound_s = std::min(row.bound_s, bound_watch.seconds());
    if (bound) row.bound = *bound;
    const auto peer = solve_with_ceres(*graph);
    if (peer && (!row.peer || peer->time_s < row.peer->time_s)) row.peer = peer;
  }
  return row;
}

/// Measures the graph; one whose information matrices are not positive definite, with isotropic ones.
Outcome<GraphRow> measure(const std::string& path, int repeat) {
  const auto text = read_file(path);
  if (!text) return pass_on(text);
  if (!is_spatial_g2o(*text)) return measure(pose_graph_from_g2o(*text, path), path, repeat);
  const auto graph = pose_graph3_from_g2o(*text, path);
  if (graph) return measure(graph, path, repeat);
  auto row = measure(pose_graph3_from_g2o(*text, path, InformationTerms::isotropic), path, repeat);
  if (row) row->name += " (isotropic)";
  return row;
}

nlohmann::ordered_json row_json(const GraphRow& row) {
  nlohmann::ordered_json json = {{"graph", row.name},          {"nodes", row.nodes},
                                 {"edges", row.edges},         {"cost", row.cost},
                                 {"start", row.start},         {"iterations", row.iterations},
                                 {"converged", row.converged}, {"time_s", row.time_s}};
  if (row.bound) json["bound"] = {{"cost", *row.bound}, {"time_s", row.bound_s}};
  if (row.gap()) json["bound"]["gap"] = *row.gap();
  if (row.peer) {
    json["ceres"] = {{"cost", row.peer->cost},
                     {"iterations", row.peer->iterations},
                     {"time_s", row.peer->time_s},
                     {"time_ratio", row.peer->time_s / row.time_s}};
  }
  return json;
}

std::string table_text(const std::vector<GraphRow>& rows) {
  std::string text = fmt::format(
      "  {:<24} {:>6} {:>6} {:>14} {:>6} {:>9} {:>11} {:>9} {:>14} {:>6} {:>9} {:>7}\n", "graph", "nodes",
      "edges", "cost", "steps", "s", "proven gap", "s", "Ceres: cost", "steps", "s", "times");
  for (const GraphRow& row : rows) {
    text += fmt::format("  {:<24} {:>6} {:>6} {:>14.6f} {:>6} {:>9.4f} {:>11} {:>9.4f}", row.name, row.nodes,
                        row.edges, row.cost, row.iterations, row.time_s,
                        row.gap() ? fmt::format("{:.2g}", *row.gap()) : "-", row.bound_s);
    if (row.peer)
      text += fmt::format(" {:>14.6f} {:>6} {:>9.4f} {:>7.1f}", row.peer->cost, row.peer->iterations,
                          row.peer->time_s, row.peer->time_s / row.time_s);
    text += '\n';
  }
  return text;
}

struct Rows {
  std::vector<GraphRow> graphs;
  std::vector<LaserRow> logs;
};

Outcome<Rows> measured(const Files& files, int repeat, const BenchObserver& observer) {
  Rows rows;
  begin_steps(observer, files.graphs.size() + files.logs.size());
  for (const std::string& file : files.graphs) {
    next_step(observer, file);
    auto row = measure(file, repeat);
    if (!row) return pass_on(row);
    rows.graphs.push_back(std::move(*row));
  }
  for (const std::string& file : files.logs) {
    next_step(observer, file);
    auto row = measure_laser_log(file, repeat, observer.processor_s);
    if (!row) return pass_on(row);
    rows.logs.push_back(std::move(*row));
  }
  return rows;
}

}  // namespace

Outcome<BenchResult> measure_slam(const SlamRequest& request, const BenchObserver& observer) {
  auto files = files_in(request.data);
  if (!files) return pass_on(files);
  auto rows = measured(*files, request.repeat, observer);
  if (!rows) return pass_on(rows);
  BenchResult result;
  result.right =
      std::ranges::none_of(rows->graphs, [](const GraphRow& row) { return row.beaten() || !row.converged; });
  for (const GraphRow& row : rows->graphs) result.rows.push_back(row_json(row));
  for (const LaserRow& row : rows->logs) result.rows.push_back(row_json(row));
  if (!rows->graphs.empty()) result.table += table_text(rows->graphs);
  if (!rows->logs.empty()) result.table += table_text(rows->logs);
  return result;
}

}  // namespace outrider::bench
