#include "graph_lines.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace outrider {
namespace {

Eigen::Index rows_of(std::span<const double> triangle) {
  return triangle.size() == 6 ? 3 : triangle.size() == 3 ? 2 : 1;
}

/// Returns the symmetric matrix; rows that the edge does not measure are 0.
Eigen::Matrix3d from_upper(std::span<const double> triangle) {
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  const Eigen::Index n = rows_of(triangle);
  std::size_t next = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i; j < n; ++j) result(i, j) = result(j, i) = triangle[next++];
  }
  return result;
}

/// Inverts the upper left n x n block; all else is 0. Returns nothing if the block is not positive definite.
std::optional<Eigen::Matrix3d> inverse_of_part(Eigen::Matrix3d a, Eigen::Index n) {
  a.diagonal().tail(3 - n).setOnes();
  const Eigen::LLT<Eigen::Matrix3d> factor(a);
  Eigen::Matrix3d inverse = factor.solve(Eigen::Matrix3d::Identity());
  if (factor.info() != Eigen::Success || !inverse.allFinite()) return std::nullopt;
  inverse.diagonal().tail(3 - n).setZero();
  return inverse;
}

bool is_near(const Pose2& pose) {
  return std::abs(pose.position.x) <= 1e9 && std::abs(pose.position.y) <= 1e9 &&
         std::abs(pose.heading_rad) <= 1e9;
}

}  // namespace

Outcome<std::uint32_t> GraphLines::node(std::string_view name, bool is_point) {
  const auto found = numbers_.find(name);
  if (found != numbers_.end()) {
    if (graph.nodes[found->second].is_point == is_point) return found->second;
    return bad_input(fmt::format("{} is a {} elsewhere in the file; give them different names", excerpt(name),
                                 is_point ? "pose" : "point"));
  }
  const auto number = static_cast<std::uint32_t>(graph.nodes.size());
  numbers_.emplace(std::string(name), number);
  graph.nodes.push_back({std::string(name), {}, is_point});
  placed.push_back(false);
  return number;
}

Status GraphLines::place(std::string_view name, const Pose2& pose, bool is_point) {
  if (!is_near(pose)) return bad_input(fmt::format("{} stands beyond 1e9 m; correct it", excerpt(name)));
  auto number = node(name, is_point);
  if (!number) return pass_on(number);
  if (placed[*number]) return bad_input(fmt::format("{} is placed twice; keep one line", excerpt(name)));
  graph.nodes[*number].pose = pose;
  placed[*number] = true;
  return {};
}

Status GraphLines::join(EdgeKind kind, std::string_view from, std::string_view to, const Pose2& measured,
                        std::span<const double> triangle, bool covariance) {
  if (from == to) return bad_input(fmt::format("it joins {} to itself; take it out", excerpt(from)));
  if (!is_near(measured)) return bad_input("it measures more than 1e9 m; correct it");
  const bool range = kind == EdgeKind::range;
  const auto known_point = [&](std::string_view name) {
    const auto found = numbers_.find(name);
    return found != numbers_.end() && graph.nodes[found->second].is_point;
  };
  auto a = node(from, range && known_point(from));
  if (!a) return pass_on(a);
  auto b = node(to, range ? known_point(to) : kind == EdgeKind::point);
  if (!b) return pass_on(b);
  Eigen::Matrix3d information = from_upper(triangle);
  const Eigen::Index n = rows_of(triangle);
  const auto inverse = inverse_of_part(information, n);
  if (!inverse || (covariance && !inverse_of_part(*inverse, n))) {
    return bad_input(fmt::format("its {} is not positive definite; correct it",
                                 covariance ? "covariance" : "information"));
  }
  if (covariance) information = *inverse;
  graph.edges.push_back({kind, *a, *b, measured, information});
  return {};
}

Outcome<PoseGraph> GraphLines::finish() && {
  if (auto ok = place_from_edges(graph, placed); !ok) return pass_on(ok);
  if (auto ok = check(graph); !ok) return pass_on(ok);
  return std::move(graph);
}

std::optional<std::vector<double>> numbers_of(std::span<const std::string_view> words) {
  std::vector<double> result;
  for (const std::string_view word : words) {
    const auto value = number<double>(word);
    if (!value || std::abs(*value) > 1e18) return std::nullopt;
    result.push_back(*value);
  }
  return result;
}

Status read_graph_lines(std::string_view text, const std::string& name,
                        const std::function<Status(std::string_view)>& read) {
  constexpr std::size_t most_lines = 2'000'000;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = take_line(text);
    line = line.substr(0, line.find('#'));
    if (number > most_lines) {
      return bad_input(fmt::format("more than {} lines; take a smaller graph", most_lines),
                       fmt::format("{}:{}", name, number));
    }
    if (line.find_first_not_of(white_space) == std::string_view::npos) continue;
    if (auto ok = read(line); !ok) return bad_input(ok.error().sentence, fmt::format("{}:{}", name, number));
  }
  return {};
}

}  // namespace outrider
