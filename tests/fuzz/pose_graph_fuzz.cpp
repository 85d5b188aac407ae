// Pose graphs: what loads can be optimised, and is written and read back the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "fuzz_entry.hpp"
#include "outrider/io/log/g2o.hpp"
#include "outrider/io/log/pyfg.hpp"
#include "outrider/slam/bounds/pose_graph_bound.hpp"

namespace {

/// Aborts if the cost rises, if the bound is above it, or if what is written does not read back.
template <class Pose, class Read>
void solve(const outrider::PoseGraphOf<Pose>& graph, const char* robust, Read read) {
  outrider::PoseGraphOptions options;
  options.iterations = 3;
  options.robust = robust;
  const auto solution = outrider::optimise(graph, options, {});
  if (!solution) return;
  if (solution->refused.empty() && !(solution->robust_cost <= solution->start_cost)) std::abort();
  const auto bound = outrider::least_cost_bound(graph, solution->poses);
  if (bound && !(*bound <= outrider::cost(graph, solution->poses) * (1.0 + 1e-6) + 1e-6)) std::abort();
  const auto text = outrider::to_g2o(graph, solution->poses);
  if (text && !read(*text)) std::abort();
}

}  // namespace

extern "C" int FUZZ_ENTRY(pose_graph)(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto pyfg = outrider::pose_graph_from_pyfg(input, "graph.pyfg");
  if (pyfg && pyfg->truth.size() != pyfg->graph.nodes.size()) std::abort();
  const char* robust = size % 2 == 0 ? "none" : "gnc";
  if (const auto graph = outrider::pose_graph_from_g2o(input, "graph.g2o")) {
    solve(*graph, robust, [](const std::string& text) {
      return outrider::pose_graph_from_g2o(text, "again.g2o").has_value();
    });
  }
  if (const auto graph = outrider::pose_graph3_from_g2o(input, "graph.g2o")) {
    solve(*graph, robust, [](const std::string& text) {
      return outrider::pose_graph3_from_g2o(text, "again.g2o").has_value();
    });
  }
  return 0;
}
