#include "outrider/io/track_csv.hpp"

#include <fmt/format.h>

#include <iterator>

namespace outrider {

std::string track_csv(const std::vector<Pose2>& poses) {
  std::string text = "step,x,y,heading\n";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", i, poses[i].position.x, poses[i].position.y,
                   poses[i].heading_rad);
  }
  return text;
}

}  // namespace outrider
