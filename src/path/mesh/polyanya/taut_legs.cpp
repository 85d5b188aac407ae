#include "taut_legs.hpp"

namespace outrider::polyanya_search {

bool TautSweep::from_turn(const NavigationMesh& mesh, std::uint32_t turn, const Cone& cone,
                          std::size_t most) {
  seen_.clear();
  const auto& [at, around, polygons] = mesh.turns[turn];
  for (std::uint32_t i = around; i < around + polygons; ++i) look_into(mesh, at, cone, mesh.around[i], *this);
  return look_on(mesh, at, most);
}

void TautSweep::from_polygon(const NavigationMesh& mesh, Cell corner, std::uint32_t polygon) {
  seen_.clear();
  look_everywhere(mesh, corner, polygon, *this);
  look_on(mesh, corner, std::numeric_limits<std::size_t>::max());
}

bool TautSweep::look_on(const NavigationMesh& mesh, Cell at, std::size_t most) {
  for (; !views_.empty() && most > 0; --most) {
    const View view = views_.back();
    views_.pop_back();
    look_through(mesh, at, view.cone, view.polygon, view.side, *this);
  }
  const bool done = views_.empty();
  views_.clear();
  return done;
}

/// Finds the legs of a departure; returns false if that takes a look through too many sides.
bool TautLegs::add(const NavigationMesh& mesh, Departure departure, std::size_t most_sides) {
  if (!sweep_.from_turn(mesh, departure.turn(), departure.cone(departure.farthest()), most_sides))
    return false;
  const std::size_t place = words_.size() + most_tries;
  if (place >= std::numeric_limits<std::uint32_t>::max() / 2) return false;
  list_of(departure) = static_cast<std::uint32_t>(place);
  store(sweep_.seen(), departure.to_left());
  return true;
}

void TautLegs::store(std::vector<TautSweep::SeenTurn>& seen, bool to_left) {
  using Seen = TautSweep::SeenTurn;
  std::erase_if(seen, [](const Seen& turn) { return !turn.taut; });
  std::sort(seen.begin(), seen.end(), [to_left](const Seen& a, const Seen& b) {
    if (a.block != b.block) return a.block < b.block;
    const std::int64_t left = turned(a.way, b.way);
    return left != 0 ? (left < 0) == to_left : a.departure.number() < b.departure.number();
  });
  const auto same = [](const Seen& a, const Seen& b) {
    return a.block == b.block && a.departure.number() == b.departure.number();
  };
  seen.erase(std::unique(seen.begin(), seen.end(), same), seen.end());

  const std::size_t list = words_.size();
  words_.push_back(0);
  for (std::uint32_t i = 0; i < seen.size(); ++i) {
    if (i + 1 < seen.size() && seen[i + 1].block == seen[i].block) continue;
    words_.insert(words_.end(), {seen[i].block, i + 1});
    ++words_[list];
  }
  for (const Seen& turn : seen) words_.push_back(turn.departure.number());
}

}  // namespace outrider::polyanya_search
