#include "log/graph_lines.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace outrider {
namespace {

/// Returns the symmetric matrix; rows that the edge does not measure are 0.
template <class Pose>
PoseMatrix<Pose> from_upper(std::span<const double> triangle, Eigen::Index rows) {
  PoseMatrix<Pose> result = PoseMatrix<Pose>::Zero();
  std::size_t next = 0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = i; j < rows; ++j) result(i, j) = result(j, i) = triangle[next++];
  }
  return result;
}

/// Returns the information with these terms only.
template <class Pose>
PoseMatrix<Pose> reduced(const PoseMatrix<Pose>& information, Eigen::Index rows, InformationTerms terms) {
  if (terms == InformationTerms::all) return information;
  PoseMatrix<Pose> result = PoseMatrix<Pose>(information.diagonal().asDiagonal());
  if (terms == InformationTerms::diagonal || rows == 1) return result;
  for (Eigen::Index first = 0; first < rows; first += dimension<Pose>) {
    const Eigen::Index size = first == 0 ? dimension<Pose> : rows - first;
    const Eigen::MatrixXd part = information.block(first, first, size, size);
    result.diagonal().segment(first, size).setConstant(static_cast<double>(size) / part.inverse().trace());
  }
  return result;
}

/// Inverts the upper left part with so many rows; all else is 0. Returns nothing if the part is not positive
/// definite.
template <class Pose>
std::optional<PoseMatrix<Pose>> inverse_of_part(PoseMatrix<Pose> a, Eigen::Index rows) {
  constexpr int N = freedoms<Pose>;
  a.diagonal().tail(N - rows).setOnes();
  const Eigen::LLT<PoseMatrix<Pose>> factor(a);
  PoseMatrix<Pose> inverse = factor.solve(PoseMatrix<Pose>::Identity());
  if (factor.info() != Eigen::Success || !inverse.allFinite()) return std::nullopt;
  inverse.diagonal().tail(N - rows).setZero();
  return inverse;
}

bool is_near(double x, double y, double z) {
  return std::abs(x) <= 1e9 && std::abs(y) <= 1e9 && std::abs(z) <= 1e9;
}
bool is_near(const Pose2& pose) { return is_near(pose.position.x, pose.position.y, pose.heading_rad); }
bool is_near(const Pose3& pose) { return is_near(pose.position.x, pose.position.y, pose.position.z); }

Eigen::Index rows_of(EdgeKind kind, int dimension, int freedoms) {
  return kind == EdgeKind::pose ? freedoms : kind == EdgeKind::point ? dimension : 1;
}

}  // namespace

template <class Pose>
Outcome<std::uint32_t> GraphLines<Pose>::node(std::string_view name, bool is_point) {
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

template <class Pose>
Status GraphLines<Pose>::place(std::string_view name, const Pose& pose, bool is_point) {
  if (!is_near(pose)) return bad_input(fmt::format("{} stands beyond 1e9 m; correct it", excerpt(name)));
  auto number = node(name, is_point);
  if (!number) return pass_on(number);
  if (placed[*number]) return bad_input(fmt::format("{} is placed twice; keep one line", excerpt(name)));
  graph.nodes[*number].pose = pose;
  placed[*number] = true;
  return {};
}

template <class Pose>
Status GraphLines<Pose>::join(EdgeKind kind, std::string_view from, std::string_view to, const Pose& measured,
                              std::span<const double> triangle) {
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
  const Eigen::Index rows = rows_of(kind, dimension<Pose>, freedoms<Pose>);
  PoseMatrix<Pose> information = from_upper<Pose>(triangle, rows);
  if (!covariances) information = reduced<Pose>(information, rows, terms);
  const auto inverse = inverse_of_part<Pose>(information, rows);
  if (!inverse || (covariances && !inverse_of_part<Pose>(*inverse, rows))) {
    return bad_input(covariances ? "its covariance is not positive definite; correct it"
                                 : "its information is not positive definite; correct it, or read only its "
                                   "diagonal");
  }
  if (covariances) information = *inverse;
  graph.edges.push_back({kind, *a, *b, measured, information});
  return {};
}

template <class Pose>
Outcome<PoseGraphOf<Pose>> GraphLines<Pose>::finish() && {
  if (auto ok = place_from_edges(graph, placed); !ok) return pass_on(ok);
  if (auto ok = check(graph); !ok) return pass_on(ok);
  return std::move(graph);
}

Status read_graph_lines(std::string_view text, const std::string& name, std::span<const GraphForm> forms,
                        std::string_view ground, const std::function<Status(const GraphLine&)>& read) {
  constexpr double largest = 1e18;
  return for_each_line({text, name}, [&](std::span<const std::string_view> words) -> Status {
    const auto form = std::ranges::find(forms, words[0], &GraphForm::tag);
    if (form == forms.end()) {
      std::vector<std::string_view> tags;
      for (const GraphForm& known : forms) tags.push_back(known.tag);
      return bad_input(fmt::format("'{}' is no line of a graph of {}; expected one of {}", excerpt(words[0]),
                                   ground, fmt::join(tags, ", ")));
    }
    const std::size_t numbers_from = form->names_from + form->names;
    auto numbers = words.size() == numbers_from + form->numbers
                       ? numbers_of(words.subspan(numbers_from), largest)
                       : std::nullopt;
    if (!numbers) {
      return bad_input(fmt::format("'{}' is not valid; expected {}",
                                   excerpt(fmt::format("{}", fmt::join(words, " "))), form->sentence));
    }
    return read({form->tag, words.subspan(form->names_from, form->names), std::move(*numbers)});
  });
}

template class GraphLines<Pose2>;
template class GraphLines<Pose3>;

}  // namespace outrider
