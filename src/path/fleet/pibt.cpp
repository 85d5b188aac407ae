#include "pibt.hpp"

#include <algorithm>

namespace outrider::fleet {

Pibt::Pibt(const Query& query)
    : query_(query),
      here_(query.ground.marks.size(), unreachable),
      there_(query.ground.marks.size(), unreachable) {}

void Pibt::begin(const std::vector<State>& now) {
  for (const State s : now_) here_[s] = unreachable;
  for (const State s : next_) {
    if (s != unreachable) there_[s] = unreachable;
  }
  now_ = now;
  next_.assign(now.size(), unreachable);
  for (std::size_t i = 0; i < now.size(); ++i) here_[now[i]] = static_cast<std::uint32_t>(i);
}

/// Returns true if the robot would collide there with one that has moved.
bool Pibt::taken(std::size_t robot, State to) const {
  if (there_[to] != unreachable) return true;
  const std::uint32_t other = here_[to];
  return other != unreachable && other != robot && next_[other] == now_[robot];
}

void Pibt::take(std::size_t robot, State to) {
  next_[robot] = to;
  there_[to] = static_cast<std::uint32_t>(robot);
}

bool Pibt::fix(std::size_t robot, State to) {
  if (taken(robot, to)) return false;
  take(robot, to);
  return true;
}

bool Pibt::move(std::size_t robot) {
  if (next_[robot] != unreachable) return true;
  const State from = now_[robot];
  std::array<State, 5> choices{};
  std::size_t count = 0;
  query_.for_each_step(from, [&](State to) { choices[count++] = to; });
  State* const end = choices.data() + count;
  std::stable_sort(choices.data(), end, [&](State a, State b) {
    const std::uint32_t to_a = query_.steps[robot][a], to_b = query_.steps[robot][b];
    if (to_a != to_b) return to_a < to_b;
    return (here_[a] == unreachable) && (here_[b] != unreachable);
  });
  for (const State* to = choices.data(); to != end; ++to) {
    if (taken(robot, *to)) continue;
    take(robot, *to);
    const std::uint32_t other = here_[*to];
    if (other == unreachable || other == robot || next_[other] != unreachable || move(other)) return true;
  }
  take(robot, from);  // back from the robot that pushed it there
  return false;
}

}  // namespace outrider::fleet
