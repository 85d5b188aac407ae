// The graph of the mixed-integer programme: what stands at its vertices and what its arcs take.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/tour/supply/supply.hpp"

namespace outrider::tour {

struct SupplyVertex {
  std::size_t stop = 0;
  double heading = 0.0;
  std::optional<std::uint32_t> goal;
  std::optional<std::size_t> station;
  std::size_t copy = 0;
  double yaw = 0.0;  // of the gun, relative to the body, when it is done
  double pitch = 0.0;
  double duration = 0.0;
  double home = 0.0;  // charge to the nearest charger
};

struct SupplyArc {
  std::size_t from = 0;
  std::size_t to = 0;  // the number of vertices stands for the end of the tour
  double time = 0.0;
  double charge = 0.0;
};

struct SupplyGraph {
  std::vector<SupplyVertex> vertices;  // the start first
  std::vector<SupplyArc> arcs;
};

/// The problem has passed check().
SupplyGraph supply_graph(const SupplyProblem& problem);

}  // namespace outrider::tour
