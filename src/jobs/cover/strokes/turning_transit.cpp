#include "strokes/turning_transit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "outrider/motion/turning_path.hpp"

namespace outrider::cover {
namespace {

constexpr double least_piece_m = 1e-6;   // shorter ones have no heading to speak of
constexpr std::size_t most_words = 12;   // tried between two poses
constexpr std::size_t most_near = 96;    // nodes looked at from each
constexpr std::size_t most_joined = 24;  // of them, that edges lead to
constexpr double same_heading_rad = 1e-9;

/// The path as pieces that end exactly at the goal; nothing if one is too short.
std::optional<std::vector<PathPiece>> pieces_of(const TurningPath& path, const Pose2& from, const Pose2& to,
                                                double radius_m) {
  std::vector<PathPiece> pieces;
  Pose2 pose = from;
  for (std::size_t i = 0; i < path.count; ++i) {
    const TurningPiece& part = path.pieces[i];
    if (std::abs(part.length_m) < least_piece_m) return std::nullopt;
    const Pose2 end = after(pose, part, radius_m);
    PathPiece piece{pose.position, end.position, {}, 0.0, part.length_m < 0.0};
    if (part.side != 0) {
      piece.centre = pose.position + part.side * radius_m * perpendicular(direction(pose.heading_rad));
      piece.turn_rad = part.side * part.length_m / radius_m;
    }
    pieces.push_back(piece);
    pose = end;
  }
  if (!pieces.empty()) pieces.back().to = to.position;
  return pieces;
}

bool same(const Pose2& a, const Pose2& b) {
  return distance(a.position, b.position) <= contact_m &&
         std::abs(wrap_angle(a.heading_rad - b.heading_rad)) <= same_heading_rad;
}

std::vector<TurningPath> turning_paths(const Pose2& from, const Pose2& to, const CoverProblem& problem) {
  const double radius = problem.turning_radius_m;
  return problem.reverse ? reeds_shepp_paths(from, to, radius) : dubins_paths(from, to, radius);
}

/// A node and the paths to it, the shortest first.
struct Reached {
  std::size_t node = 0;
  std::vector<TurningPath> paths;

  [[nodiscard]] double length_m() const {
    return paths.empty() ? std::numeric_limits<double>::infinity() : paths.front().length_m;
  }
};

/// Returns the first of the paths that is free.
std::optional<std::vector<PathPiece>> first_free(const std::vector<TurningPath>& paths, const Pose2& from,
                                                 const Pose2& to, double radius_m, const FreeRoom& room) {
  if (same(from, to)) return std::vector<PathPiece>{};
  for (std::size_t i = 0; i < std::min(paths.size(), most_words); ++i) {
    auto pieces = pieces_of(paths[i], from, to, radius_m);
    if (pieces && room.free(*pieces)) return pieces;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<PathPiece>> free_turning_path(const Pose2& from, const Pose2& to,
                                                        const CoverProblem& problem, const FreeRoom& room) {
  return first_free(turning_paths(from, to, problem), from, to, problem.turning_radius_m, room);
}

std::size_t TurningTransit::add(const Pose2& pose) {
  poses_.push_back(pose);
  edges_.emplace_back();
  return poses_.size() - 1;
}

void TurningTransit::join(std::size_t from, std::size_t to, std::vector<PathPiece> pieces) {
  const double time_s = sums_of(poses_[from].heading_rad, pieces, problem_.pace).time_s;
  edges_[from].push_back({static_cast<std::uint32_t>(to), time_s, std::move(pieces)});
}

void TurningTransit::connect(std::span<const std::size_t> from, std::span<const std::size_t> to,
                             const std::stop_token& stop) {
  for (const std::size_t i : from) {
    if (stop.stop_requested()) return;
    std::vector<std::pair<double, std::size_t>> near;
    for (const std::size_t j : to) {
      if (j != i) near.emplace_back(distance(poses_[i].position, poses_[j].position), j);
    }
    const auto kept = static_cast<std::ptrdiff_t>(std::min(near.size(), most_near));
    std::partial_sort(near.begin(), near.begin() + kept, near.end());
    near.resize(static_cast<std::size_t>(kept));
    std::vector<Reached> reached;
    for (const auto& [away_m, j] : near)
      reached.push_back({j, turning_paths(poses_[i], poses_[j], problem_)});
    std::ranges::sort(reached, {}, [](const Reached& one) { return std::pair(one.length_m(), one.node); });
    std::size_t joined = 0;
    for (const auto& [j, paths] : reached) {
      auto pieces = first_free(paths, poses_[i], poses_[j], problem_.turning_radius_m, room_);
      if (!pieces) continue;
      join(i, j, std::move(*pieces));
      if (++joined == most_joined) break;
    }
  }
}

TurningTransit::Ways TurningTransit::search(std::size_t node, const Edges& edges) const {
  Ways ways{std::vector<double>(size(), std::numeric_limits<double>::infinity()),
            std::vector<std::uint32_t>(size(), static_cast<std::uint32_t>(node))};
  using Label = std::pair<double, std::uint32_t>;
  std::priority_queue<Label, std::vector<Label>, std::greater<>> open;
  ways.times_s[node] = 0.0;
  open.push({0.0, static_cast<std::uint32_t>(node)});
  while (!open.empty()) {
    const auto [time_s, at] = open.top();
    open.pop();
    if (time_s > ways.times_s[at]) continue;
    for (const Edge& edge : edges[at]) {
      const double then_s = time_s + edge.time_s;
      if (then_s >= ways.times_s[edge.to]) continue;
      ways.times_s[edge.to] = then_s;
      ways.before[edge.to] = at;
      open.push({then_s, edge.to});
    }
  }
  return ways;
}

TurningTransit::Ways TurningTransit::ways_to(std::size_t node) const {
  Edges back(size());
  for (std::size_t i = 0; i < size(); ++i) {
    for (const Edge& edge : edges_[i])
      back[edge.to].push_back({static_cast<std::uint32_t>(i), edge.time_s, {}});
  }
  return search(node, back);
}

std::vector<PathPiece> TurningTransit::pieces(const Ways& ways, std::size_t from, std::size_t to) const {
  std::vector<std::size_t> nodes{to};
  while (nodes.back() != from) nodes.push_back(ways.before[nodes.back()]);
  std::vector<PathPiece> all;
  for (std::size_t k = nodes.size() - 1; k > 0; --k) {
    const Edge* best = nullptr;
    for (const Edge& edge : edges_[nodes[k]]) {
      if (edge.to == nodes[k - 1] && (best == nullptr || edge.time_s < best->time_s)) best = &edge;
    }
    all.insert(all.end(), best->pieces.begin(), best->pieces.end());
  }
  return all;
}

}  // namespace outrider::cover
