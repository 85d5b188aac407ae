#include "node_clock.hpp"

#include <algorithm>

#include "outrider/job/clock.hpp"
#include "outrider/nodes/messages/checked.hpp"

namespace outrider {
namespace {

constexpr double longest_silence_s = 2.0;

}  // namespace

RunClock::RunClock(const RunNodeOptions& options)
    : kind_(options.clock), rate_(options.rate), moved_wall_s_(wall_s()), own_wall_s_(wall_s()) {}

Outcome<RunClock> RunClock::of(RosNode& network, const RunNodeOptions& options) {
  RunClock clock(options);
  if (options.clock != NodeClock::simulated) return clock;
  auto reader = network.reader("/clock", message_type<rosgraph_msgs::Clock>(), Delivery::sensor);
  if (!reader) return pass_on(reader);
  clock.clock_ = std::move(*reader);
  return clock;
}

std::optional<double> RunClock::now(double step_s) {
  if (kind_ == NodeClock::system) return day_s();
  if (kind_ == NodeClock::own) {
    const double at_s = wall_s();
    own_s_ += std::min(rate_ * (at_s - own_wall_s_), step_s);
    own_wall_s_ = at_s;
    return own_s_;
  }
  rosgraph_msgs::Clock message;
  for (auto taken = clock_->take(&message); taken && *taken; taken = clock_->take(&message)) {
    const auto time_s = time_of(message.clock);
    if (!time_s || simulated_s_ == *time_s) continue;
    simulated_s_ = *time_s;
    moved_wall_s_ = wall_s();
    told_ = false;
  }
  return simulated_s_;
}

std::optional<std::string> RunClock::silent() {
  if (kind_ != NodeClock::simulated || told_ || wall_s() - moved_wall_s_ < longest_silence_s)
    return std::nullopt;
  told_ = true;
  return "the time of the simulation, /clock, stands still";
}

}  // namespace outrider
