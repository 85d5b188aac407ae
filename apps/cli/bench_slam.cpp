#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench_laser.hpp"
#include "bench_slam_peer.hpp"
#include "bench_words.hpp"
#include "clocks.hpp"
#include "commands.hpp"
#include "output.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/g2o.hpp"
#include "progress.hpp"
#include "terminal.hpp"

namespace outrider::cli {
namespace {

struct BenchCommand {
  std::string data;
  int repeat = 1;
  bool json = false;
};

struct Row {
  std::string name;
  std::size_t nodes = 0;
  std::size_t edges = 0;
  PoseGraphSolution solution;
  double time_s = 0.0;
  std::optional<PeerResult> peer;

  /// The peer found less, beyond a hundredth of a percent.
  [[nodiscard]] bool beaten() const { return peer && peer->cost < solution.cost * (1.0 - 1e-4); }
};

struct Files {
  std::vector<std::string> graphs;
  std::vector<std::string> logs;
};

Outcome<Files> files_in(const std::string& folder) {
  namespace fs = std::filesystem;
  Files files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
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

Outcome<Row> measure(const std::string& path, int repeat) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected<Fault>(text.error());
  const auto graph = pose_graph_from_g2o(*text, path);
  if (!graph) return tl::unexpected<Fault>(graph.error());
  const std::string name = std::filesystem::path(path).filename().string();
  Row row{name.substr(0, name.find(".g2o")), graph->nodes.size(), graph->edges.size(), {}, HUGE_VAL, {}};
  for (int i = 0; i < repeat; ++i) {
    const auto begin = Clock::now();
    auto solution = optimise(*graph, {}, {});
    const double time_s = seconds_since(begin);
    if (!solution) return bad_input(solution.error().sentence, path);
    row.solution = std::move(*solution);
    row.time_s = std::min(row.time_s, time_s);
    const auto peer = solve_with_ceres(*graph);
    if (peer && (!row.peer || peer->time_s < row.peer->time_s)) row.peer = peer;
  }
  return row;
}

nlohmann::ordered_json row_json(const Row& row) {
  nlohmann::ordered_json json = {{"graph", row.name},           {"nodes", row.nodes},
                                 {"edges", row.edges},          {"cost", row.solution.cost},
                                 {"start", row.solution.start}, {"iterations", row.solution.iterations},
                                 {"time_s", row.time_s}};
  if (row.peer) {
    json["ceres"] = {
        {"cost", row.peer->cost}, {"iterations", row.peer->iterations}, {"time_s", row.peer->time_s}};
  }
  return json;
}

void print_table(const std::vector<Row>& rows) {
  show("  {:<24} {:>6} {:>6} {:>14} {:>6} {:>9} {:>14} {:>6} {:>9}\n", "graph", "nodes", "edges", "cost",
       "steps", "s", "Ceres: cost", "steps", "s");
  for (const Row& row : rows) {
    show("  {:<24} {:>6} {:>6} {:>14.6f} {:>6} {:>9.4f}", row.name, row.nodes, row.edges, row.solution.cost,
         row.solution.iterations, row.time_s);
    if (row.peer) show(" {:>14.6f} {:>6} {:>9.4f}", row.peer->cost, row.peer->iterations, row.peer->time_s);
    show("\n");
  }
}

struct Rows {
  std::vector<Row> graphs;
  std::vector<LaserRow> logs;
};

Outcome<Rows> measured(const Files& files, int repeat) {
  Rows rows;
  Progress progress(static_cast<int>(files.graphs.size() + files.logs.size()));
  for (const std::string& file : files.graphs) {
    progress.next(file);
    auto row = measure(file, repeat);
    if (!row) return pass_on(row);
    rows.graphs.push_back(std::move(*row));
  }
  for (const std::string& file : files.logs) {
    progress.next(file);
    auto row = measure_laser_log(file, repeat);
    if (!row) return pass_on(row);
    rows.logs.push_back(std::move(*row));
  }
  return rows;
}

int execute(const BenchCommand& command) {
  const auto files = files_in(command.data);
  if (!files) return say(files.error(), command.json);
  const auto rows = measured(*files, command.repeat);
  if (!rows) return say(rows.error(), command.json);
  const bool best =
      std::none_of(rows->graphs.begin(), rows->graphs.end(), [](const Row& row) { return row.beaten(); });
  if (command.json) {
    auto list = nlohmann::ordered_json::array();
    for (const Row& row : rows->graphs) list.push_back(row_json(row));
    for (const LaserRow& row : rows->logs) list.push_back(row_json(row));
    print({{"status", best ? "done" : "not_done"}, {"job", "bench slam"}, {"rows", std::move(list)}});
  } else {
    if (!rows->graphs.empty()) print_table(rows->graphs);
    if (!rows->logs.empty()) print_table(rows->logs);
  }
  return best ? job_done : job_not_done;
}

}  // namespace

void add_bench_slam(Command& bench) {
  Command& slam = bench.add(
      "slam", "pose graphs and laser logs: cost, error and time; graphs beside Ceres where it is installed");
  auto command = std::make_shared<BenchCommand>();
  slam.option("--data", &command->data, "folder with .g2o or .log files, which may be gzip-compressed")
      .required()
      .type("DIR");
  slam.option("--repeat", &command->repeat, "do each so often and keep the shortest time [1]")
      .between(1, 1000)
      .type("N");
  add_json(slam, command->json);
  slam.does([command](const Command&) { return execute(*command); });
  slam.footer("\nExample: outrider bench slam --data DIR --repeat 5");
}

}  // namespace outrider::cli
