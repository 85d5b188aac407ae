#include "outrider/path/grid/drive_lattice.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace outrider {
namespace {

struct Move {
  Cell by;
  std::uint32_t weight = 0;
};

constexpr std::array<Move, 16> moves{{{{1, 0}, 5},
                                      {{0, 1}, 5},
                                      {{-1, 0}, 5},
                                      {{0, -1}, 5},
                                      {{1, 1}, 7},
                                      {{-1, 1}, 7},
                                      {{-1, -1}, 7},
                                      {{1, -1}, 7},
                                      {{2, 1}, 11},
                                      {{1, 2}, 11},
                                      {{-1, 2}, 11},
                                      {{-2, 1}, 11},
                                      {{-2, -1}, 11},
                                      {{-1, -2}, 11},
                                      {{1, -2}, 11},
                                      {{2, -1}, 11}}};

constexpr std::size_t ring = 32;  // above the weight of any move, twice

/// Which dual squares are open. Square (x, y) has the centre of cell (x, y) as its lowest corner.
class Squares {
 public:
  Squares(const GridFrame& frame, const std::vector<float>& clearance_m, double radius_m)
      : frame_(frame), clearance_m_(clearance_m) {
    const double step = frame.resolution_m;
    // A robot so small that it leaves the hull of the centres: nothing stands in the way.
    least_ = radius_m < 0.5 * step ? -1e30 : radius_m - std::sqrt(0.5) * step - 1e-6;
  }

  [[nodiscard]] bool open(int x, int y) const {
    if (x < 0 || y < 0 || x + 1 >= frame_.width || y + 1 >= frame_.height) return false;
    const auto clearance = [&](int dx, int dy) { return clearance_m_[frame_.index({x + dx, y + dy})]; };
    return std::max({clearance(0, 0), clearance(1, 0), clearance(0, 1), clearance(1, 1)}) >= least_;
  }

  /// True when the move from the centre of `from` stays within open squares.
  [[nodiscard]] bool allow(Cell from, Cell by) const {
    if (frame_.width == 1 || frame_.height == 1) {  // the hull of the centres is a line
      return frame_.contains({from.x + by.x, from.y + by.y});
    }
    const int x = by.x < 0 ? from.x - 1 : from.x;  // the first square of the move
    const int y = by.y < 0 ? from.y - 1 : from.y;
    if (by.x == 0) return open(x, y) || open(x - 1, y);
    if (by.y == 0) return open(x, y) || open(x, y - 1);
    const int on_x = by.x / 2;  // of a knight's move: to its second square
    const int on_y = by.y / 2;
    return open(x, y) && open(x + on_x, y + on_y);
  }

 private:
  const GridFrame& frame_;
  const std::vector<float>& clearance_m_;
  double least_ = 0.0;
};

}  // namespace

DriveLattice::DriveLattice(const GridFrame& frame, const std::vector<float>& clearance_m, double radius_m)
    : moves_(frame.size(), 0), unit_m_(frame.resolution_m / (5.0 * std::sqrt(1.04))) {
  const Squares squares(frame, clearance_m, radius_m);
  for (std::size_t d = 0; d < directions; ++d) {
    step_[d] = static_cast<std::ptrdiff_t>(moves[d].by.y) * frame.width + moves[d].by.x;
  }
  for (std::size_t c = 0; c < moves_.size(); ++c) {
    for (std::size_t d = 0; d < directions; ++d) {
      if (squares.allow(frame.cell(c), moves[d].by)) {
        moves_[c] = static_cast<std::uint16_t>(moves_[c] | 1U << d);
      }
    }
  }
}

void DriveLattice::lower(Field& field, std::uint32_t scale, const Field* ceiling) const {
  std::vector<std::uint32_t> first(std::size_t{endless} + 1, 0);  // value -> its first seed
  for (const std::uint16_t value : field) ++first[value];
  std::exclusive_scan(first.begin(), first.end(), first.begin(), std::uint32_t{0});
  std::vector<std::uint32_t> seeds(first.back());
  for (std::size_t c = 0; c < field.size(); ++c) {
    if (field[c] < endless) seeds[first[field[c]]++] = static_cast<std::uint32_t>(c);
  }
  std::array<std::vector<std::uint32_t>, ring> open;  // the cells lowered, by value modulo its size
  std::size_t waiting = 0;
  std::size_t seed = 0;
  const auto pass_on_from = [&](std::size_t cell) {
    for (unsigned bits = moves_[cell]; bits != 0; bits &= bits - 1) {
      const auto d = static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t next = cell + static_cast<std::size_t>(step_[d]);
      const std::uint32_t there = field[cell] + scale * moves[d].weight;
      if (there >= field[next] || (ceiling != nullptr && there >= (*ceiling)[next])) continue;
      field[next] = static_cast<std::uint16_t>(there);
      open[there % ring].push_back(static_cast<std::uint32_t>(next));
      ++waiting;
    }
  };
  for (std::uint32_t value = 0; value < endless && (waiting > 0 || seed < seeds.size()); ++value) {
    std::vector<std::uint32_t>& here = open[value % ring];
    while (seed < seeds.size() && seed < first[value]) {
      const std::uint32_t cell = seeds[seed++];
      if (field[cell] == value && (ceiling == nullptr || (*ceiling)[cell] >= value)) pass_on_from(cell);
    }
    for (const std::uint32_t cell : here) {
      if (field[cell] == value) pass_on_from(cell);
    }
    waiting -= here.size();
    here.clear();
  }
}

}  // namespace outrider
