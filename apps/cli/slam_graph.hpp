// `outrider slam` on a pose graph.
#pragma once

#include "slam_input.hpp"
#include "slam_job.hpp"

namespace outrider::cli {

/// Solves it, says how well, and writes what --out asks for; the exit status.
int solve_graph(const SlamJob& job, GraphInput input);

}  // namespace outrider::cli
