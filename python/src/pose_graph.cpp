// Pose graphs of the plane and of space.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bindings.hpp"
#include "faults.hpp"
#include "interruptible.hpp"
#include "options.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/log/g2o.hpp"
#include "outrider/slam/bounds/pose_graph_bound.hpp"

namespace outrider::python {

namespace py = pybind11;

namespace {

// Poses as numbers: x, y, heading in the plane; a matrix of 4 x 4 in space.
void append(std::vector<double>& numbers, const Pose2& pose) {
  numbers.insert(numbers.end(), {pose.position.x, pose.position.y, pose.heading_rad});
}
void append(std::vector<double>& numbers, const Pose3& pose) {
  const auto& [x, y, z] = pose.rotation.axes;
  const Vec3 p = pose.position;
  numbers.insert(numbers.end(),
                 {x.x, y.x, z.x, p.x, x.y, y.y, z.y, p.y, x.z, y.z, z.z, p.z, 0.0, 0.0, 0.0, 1.0});
}
template <class Pose>
std::vector<py::ssize_t> shape_of(py::ssize_t count) {
  if constexpr (freedoms<Pose> == 3) return {count, 3};
  return {count, 4, 4};
}
Pose2 pose_from(const double* n, const Pose2&) { return {{n[0], n[1]}, n[2]}; }
Pose3 pose_from(const double* n, const Pose3&) {
  return {{n[3], n[7], n[11]}, {{Vec3{n[0], n[4], n[8]}, Vec3{n[1], n[5], n[9]}, Vec3{n[2], n[6], n[10]}}}};
}

/// Refuses a matrix that is no rotation.
void check_rotation(const Pose2&, const char*) {}
void check_rotation(const Pose3& pose, const char* name) {
  const auto& [x, y, z] = pose.rotation.axes;
  const Vec3 off = cross(x, y) + -1.0 * z;
  if (norm(off) < 1e-6 && std::abs(dot(x, y)) < 1e-6 && std::abs(norm(x) - 1.0) < 1e-6) return;
  refuse("its upper left part is no rotation; give orthonormal columns", name);
}

template <class Pose>
std::vector<Pose> poses_from(const py::handle& value, const char* name) {
  const std::vector<double> numbers = numbers_of_shape(value, shape_of<Pose>(-1), name);
  constexpr std::size_t each = freedoms<Pose> == 3 ? 3 : 16;
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < numbers.size(); i += each) {
    poses.push_back(pose_from(numbers.data() + i, Pose{}));
    check_rotation(poses.back(), name);
  }
  return poses;
}

template <class Pose>
Pose one_pose_from(const py::handle& value, const char* name) {
  if constexpr (freedoms<Pose> == 3) return pose_of(value, name);
  const Pose pose = pose_from(numbers_of_shape(value, {4, 4}, name).data(), Pose{});
  check_rotation(pose, name);
  return pose;
}

template <class Pose>
py::array_t<double> array_from(const std::vector<Pose>& poses) {
  std::vector<double> numbers;
  for (const Pose& pose : poses) append(numbers, pose);
  return array_of_shape(shape_of<Pose>(static_cast<py::ssize_t>(poses.size())), numbers.data());
}

template <class Pose>
std::uint32_t add_pose(PoseGraphOf<Pose>& graph, const py::handle& pose) {
  graph.nodes.push_back({std::to_string(graph.nodes.size()), one_pose_from<Pose>(pose, "pose"), false});
  return static_cast<std::uint32_t>(graph.nodes.size() - 1);
}

template <class Pose>
void add_edge(PoseGraphOf<Pose>& graph, std::uint32_t from, std::uint32_t to, const py::handle& measured,
              const py::handle& information) {
  constexpr int n = freedoms<Pose>;
  GraphEdgeOf<Pose> edge{EdgeKind::pose, from, to, one_pose_from<Pose>(measured, "measured")};
  const std::vector<double> numbers = numbers_of_shape(information, {n, n}, "information");
  for (int i = 0; i < n * n; ++i) edge.information(i / n, i % n) = numbers[static_cast<std::size_t>(i)];
  graph.edges.push_back(edge);
}

/// Checks what the functions of the library take for granted.
template <class Pose>
std::vector<Pose> checked_poses(const PoseGraphOf<Pose>& graph, const py::handle& value) {
  require(check(graph));
  std::vector<Pose> poses = poses_from<Pose>(value, "poses");
  if (poses.size() == graph.nodes.size()) return poses;
  refuse(fmt::format("{} poses for {} nodes; give one for each", poses.size(), graph.nodes.size()), "poses");
}

template <class Pose>
PoseGraphSolutionOf<Pose> solve(const PoseGraphOf<Pose>& graph, std::optional<std::uint64_t> most_iterations,
                                const py::kwargs& values) {
  PoseGraphOptions options;
  set_options(describe(options), values);
  return value_of(interruptible([&](const std::stop_token& stop) {
    return optimise(graph, options, budget_of(most_iterations, stop));
  }));
}

template <class Pose>
py::array_t<double> covariances(const PoseGraphOf<Pose>& graph, const py::handle& value) {
  constexpr int n = freedoms<Pose>;
  const auto matrices = value_of(marginal_covariances(graph, checked_poses(graph, value)));
  py::array_t<double> result({static_cast<py::ssize_t>(matrices.size()), py::ssize_t{n}, py::ssize_t{n}});
  double* at = result.mutable_data();
  for (const auto& matrix : matrices) {
    for (int i = 0; i < n * n; ++i) *at++ = matrix(i / n, i % n);
  }
  return result;
}

template <class Pose>
PoseGraphOf<Pose> read(const py::handle& path) {
  const std::string name = path_text(path);
  const std::string text = value_of(read_file(name));
  if constexpr (freedoms<Pose> == 3)
    return value_of(pose_graph_from_g2o(text, name));
  else
    return value_of(pose_graph3_from_g2o(text, name));
}

template <class Pose>
void bind_graph(py::module_& module, const char* name, const char* solution_name) {
  using Graph = PoseGraphOf<Pose>;
  using Solution = PoseGraphSolutionOf<Pose>;
  py::class_<Solution>(module, solution_name)
      .def_property_readonly("poses", [](const Solution& solution) { return array_from(solution.poses); })
      .def_readonly("cost", &Solution::cost)
      .def_readonly("start_cost", &Solution::start_cost)
      .def_property_readonly(
          "status",
          [](const Solution& solution) { return solution.converged ? "converged" : "not_converged"; })
      .def_readonly("start", &Solution::start)
      .def_readonly("iterations", &Solution::iterations)
      .def_readonly("refused", &Solution::refused);
  PoseGraphOptions options;
  const std::string help = options_text(describe(options));
  py::class_<Graph>(module, name)
      .def(py::init<>())
      .def_static("load", &read<Pose>, py::arg("path"))
      .def("add_pose", &add_pose<Pose>, py::arg("pose"))
      .def("add_edge", &add_edge<Pose>, py::arg("from_pose"), py::arg("to_pose"), py::arg("measured"),
           py::arg("information"))
      .def_property_readonly("poses",
                             [](const Graph& graph) {
                               std::vector<Pose> poses;
                               for (const auto& node : graph.nodes) poses.push_back(node.pose);
                               return array_from(poses);
                             })
      .def_property_readonly(
          "edges",
          [](const Graph& graph) {
            py::array_t<std::int64_t> ends({static_cast<py::ssize_t>(graph.edges.size()), py::ssize_t{2}});
            std::int64_t* at = ends.mutable_data();
            for (const auto& edge : graph.edges) {
              *at++ = edge.from;
              *at++ = edge.to;
            }
            return ends;
          })
      .def_property_readonly("degrees_of_freedom", &degrees_of_freedom<Pose>)
      .def(
          "cost",
          [](const Graph& graph, const py::handle& poses) {
            return cost(graph, checked_poses(graph, poses));
          },
          py::arg("poses"))
      .def("optimise", &solve<Pose>, py::kw_only(), py::arg("most_iterations") = py::none(), help.c_str())
      .def(
          "lower_bound",
          [](const Graph& graph, const py::handle& poses) {
            return value_of(least_cost_bound(graph, checked_poses(graph, poses)));
          },
          py::arg("poses"))
      .def("covariances", &covariances<Pose>, py::arg("poses"))
      .def(
          "g2o",
          [](const Graph& graph, const py::handle& poses) {
            return value_of(to_g2o(graph, checked_poses(graph, poses)));
          },
          py::arg("poses"));
}

}  // namespace

void bind_pose_graph(py::module_& module) {
  bind_graph<Pose2>(module, "PoseGraph", "PoseGraphSolution");
  bind_graph<Pose3>(module, "PoseGraph3", "PoseGraphSolution3");
}

}  // namespace outrider::python
