#include "outrider/io/g2o.hpp"

#include <fmt/format.h>

#include <array>

#include "graph_lines.hpp"

namespace outrider {
namespace {

struct Form {
  std::string_view tag;
  std::size_t names;
  std::size_t numbers;
  std::string_view sentence;
};
constexpr std::array<Form, 5> forms = {{
    {"VERTEX_SE2", 1, 3, "VERTEX_SE2 id x y heading"},
    {"VERTEX_XY", 1, 2, "VERTEX_XY id x y"},
    {"EDGE_SE2", 2, 9, "EDGE_SE2 from to x y heading and 6 numbers of the information's upper triangle"},
    {"EDGE_SE2_XY", 2, 5, "EDGE_SE2_XY from to x y and 3 numbers of the information's upper triangle"},
    {"FIX", 1, 0, "FIX id"},
}};

Status read_line(std::string_view line, GraphLines& lines) {
  const std::vector<std::string_view> all = words(line);
  const Form* form = nullptr;
  for (const Form& candidate : forms) {
    if (candidate.tag == all[0]) form = &candidate;
  }
  if (form == nullptr) {
    return bad_input(
        fmt::format("'{}' is no line of a graph of the plane; expected VERTEX_SE2, VERTEX_XY, EDGE_SE2, "
                    "EDGE_SE2_XY or FIX",
                    excerpt(all[0])));
  }
  const std::span<const std::string_view> rest(all.begin() + 1, all.end());
  const auto values =
      rest.size() == form->names + form->numbers ? numbers_of(rest.subspan(form->names)) : std::nullopt;
  const bool names =
      values && number<std::int64_t>(rest[0]) && (form->names < 2 || number<std::int64_t>(rest[1]));
  if (!names) return bad_input(fmt::format("'{}' is not valid; expected {}", excerpt(line), form->sentence));
  const auto& v = *values;
  const std::span<const double> numbers(v);
  if (form->tag == "VERTEX_SE2") return lines.place(rest[0], {{v[0], v[1]}, v[2]}, false);
  if (form->tag == "VERTEX_XY") return lines.place(rest[0], {{v[0], v[1]}, 0.0}, true);
  if (form->tag == "EDGE_SE2") {
    return lines.join(EdgeKind::pose, rest[0], rest[1], {{v[0], v[1]}, v[2]}, numbers.subspan(3), false);
  }
  if (form->tag == "EDGE_SE2_XY") {
    return lines.join(EdgeKind::point, rest[0], rest[1], {{v[0], v[1]}, 0.0}, numbers.subspan(2), false);
  }
  const bool first = !lines.graph.nodes.empty() && lines.graph.nodes.front().name == rest[0];
  return first ? Status{} : bad_input("only the first vertex can be fixed; take the line out");
}

}  // namespace

Outcome<PoseGraph> pose_graph_from_g2o(std::string_view text, const std::string& name) {
  GraphLines lines;
  auto read = read_graph_lines(text, name, [&](std::string_view line) { return read_line(line, lines); });
  if (!read) return pass_on(read);
  auto graph = std::move(lines).finish();
  if (!graph) return bad_input(graph.error().sentence, name);
  return graph;
}

Outcome<std::string> to_g2o(const PoseGraph& graph, const std::vector<Pose2>& poses) {
  std::string text;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const auto& [position, heading_rad] = poses[i];
    if (!number<std::int64_t>(graph.nodes[i].name)) {
      return bad_input(
          fmt::format("g2o names nodes by whole numbers, not '{}'", excerpt(graph.nodes[i].name)));
    }
    text += graph.nodes[i].is_point
                ? fmt::format("VERTEX_XY {} {} {}\n", graph.nodes[i].name, position.x, position.y)
                : fmt::format("VERTEX_SE2 {} {} {} {}\n", graph.nodes[i].name, position.x, position.y,
                              heading_rad);
  }
  for (const GraphEdge& edge : graph.edges) {
    if (edge.kind == EdgeKind::range) return bad_input("g2o has no ranges; leave them out");
    const bool point = edge.kind == EdgeKind::point;
    text += fmt::format("{} {} {} {} {}", point ? "EDGE_SE2_XY" : "EDGE_SE2", graph.nodes[edge.from].name,
                        graph.nodes[edge.to].name, edge.measured.position.x, edge.measured.position.y);
    if (!point) text += fmt::format(" {}", edge.measured.heading_rad);
    for (Eigen::Index i = 0; i < (point ? 2 : 3); ++i) {
      for (Eigen::Index j = i; j < (point ? 2 : 3); ++j) text += fmt::format(" {}", edge.information(i, j));
    }
    text += '\n';
  }
  return text;
}

}  // namespace outrider
