#include "bounds/order_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace outrider::cover {
namespace {

constexpr double unreachable = std::numeric_limits<double>::infinity();
constexpr int most_rounds = 400;
constexpr int patience = 12;         // rounds without a better bound before steps shrink
constexpr double least_step = 1e-3;  // of the first
constexpr double rounding = 1e-9;    // of the bound

/// A square table of costs, and the cheapest assignment of its columns to its rows.
class Assignment {
 public:
  explicit Assignment(std::size_t size) : size_(size), costs_(size * size, unreachable) {}

  double& cost(std::size_t row, std::size_t column) { return costs_[row * size_ + column]; }

  /// Finds the assignment with potentials, row by row. Returns its cost; nothing after a stop request.
  std::optional<double> solve(const std::stop_token& stop) {
    std::vector<double> row_price(size_ + 1, 0.0), column_price(size_ + 1, 0.0);
    std::vector<std::size_t> row_of(size_ + 1, 0);  // by column from 1; 0: none
    for (std::size_t row = 1; row <= size_; ++row) {
      if (stop.stop_requested()) return std::nullopt;
      add_row(row, row_price, column_price, row_of);
    }
    columns.assign(size_, 0);
    double sum = 0.0;
    for (std::size_t column = 1; column <= size_; ++column) {
      columns[row_of[column] - 1] = column - 1;
      sum += cost(row_of[column] - 1, column - 1);
    }
    return sum;
  }

  std::vector<std::size_t> columns;  ///< by row, once solved

 private:
  void add_row(std::size_t row, std::vector<double>& row_price, std::vector<double>& column_price,
               std::vector<std::size_t>& row_of) {
    std::vector<double> slack(size_ + 1, unreachable);
    std::vector<std::size_t> before(size_ + 1, 0);
    std::vector<bool> used(size_ + 1, false);
    row_of[0] = row;
    std::size_t at = 0;
    do {
      used[at] = true;
      const std::size_t from = row_of[at];
      double least = unreachable;
      std::size_t next = 0;
      for (std::size_t column = 1; column <= size_; ++column) {
        if (used[column]) continue;
        const double reduced = cost(from - 1, column - 1) - row_price[from] - column_price[column];
        if (reduced < slack[column]) {
          slack[column] = reduced;
          before[column] = at;
        }
        if (next == 0 || slack[column] < least) {
          least = slack[column];
          next = column;
        }
      }
      for (std::size_t column = 0; column <= size_; ++column) {
        if (used[column]) {
          row_price[row_of[column]] += least;
          column_price[column] -= least;
        } else {
          slack[column] -= least;
        }
      }
      at = next;
    } while (row_of[at] != 0);
    while (at != 0) {
      row_of[at] = row_of[before[at]];
      at = before[at];
    }
  }

  std::size_t size_;
  std::vector<double> costs_;
};

/// The cheapest drives from unit to unit under prices of the stops. Row and column 0 are the start and the
/// end.
class Relaxation {
 public:
  Relaxation(const TourProblem& problem, bool started)
      : problem_(problem), started_(started), stops_(problem.services.size()), size_(problem.goals + 1) {}

  std::optional<double> solve(const std::vector<double>& prices, std::vector<int>& surplus,
                              const std::stop_token& stop) {
    Assignment costs(size_);
    std::vector<std::size_t> from(size_ * size_, 0), to(size_ * size_, 0);
    for (std::size_t i = 0; i < stops_; ++i) {
      for (std::size_t j = 0; j < stops_; ++j) {
        const std::size_t u = unit_of(i), v = unit_of(j);
        if (u == v) continue;
        const double cost = time_s(i, j) + prices[j] - prices[i];
        if (cost >= costs.cost(u, v)) continue;
        costs.cost(u, v) = cost;
        from[u * size_ + v] = i;
        to[u * size_ + v] = j;
      }
    }
    const std::optional<double> bound = costs.solve(stop);
    if (!bound) return bound;
    surplus.assign(stops_, 0);
    for (std::size_t u = 0; u < size_; ++u) {
      const std::size_t arc = u * size_ + costs.columns[u];
      ++surplus[to[arc]];
      --surplus[from[arc]];
    }
    return bound;
  }

  [[nodiscard]] std::size_t stops() const { return stops_; }

 private:
  [[nodiscard]] std::size_t unit_of(std::size_t stop) const {
    return stop == 0 ? 0 : problem_.services[stop].front().goal + 1;
  }
  [[nodiscard]] double time_s(std::size_t from, std::size_t to) const {
    if (to == 0) return 0.0;
    const double drive_s = from == 0 && !started_ ? 0.0 : problem_.drives[from * stops_ + to].time_s;
    return drive_s + problem_.services[to].front().duration_s;
  }

  const TourProblem& problem_;
  bool started_;
  std::size_t stops_;
  std::size_t size_;
};

}  // namespace

double order_bound_s(const TourProblem& problem, bool started, double aim_s, const std::stop_token& stop) {
  Relaxation relaxation(problem, started);
  std::vector<double> prices(relaxation.stops(), 0.0);
  std::vector<int> surplus;
  double best = 0.0, step = 1.0;
  int stale = 0;
  for (int round = 0; round < most_rounds && step > least_step; ++round) {
    const std::optional<double> bound = relaxation.solve(prices, surplus, stop);
    if (!bound) break;
    ++stale;
    if (*bound > best) {
      best = *bound;
      stale = 0;
    }
    double square = 0.0;
    for (const int one : surplus) square += one * one;
    if (best >= aim_s || square == 0.0) break;
    if (stale >= patience) {
      step *= 0.5;
      stale = 0;
    }
    const double scale = step * std::max(aim_s - *bound, 1e-6 * aim_s) / square;
    for (std::size_t i = 0; i < prices.size(); ++i) prices[i] += scale * surplus[i];
  }
  return best * (1.0 - rounding);
}

}  // namespace outrider::cover
