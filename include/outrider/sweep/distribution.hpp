// Varied: how an option of a scenario varies over the runs of a sweep, read from text such as
//
//   planner=a_star,theta_star           a grid: each value in turn
//   from=1,2;3,4                        a grid of values that have commas: a semicolon separates them
//   robot.radius=uniform(0.1,0.4)       a random value for each run
//   to=uniform(1,9),uniform(1,9)        text with several random values in it
//
// Distributions: uniform(low,high), log_uniform(low,high), integer(low,high) with both ends,
// normal(mean,deviation) and choice(a;b;c) or choice(a,b,c).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/core/rng.hpp"

namespace outrider {

/// A distribution of numbers or of words, drawn from by draw().
struct Distribution {
  enum class Kind { uniform, log_uniform, integer, normal, choice };
  Kind kind = Kind::uniform;
  double first = 0.0;   ///< low or mean
  double second = 0.0;  ///< high or standard deviation
  std::vector<std::string> words = {};
};

/// One option that varies.
struct Varied {
  std::string key;                ///< as in Changes: "seed", "robot.radius"
  std::vector<std::string> grid;  ///< its values; empty if it is random
  /// Text and distributions in turn, beginning and ending with text: `texts` has one more than `parts`.
  std::vector<std::string> texts;
  std::vector<Distribution> parts;

  [[nodiscard]] bool is_random() const { return grid.empty(); }
  /// Returns true if its values are numbers drawn from one distribution that is no choice.
  [[nodiscard]] bool is_random_number() const;
};

/// Reads KEY=VALUES. Fault: bad_input with the text and what would be right.
Outcome<Varied> parse_varied(std::string_view text);

/// Draws one value, as text. It is a pure function of the stream. Expects random options only.
std::string draw(const Varied& varied, Rng rng);

/// Returns values that stand for all that can be drawn: the ends of ranges, the mean, each word.
std::vector<std::string> extreme_values(const Varied& varied);

}  // namespace outrider
