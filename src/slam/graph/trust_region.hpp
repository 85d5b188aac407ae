// The minimum of a pose graph by Powell's dogleg: a trust region around each iterate bounds a step between
// that of steepest descent and that of Gauss and Newton (Nocedal and Wright, Numerical Optimization, 2006,
// section 4.1; for pose graphs: Rosen, Kaess and Leonard, IEEE T-RO 30 (2014) 1091-1108). One factorisation
// serves all radii that are tried. A shortened Gauss-Newton step keeps its direction, so the soft directions
// in which a whole graph bends are not slowed down, as they would be by damping.
#pragma once

#include "graph/graph_equations.hpp"
#include "graph/graph_starts.hpp"
#include "outrider/core/budget.hpp"

namespace outrider {

/// The objective to minimise: the sum of loss(weight r^T W r) over the edges.
struct GraphObjective {
  std::string kernel = "none";
  double kernel_width = 1.0;
  std::vector<double> weights = {};  ///< by edge; empty: 1 for each
};

struct DescentLimits {
  std::int64_t iterations = 1000;  ///< of this descent in total
  /// Converged is where a full Gauss-Newton step predicts a decrease of at most this part of the cost. A cost
  /// below 1e-3 counts as 1e-3: r^T W r has no unit.
  double tolerance = 1e-9;
};

enum class DescentEnd { none, converged, stuck };  ///< stuck: no step lowers the cost, to rounding

/// The state of a descent; it can be continued.
template <class Pose>
struct Descent {
  std::vector<Pose> poses;
  double cost = 0.0;  ///< of the objective
  std::int64_t iterations = 0;
  double radius = 0.0;  ///< of the trust region; 0: none yet
  DescentEnd end = DescentEnd::none;
};

template <class Pose>
double cost(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses, const GraphObjective& objective);

/// Returns the start as the beginning of a descent.
template <class Pose>
Descent<Pose> begin_descent(const PoseGraphOf<Pose>& graph, const GraphObjective& objective,
                            std::vector<Pose> start);

/// Linearises all edges at these poses into the equations.
template <class Pose>
void linearise(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses,
               const GraphObjective& objective, GraphEquations<Pose>& equations);

/// Continues a descent until it converges, is stuck or reaches the limits; the cost never rises. An iteration
/// is one factorisation and spends one expansion; false if there is none left.
template <class Pose>
bool descend(const PoseGraphOf<Pose>& graph, const GraphObjective& objective, const DescentLimits& limits,
             GraphEquations<Pose>& equations, Descent<Pose>& descent, BudgetMeter& meter);

}  // namespace outrider
