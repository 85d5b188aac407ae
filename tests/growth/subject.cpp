#include "subject.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace outrider::growth {
namespace {

/// Writes a count with at most four digits of it, such as 1.234e6.
std::string short_text(double count) {
  return count < 1e4 ? fmt::format("{:.0f}", count) : fmt::format("{:.3g}", count);
}

template <class Range, class Text>
std::string joined(const Range& range, Text text) {
  std::string all;
  for (const auto& value : range) all += (all.empty() ? "" : ", ") + text(value);
  return all;
}

}  // namespace

double exponent_of(const std::vector<int>& sizes, const std::vector<double>& counts) {
  double sum_x = 0.0, sum_y = 0.0, sum_xx = 0.0, sum_xy = 0.0;
  const auto n = static_cast<double>(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double x = std::log(static_cast<double>(sizes[i]));
    const double y = std::log(std::max(counts[i], 1.0));
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

std::vector<Growth> measure(const Subject& subject) {
  std::vector<Growth> growths(subject.claims.size());
  for (const int size : subject.sizes) {
    const std::vector<double> counts = subject.run(size);
    for (std::size_t k = 0; k < growths.size(); ++k) growths[k].counts.push_back(counts.at(k));
  }
  for (std::size_t k = 0; k < growths.size(); ++k) {
    std::vector<double> bounds;
    for (const int size : subject.sizes) bounds.push_back(1e6 * subject.claims[k].bound(size));
    growths[k].exponent = exponent_of(subject.sizes, growths[k].counts);
    growths[k].claimed_exponent = exponent_of(subject.sizes, bounds);
  }
  return growths;
}

bool keeps(const Growth& growth) { return growth.exponent <= growth.claimed_exponent + tolerance; }

Rng stream(const std::string& subject, int size) {
  return Rng(25).child(subject).child(static_cast<std::uint64_t>(size));
}

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (auto some : {path_subjects(), polygon_subjects(), pursuit_subjects(), guard_subjects(),
                    slam_subjects(), laser_subjects(), cover_subjects()}) {
    std::ranges::move(some, std::back_inserter(all));
  }
  return all;
}

std::string table() {
  std::string text =
      "| subject | grows in | sizes | counted | counts | exponent | claimed | claim |\n"
      "|---|---|---|---|---|---:|---:|---|\n";
  for (const Subject& subject : subjects()) {
    const std::vector<Growth> growths = measure(subject);
    for (std::size_t k = 0; k < growths.size(); ++k) {
      text +=
          fmt::format("| {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {} (`{}`) |\n", subject.name,
                      subject.parameter, joined(subject.sizes, [](int n) { return std::to_string(n); }),
                      subject.claims[k].counted, joined(growths[k].counts, short_text), growths[k].exponent,
                      growths[k].claimed_exponent, subject.claims[k].sentence, subject.header);
    }
  }
  return text;
}

}  // namespace outrider::growth
