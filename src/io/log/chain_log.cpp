#include <fmt/format.h>

#include <cmath>

#include "log/log_lines.hpp"

namespace outrider {
namespace {

constexpr std::string_view chain_odometry_form =
    "'ODOMETRY i j x y heading' and 6 numbers of the covariance's upper triangle";
constexpr std::string_view landmark_form =
    "'LANDMARK i k x y' and 3 numbers of the covariance's upper triangle";

}  // namespace

Outcome<LandmarkLog> landmark_log_from_chain(const NamedText& log) {
  LandmarkLog result;
  result.told_apart = true;
  std::int64_t pose = -1;  // number of the pose reached; -1: none
  const auto read = [](std::span<const std::string_view> words, std::size_t count, std::string_view form) {
    auto values = line_numbers(words.subspan(1), count, form);
    if (values && !(number<std::int64_t>(words[1]) && number<std::int64_t>(words[2])))
      values = bad_input(fmt::format("poses and landmarks have whole numbers; a line is {}", form));
    return values;
  };
  const auto read_odometry = [&](std::span<const std::string_view> words) -> Status {
    const auto v = read(words, 11, chain_odometry_form);
    if (!v) return pass_on(v);
    const auto& c = *v;
    const auto from = static_cast<std::int64_t>(c[0]);
    if (pose >= 0 && from != pose) {
      return bad_input(
          fmt::format("it starts at pose {}, where pose {} was reached; poses form a chain", from, pose));
    }
    pose = static_cast<std::int64_t>(c[1]);
    const LogStep step{static_cast<double>(result.steps.size()),
                       {{c[2], c[3]}, c[4]},
                       Eigen::Matrix3d{{c[5], c[6], c[7]}, {c[6], c[8], c[9]}, {c[7], c[9], c[10]}},
                       {}};
    if (auto ok = check(step); !ok) return ok;
    result.steps.push_back(step);
    return {};
  };
  const auto read_landmark = [&](std::span<const std::string_view> words) -> Status {
    const auto v = read(words, 7, landmark_form);
    if (!v) return pass_on(v);
    const auto& c = *v;
    const auto from = static_cast<std::int64_t>(c[0]), id = static_cast<std::int64_t>(c[1]);
    if (id < 0) return bad_input(fmt::format("landmarks count from 0; a line is {}", landmark_form));
    if (from != pose) {
      return bad_input(fmt::format(
          "it was seen from pose {}, but pose {} was reached; put it after the line that leads there", from,
          pose));
    }
    const LandmarkSighting sighting{id, {c[2], c[3]}, Eigen::Matrix2d{{c[4], c[5]}, {c[5], c[6]}}};
    LogStep alone;
    alone.sightings = {sighting};
    if (auto ok = check(alone); !ok) return ok;
    result.steps.back().sightings.push_back(sighting);
    return {};
  };
  auto ok = for_each_line(log, [&](std::span<const std::string_view> words) -> Status {
    if (words[0] == "ODOMETRY") return read_odometry(words);
    if (words[0] == "LANDMARK") return read_landmark(words);
    return bad_input(fmt::format("'{}' is no line of this log; a line is {} or {}", excerpt(words[0]),
                                 chain_odometry_form, landmark_form));
  });
  if (!ok) return pass_on(ok);
  if (result.steps.empty()) return bad_input("the log is empty; expected at least one line", log.name);
  return result;
}

}  // namespace outrider
