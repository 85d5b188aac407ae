#include "input.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>

#include "outrider/io/files/files.hpp"
#include "outrider/io/log/g2o.hpp"
#include "outrider/io/log/pyfg.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

/// Returns the words of the first line that has some and is not a comment.
std::vector<std::string> first_tokens(std::string_view text) {
  std::vector<std::string> words;
  bool comment = false;
  for (const char c : text) {
    if (c == '\n' && !words.empty()) break;
    if (c == '#') comment = true;
    if (c == '\n') comment = false;
    if (comment) continue;
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (space) {
      if (!words.empty() && !words.back().empty()) words.emplace_back();
      continue;
    }
    if (words.empty()) words.emplace_back();
    if (words.back().size() < 100) words.back() += c;
    if (words.size() > 12) break;
  }
  if (!words.empty() && words.back().empty()) words.pop_back();
  return words;
}

/// Returns the file of that name beside another, plain or with ".gz"; empty if there is none.
std::string beside(const std::string& path, const std::string& name) {
  for (const char* ending : {"", ".gz"}) {
    const fs::path found = fs::path(path).parent_path() / (name + ending);
    if (file_exists(found.string())) return found.string();
  }
  return {};
}

Outcome<SlamInput> load_mrclam(const std::string& path, const std::string& odometry, const LogNoise& noise) {
  std::string robot = fs::path(path).filename().string();
  robot = robot.substr(0, robot.find("Odometry.dat"));
  const auto read = [&](const std::string& name) -> Outcome<std::string> {
    const std::string found = beside(path, name);
    if (found.empty()) return bad_input(fmt::format("there is no {} beside it; put it there", name), path);
    return read_file(found);
  };
  const auto measurements = read(robot + "Measurement.dat");
  if (!measurements) return bad_input(measurements.error().sentence, measurements.error().where);
  const auto barcodes = read("Barcodes.dat");
  if (!barcodes) return bad_input(barcodes.error().sentence, barcodes.error().where);
  const bool known = !beside(path, "Landmark_Groundtruth.dat").empty();
  const auto landmarks = known ? read("Landmark_Groundtruth.dat") : Outcome<std::string>("");
  if (!landmarks) return bad_input(landmarks.error().sentence, landmarks.error().where);
  auto log = landmark_log_from_mrclam({{odometry, path},
                                       {*measurements, beside(path, robot + "Measurement.dat")},
                                       {*barcodes, beside(path, "Barcodes.dat")},
                                       {*landmarks, beside(path, "Landmark_Groundtruth.dat")}},
                                      noise);
  if (!log) return pass_on(log);
  return SlamInput(std::move(*log));
}

Outcome<SlamInput> load_freiburg(const std::string& path, const std::string& text, const std::string& truth,
                                 const LogNoise& noise) {
  const std::string map_path = truth.empty() ? beside(path, "world.dat") : truth;
  const auto map = map_path.empty() ? Outcome<std::string>("") : read_file(map_path);
  if (!map) return bad_input(map.error().sentence, map.error().where);
  auto log = landmark_log_from_freiburg({text, path}, {*map, map_path}, noise);
  if (!log) return pass_on(log);
  return SlamInput(std::move(*log));
}

bool is_name(const std::string& word) {
  return !word.empty() && std::isalpha(static_cast<unsigned char>(word.front())) != 0;
}

template <class Pose>
Outcome<SlamInput> input_of(Outcome<PoseGraphOf<Pose>> graph, const SlamScenario& scenario) {
  if (!graph) return pass_on(graph);
  if (scenario.measured_frame) *graph = in_measured_frame(std::move(*graph));
  return SlamInput(GraphInput<Pose>{std::move(*graph), {}});
}

Outcome<SlamInput> load_graph(const std::string& text, const std::vector<std::string>& words,
                              const SlamScenario& scenario) {
  const std::string& path = scenario.log;
  if ((words.size() > 1 && is_name(words[1])) || (words.size() > 2 && is_name(words[2]))) {
    auto graph = pose_graph_from_pyfg(text, path);
    if (!graph) return pass_on(graph);
    auto input = input_of<Pose2>(std::move(graph->graph), scenario);
    if (input) std::get<GraphInput<Pose2>>(*input).truth = std::move(graph->truth);
    return input;
  }
  const InformationTerms terms = scenario.information == "all"        ? InformationTerms::all
                                 : scenario.information == "diagonal" ? InformationTerms::diagonal
                                                                      : InformationTerms::isotropic;
  if (is_spatial_g2o(text)) return input_of(pose_graph3_from_g2o(text, path, terms), scenario);
  return input_of(pose_graph_from_g2o(text, path, terms), scenario);
}

}  // namespace

Outcome<SlamInput> load_slam_input(const SlamScenario& scenario) {
  const std::string& path = scenario.log;
  const auto text = read_file(path);
  if (!text) return bad_input(text.error().sentence, text.error().where);
  if (fs::path(path).filename().string().find("Odometry.dat") != std::string::npos) {
    return load_mrclam(path, *text, scenario.noise);
  }
  if (is_carmen_log(*text)) {
    auto log = laser_log_from_carmen({*text, path}, scenario.carmen);
    if (!log) return pass_on(log);
    return SlamInput(std::move(*log));
  }
  const std::vector<std::string> words = first_tokens(*text);
  const std::string tag = words.empty() ? "" : words.front();
  if (tag.starts_with("VERTEX") || tag.starts_with("EDGE") || tag == "FIX")
    return load_graph(*text, words, scenario);
  if (tag == "SENSOR" || (tag == "ODOMETRY" && words.size() == 4)) {
    return load_freiburg(path, *text, scenario.truth, scenario.noise);
  }
  if (tag == "ODOMETRY") {
    auto log = landmark_log_from_chain({*text, path});
    if (!log) return pass_on(log);
    return SlamInput(std::move(*log));
  }
  return bad_input("it is no graph and no log that is known; docs/jobs/slam.md lists them", path);
}

}  // namespace outrider
