#include "outrider/io/log/pyfg.hpp"

#include <fmt/format.h>

#include <array>
#include <set>

#include "log/graph_lines.hpp"

namespace outrider {
namespace {

constexpr std::array<GraphForm, 5> pyfg_forms = {{
    {"VERTEX_SE2", 1, 3, "VERTEX_SE2 time name x y heading", 2},
    {"VERTEX_XY", 1, 2, "VERTEX_XY name x y", 1},
    {"EDGE_SE2", 2, 9, "EDGE_SE2 time from to x y heading and 6 numbers of the covariance", 2},
    {"EDGE_SE2_XY", 2, 5, "EDGE_SE2_XY time from to x y and 3 numbers of the covariance", 2},
    {"EDGE_RANGE", 2, 2, "EDGE_RANGE time from to range and its variance", 2},
}};

struct PyfgReader {
  GraphLines<Pose2> lines;
  std::vector<Pose2> truth;
  std::set<char> robots;  ///< robots whose first pose was read

  Status vertex(std::string_view name, const Pose2& pose, bool is_point) {
    if (auto ok = lines.place(name, pose, is_point); !ok) return ok;
    truth.push_back(pose);
    lines.placed.back() = !is_point && robots.insert(name.front()).second;
    return {};
  }

  Status add(const GraphLine& line) {
    const auto& v = line.numbers;
    const std::span<const double> numbers(v);
    const std::string_view name = line.names[0];
    if (line.tag == "VERTEX_SE2") return vertex(name, {{v[0], v[1]}, v[2]}, false);
    if (line.tag == "VERTEX_XY") return vertex(name, {{v[0], v[1]}, 0.0}, true);
    for (const std::string_view end : line.names) {
      if (!lines.knows(end))
        return bad_input(fmt::format("there is no vertex {}; put its line before", excerpt(end)));
    }
    const std::string_view to = line.names[1];
    if (line.tag == "EDGE_SE2")
      return lines.join(EdgeKind::pose, name, to, {{v[0], v[1]}, v[2]}, numbers.subspan(3));
    if (line.tag == "EDGE_SE2_XY")
      return lines.join(EdgeKind::point, name, to, {{v[0], v[1]}, 0.0}, numbers.subspan(2));
    return lines.join(EdgeKind::range, name, to, {{v[0], 0.0}, 0.0}, numbers.subspan(1));
  }
};

}  // namespace

Outcome<TrueGraph> pose_graph_from_pyfg(std::string_view text, const std::string& name) {
  PyfgReader reader;
  reader.lines.covariances = true;
  auto read = read_graph_lines(text, name, pyfg_forms, "the plane",
                               [&](const GraphLine& line) { return reader.add(line); });
  if (!read) return pass_on(read);
  auto graph = std::move(reader.lines).finish();
  if (!graph) return bad_input(graph.error().sentence, name);
  return TrueGraph{std::move(*graph), std::move(reader.truth)};
}

}  // namespace outrider
