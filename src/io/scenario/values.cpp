#include "outrider/io/scenario/values.hpp"

#include <fmt/format.h>

#include "outrider/core/units.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {

Outcome<std::vector<double>> parse_numbers(const std::string& text, std::size_t count,
                                           const std::string& where, const std::string& form) {
  constexpr double most_m = 3e7;  // more than any projected coordinate
  auto numbers = numbers_of(parts_between(text, ','), most_m);
  if (numbers && numbers->size() == count) return std::move(*numbers);
  return bad_input(fmt::format("'{}' is not valid; expected {}", excerpt(text), form), where);
}

Outcome<Pose2> parse_pose(const std::string& text, const std::string& where) {
  auto n = parse_numbers(text, 3, where, "x,y,heading in m, m and degrees, such as 0,-9.5,90");
  if (!n) return pass_on(n);
  return Pose2{{(*n)[0], (*n)[1]}, radians((*n)[2])};
}

Outcome<Vec2> parse_place(const std::string& text, const std::string& where) {
  auto n = parse_numbers(text, 2, where, "x,y in m, such as 3.5,-2");
  if (!n) return pass_on(n);
  return Vec2{(*n)[0], (*n)[1]};
}

Outcome<Box2> parse_box(const std::string& text, const std::string& where) {
  auto n = parse_numbers(text, 4, where, "low x,low y,high x,high y in m, such as -10,-10,10,10");
  if (!n) return pass_on(n);
  const Box2 box{{(*n)[0], (*n)[1]}, {(*n)[2], (*n)[3]}};
  if (box.size().x <= 0.0 || box.size().y <= 0.0) {
    return bad_input(fmt::format("'{}' is empty; the low corner comes first", excerpt(text)), where);
  }
  return box;
}

}  // namespace outrider
