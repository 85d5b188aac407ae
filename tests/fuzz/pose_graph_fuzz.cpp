// Pose graphs: what loads can be optimised, and is written and read back the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "outrider/io/g2o.hpp"
#include "outrider/io/pyfg.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const auto pyfg = outrider::pose_graph_from_pyfg(input, "graph.pyfg");
  if (pyfg && pyfg->truth.size() != pyfg->graph.nodes.size()) std::abort();
  const auto graph = outrider::pose_graph_from_g2o(input, "graph.g2o");
  if (!graph) return 0;
  outrider::PoseGraphOptions options;
  options.iterations = 3;
  const auto solution = outrider::optimise(*graph, options, {});
  if (!solution) return 0;
  if (!(solution->robust_cost <= solution->start_cost)) std::abort();
  const auto text = outrider::to_g2o(*graph, solution->poses);
  if (text && !outrider::pose_graph_from_g2o(*text, "again.g2o")) std::abort();
  return 0;
}
