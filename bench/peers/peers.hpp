// Rows of bench_peers: planners and solvers of Outrider beside libraries that Debian has, on the same
// problems in the same run.
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace outrider::bench {

enum class Whose { ours, exact_peer, sampling_peer };

/// The answers of a solver to the problems of a task.
struct PeerRow {
  std::string task;
  std::string solver;
  Whose whose = Whose::ours;
  std::vector<double> times_us = {};  ///< the shortest of the rounds, by problem
  std::vector<double> costs = {};     ///< infinite without an answer
};

/// Calls solve(i), which returns the cost of its answer, for all problems in turn, several rounds.
inline PeerRow measure(const std::string& task, const std::string& solver, Whose whose, std::size_t problems,
                       int rounds, const std::function<double(std::size_t)>& solve) {
  constexpr double never = std::numeric_limits<double>::infinity();
  PeerRow row{task, solver, whose, std::vector<double>(problems, never),
              std::vector<double>(problems, never)};
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < problems; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      row.costs[i] = solve(i);
      const std::chrono::duration<double, std::micro> taken = std::chrono::steady_clock::now() - begin;
      row.times_us[i] = std::min(row.times_us[i], taken.count());
    }
  }
  return row;
}

/// Shortest paths along the eight moves of grids; Boost.Graph and LEMON search the graph of the moves.
std::vector<PeerRow> grid_rows();

/// Shortest paths of a disk among polygons; the sampling planners are those of OMPL. Empty without OMPL.
std::vector<PeerRow> polygon_rows();

/// Tours that serve each goal from one of several stops; CBC solves them as integer programmes. Empty without
/// CBC.
std::vector<PeerRow> tour_rows();

}  // namespace outrider::bench
