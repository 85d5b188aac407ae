#include "outrider/sweep/canary.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "outrider/core/rng.hpp"
#include "outrider/core/sha256.hpp"

namespace outrider {
namespace {

constexpr int canary_places = 20'000;
constexpr std::size_t shown_digits = 16;

struct CanaryRow {
  std::string_view name;
  double (*value)(double x, double y);
  double low, high;
};

// The second argument y lies between 0 and 1.
const std::array<CanaryRow, 20> functions = {{
    {"sin", [](double x, double) { return std::sin(x); }, -100.0, 100.0},
    {"cos", [](double x, double) { return std::cos(x); }, -100.0, 100.0},
    {"tan", [](double x, double) { return std::tan(x); }, -100.0, 100.0},
    {"asin", [](double x, double) { return std::asin(x); }, -1.0, 1.0},
    {"acos", [](double x, double) { return std::acos(x); }, -1.0, 1.0},
    {"atan", [](double x, double) { return std::atan(x); }, -30.0, 30.0},
    {"atan2", [](double x, double y) { return std::atan2(x, y - 0.5); }, -1.0, 1.0},
    {"sinh", [](double x, double) { return std::sinh(x); }, -20.0, 20.0},
    {"cosh", [](double x, double) { return std::cosh(x); }, -20.0, 20.0},
    {"tanh", [](double x, double) { return std::tanh(x); }, -5.0, 5.0},
    {"exp", [](double x, double) { return std::exp(x); }, -300.0, 300.0},
    {"exp2", [](double x, double) { return std::exp2(x); }, -300.0, 300.0},
    {"expm1", [](double x, double) { return std::expm1(x); }, -2.0, 2.0},
    {"log", [](double x, double) { return std::log(x); }, 0x1p-20, 1000.0},
    {"log2", [](double x, double) { return std::log2(x); }, 0x1p-20, 1000.0},
    {"log10", [](double x, double) { return std::log10(x); }, 0x1p-20, 1000.0},
    {"log1p", [](double x, double) { return std::log1p(x); }, -0.9, 10.0},
    {"pow", [](double x, double y) { return std::pow(x, 10.0 * y - 5.0); }, 0x1p-20, 100.0},
    {"cbrt", [](double x, double) { return std::cbrt(x); }, -100.0, 100.0},
    {"hypot", [](double x, double y) { return std::hypot(x, y); }, -2.0, 2.0},
}};

}  // namespace

std::vector<std::pair<std::string, std::string>> mathematics_canary() {
  std::vector<std::pair<std::string, std::string>> hashes;
  for (const CanaryRow& row : functions) {
    Rng rng = Rng(1).child(row.name);
    Sha256 hash;
    for (int i = 0; i < canary_places; ++i) {
      const double x = rng.uniform(row.low, row.high);
      const double y = rng.uniform();
      const auto bits = std::bit_cast<std::array<char, sizeof(double)>>(row.value(x, y));
      hash.add({bits.data(), bits.size()});
    }
    hashes.emplace_back(row.name, hash.hex().substr(0, shown_digits));
  }
  return hashes;
}

}  // namespace outrider
