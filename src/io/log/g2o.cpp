#include "outrider/io/log/g2o.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "log/graph_lines.hpp"

namespace outrider {
namespace {

constexpr std::array<GraphForm, 7> planar_forms = {{
    {"VERTEX_SE2", 1, 3, "VERTEX_SE2 id x y heading"},
    {"VERTEX_XY", 1, 2, "VERTEX_XY id x y"},
    {"EDGE_SE2", 2, 9, "EDGE_SE2 from to x y heading and 6 numbers of the information's upper triangle"},
    {"EDGE_SE2_XY", 2, 5, "EDGE_SE2_XY from to x y and 3 numbers of the information's upper triangle"},
    {"FIX", 1, 0, "FIX id"},
    {"VERTEX2", 1, 3, "VERTEX2 id x y heading"},
    {"EDGE2", 2, 9, "EDGE2 from to x y heading and the information as xx xy yy hh xh yh"},
}};
constexpr std::array<GraphForm, 3> spatial_forms = {{
    {"VERTEX_SE3:QUAT", 1, 7, "VERTEX_SE3:QUAT id x y z and a quaternion qx qy qz qw"},
    {"EDGE_SE3:QUAT", 2, 28,
     "EDGE_SE3:QUAT from to x y z qx qy qz qw and 21 numbers of the information's upper triangle"},
    {"FIX", 1, 0, "FIX id"},
}};

Status check_name(std::string_view name) {
  if (number<std::int64_t>(name)) return {};
  return bad_input(fmt::format("g2o names nodes by whole numbers, not '{}'", excerpt(name)));
}

template <class Pose>
Status fix(const GraphLine& line, const GraphLines<Pose>& lines) {
  const bool first = !lines.graph.nodes.empty() && lines.graph.nodes.front().name == line.names[0];
  return first ? Status{} : bad_input("only the first vertex can be fixed; take the line out");
}

Status add_line(const GraphLine& line, GraphLines<Pose2>& lines) {
  const auto& v = line.numbers;
  const std::span<const double> numbers(v);
  if (line.tag == "FIX") return fix(line, lines);
  const Pose2 pose = {{v[0], v[1]}, line.tag == "VERTEX_XY" || line.tag == "EDGE_SE2_XY" ? 0.0 : v[2]};
  if (line.tag.starts_with("VERTEX")) return lines.place(line.names[0], pose, line.tag == "VERTEX_XY");
  if (line.tag == "EDGE_SE2_XY") {
    return lines.join(EdgeKind::point, line.names[0], line.names[1], pose, numbers.subspan(2));
  }
  const std::array<double, 6> toro = {v[3], v[4], v[7], v[5], v[8], v[6]};
  const auto triangle = line.tag == "EDGE2" ? std::span<const double>(toro) : numbers.subspan(3);
  return lines.join(EdgeKind::pose, line.names[0], line.names[1], pose, triangle);
}

/// Returns the pose of seven numbers; a fault if the quaternion is not of length 1, to the digits of a file.
Outcome<Pose3> pose3_of(std::span<const double> v) {
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (std::abs(q.norm() - 1.0) > 1e-3) {
    return bad_input(fmt::format("its quaternion has length {:.6g}; expected 1", q.norm()));
  }
  const Eigen::Matrix3d r = q.normalized().toRotationMatrix();
  Pose3 pose{{v[0], v[1], v[2]}, {}};
  for (Eigen::Index k = 0; k < 3; ++k) {
    pose.rotation.axes[static_cast<std::size_t>(k)] = {r(0, k), r(1, k), r(2, k)};
  }
  return pose;
}

Status add_line(const GraphLine& line, GraphLines<Pose3>& lines) {
  if (line.tag == "FIX") return fix(line, lines);
  const std::span<const double> numbers(line.numbers);
  auto pose = pose3_of(numbers);
  if (!pose) return pass_on(pose);
  if (line.tag == "VERTEX_SE3:QUAT") return lines.place(line.names[0], *pose, false);
  return lines.join(EdgeKind::pose, line.names[0], line.names[1], *pose, numbers.subspan(7));
}

template <class Pose>
Outcome<PoseGraphOf<Pose>> read_graph(std::string_view text, const std::string& name, InformationTerms terms,
                                      std::span<const GraphForm> forms, std::string_view ground) {
  GraphLines<Pose> lines;
  lines.terms = terms;
  auto read = read_graph_lines(text, name, forms, ground, [&](const GraphLine& line) -> Status {
    for (const std::string_view node : line.names) {
      if (auto ok = check_name(node); !ok) return ok;
    }
    return add_line(line, lines);
  });
  if (!read) return pass_on(read);
  auto graph = std::move(lines).finish();
  if (!graph) return bad_input(graph.error().sentence, name);
  return graph;
}

/// Returns " a b .." with the upper triangle of the first rows.
std::string triangle_text(const Eigen::Ref<const Eigen::MatrixXd>& information, Eigen::Index rows) {
  std::string text;
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = i; j < rows; ++j) text += fmt::format(" {}", information(i, j));
  }
  return text;
}

std::string pose_text(const Pose3& pose) {
  Eigen::Matrix3d r;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vec3& axis = pose.rotation.axes[static_cast<std::size_t>(k)];
    r.col(k) << axis.x, axis.y, axis.z;
  }
  const Eigen::Quaterniond q = Eigen::Quaterniond(r).normalized();
  return fmt::format("{} {} {} {} {} {} {}", pose.position.x, pose.position.y, pose.position.z, q.x(), q.y(),
                     q.z(), q.w());
}

}  // namespace

Outcome<PoseGraph> pose_graph_from_g2o(std::string_view text, const std::string& name,
                                       InformationTerms terms) {
  return read_graph<Pose2>(text, name, terms, planar_forms, "the plane");
}

Outcome<PoseGraph3> pose_graph3_from_g2o(std::string_view text, const std::string& name,
                                         InformationTerms terms) {
  return read_graph<Pose3>(text, name, terms, spatial_forms, "space");
}

bool is_spatial_g2o(std::string_view text) {
  TextLines lines{text, {}};
  return lines.next_filled() && words(lines.line)[0].find("_SE3:") != std::string_view::npos;
}

Outcome<std::string> to_g2o(const PoseGraph& graph, const std::vector<Pose2>& poses) {
  std::string text;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (auto ok = check_name(graph.nodes[i].name); !ok) return pass_on(ok);
    const auto& [position, heading_rad] = poses[i];
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
    text += triangle_text(edge.information, point ? 2 : 3) + '\n';
  }
  return text;
}

Outcome<std::string> to_g2o(const PoseGraph3& graph, const std::vector<Pose3>& poses) {
  std::string text;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (auto ok = check_name(graph.nodes[i].name); !ok) return pass_on(ok);
    text += fmt::format("VERTEX_SE3:QUAT {} {}\n", graph.nodes[i].name, pose_text(poses[i]));
  }
  for (const GraphEdge3& edge : graph.edges) {
    if (edge.kind != EdgeKind::pose)
      return bad_input("g2o in space has only edges between poses; leave the rest out");
    text += fmt::format("EDGE_SE3:QUAT {} {} {}{}\n", graph.nodes[edge.from].name, graph.nodes[edge.to].name,
                        pose_text(edge.measured), triangle_text(edge.information, 6));
  }
  return text;
}

}  // namespace outrider
