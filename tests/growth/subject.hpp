// A subject of the growth tests: a made-up case of each size, the counts of solving it, and the growth that
// is claimed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "outrider/core/rng.hpp"

namespace outrider::growth {

/// A count of a subject, and how it may grow.
struct Claim {
  std::string counted;                  ///< what is counted
  std::string sentence;                 ///< the complexity as the header claims it, in its words
  std::function<double(double)> bound;  ///< the same as a function of the size, to a constant factor
};

/// An algorithm, and one number that its cases grow in.
struct Subject {
  std::string name;
  std::string parameter;  ///< what the sizes mean
  std::string header;     ///< under include/outrider, where the claims stand
  std::vector<int> sizes;
  std::vector<Claim> claims;
  /// Solves a case of that size and returns one count for each claim.
  std::function<std::vector<double>(int size)> run;
};

/// A row of the table.
struct Growth {
  std::vector<double> counts;     ///< by size
  double exponent = 0.0;          ///< least squares of log count over log size
  double claimed_exponent = 0.0;  ///< the same of the bound of the claim at the same sizes
};

/// Exponents may exceed those of their claims by this much: small cases have constant parts, random ones
/// differ.
inline constexpr double tolerance = 0.15;

// Bounds that many claims share.
inline double constant(double) { return 1.0; }
inline double linear(double n) { return n; }
inline double squared(double n) { return n * n; }

/// Returns the slope of the line of least squares through (log size, log count). Counts below 1 count as 1.
double exponent_of(const std::vector<int>& sizes, const std::vector<double>& counts);

/// Runs all sizes. One result for each claim.
std::vector<Growth> measure(const Subject& subject);

/// Returns true if the counts grow no faster than claimed, up to `tolerance`.
bool keeps(const Growth& growth);

/// The stream of random numbers for a case.
Rng stream(const std::string& subject, int size);

std::vector<Subject> path_subjects();
std::vector<Subject> polygon_subjects();
std::vector<Subject> pursuit_subjects();
std::vector<Subject> guard_subjects();
std::vector<Subject> slam_subjects();
std::vector<Subject> laser_subjects();
std::vector<Subject> cover_subjects();
/// Returns all of them.
std::vector<Subject> subjects();

/// Returns the table of docs/benchmarks/growth.md, in Markdown.
std::string table();

}  // namespace outrider::growth
