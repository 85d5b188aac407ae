#include <fmt/format.h>

#include "log/log_lines.hpp"

namespace outrider {
namespace {

constexpr std::string_view forms = "'ODOMETRY turn distance turn' or 'SENSOR id range bearing'";
constexpr std::string_view map_form = "'id x y' with a whole number for id";

}  // namespace

Outcome<LandmarkLog> landmark_log_from_freiburg(const NamedText& log, const NamedText& map,
                                                const LogNoise& noise) {
  LandmarkLog result;
  auto ok = for_each_line(log, [&](std::span<const std::string_view> words) -> Status {
    const bool moves = words[0] == "ODOMETRY";
    if (!moves && words[0] != "SENSOR") {
      return bad_input(
          fmt::format("'{}' begins no line of this log; a line is {}", excerpt(words[0]), forms));
    }
    const auto v = line_numbers(words.subspan(1), 3, forms);
    if (!v) return bad_input(v.error().sentence);
    if (moves || result.steps.empty()) {
      LogMotion motion;
      if (moves) motion.add((*v)[0], (*v)[1], (*v)[2], noise);
      result.steps.push_back({static_cast<double>(result.steps.size()), motion.pose, motion.covariance, {}});
    }
    if (moves) return {};
    const auto id = number<std::int64_t>(words[1]);
    if (!id || *id < 0)
      return bad_input(fmt::format("'{}' is no id; a line is {}", excerpt(words[1]), forms));
    result.steps.back().sightings.push_back(sighted(*id, (*v)[1], (*v)[2], noise.range_m, noise.bearing_rad));
    return {};
  });
  if (!ok) return pass_on(ok);
  ok = for_each_line(map, [&](std::span<const std::string_view> words) -> Status {
    const auto v = line_numbers(words, 3, map_form);
    if (!v) return bad_input(v.error().sentence);
    const auto id = number<std::int64_t>(words[0]);
    if (!id) return bad_input(fmt::format("'{}' is no id; a line is {}", excerpt(words[0]), map_form));
    result.true_landmarks[*id] = {(*v)[1], (*v)[2]};
    return {};
  });
  if (!ok) return pass_on(ok);
  if (result.steps.empty()) return bad_input("the log is empty; expected at least one line", log.name);
  return result;
}

}  // namespace outrider
