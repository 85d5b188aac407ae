#include "outrider/nodes/node.hpp"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <utility>

#include "outrider/core/text.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/nodes/robot_frames.hpp"

namespace outrider {
namespace {

constexpr std::size_t rosout = 0, status_output = 1;  // of the outputs of every node
constexpr double again_s = 5.0;                       // the same sentence
constexpr double status_every_s = 1.0;
constexpr std::size_t most_told = 1000;
constexpr double latest_s = 2147483647.0;  // that a stamp holds

}  // namespace

Node::Node(std::string name, double period_s, std::string status_topic)
    : name_(std::move(name)), period_s_(period_s) {
  add_output<rcl_interfaces::Log>("/rosout", Delivery::reliable);
  add_output<diagnostic_msgs::DiagnosticStatus>(std::move(status_topic), Delivery::latched);
}

void Node::listen_to_transforms(RobotFrames& frames) {
  const auto take = [this, &frames](Transforms kind) {
    return [this, &frames, kind](const tf2_msgs::TFMessage& message) {
      return frames.add(message, kind, now_s());
    };
  };
  listen<tf2_msgs::TFMessage>("/tf", Delivery::reliable, take(Transforms::moving));
  listen<tf2_msgs::TFMessage>("/tf_static", Delivery::fixed, take(Transforms::fixed));
}

void Node::receive(std::size_t input, std::string_view cdr, double time_s) {
  if (std::isfinite(time_s) && time_s >= 0.0 && time_s < latest_s) now_s_ = time_s;
  auto taken = handlers_.at(input)(cdr);
  if (taken) return;
  tell(NodeLevel::warning, fmt::format("{}: a message was ignored, because {}", inputs_[input].name,
                                       printable(taken.error().sentence)));
}

void Node::tick(double time_s) {
  if (std::isfinite(time_s) && time_s >= 0.0 && time_s < latest_s) now_s_ = time_s;
  act();
  if (!status_.state.empty() && std::abs(now_s_ - status_sent_s_) >= status_every_s) send_status();
}

void Node::tell(NodeLevel level, std::string sentence) {
  if (told_.size() > most_told) told_.clear();
  const auto [known, is_new] = told_.try_emplace(sentence, now_s_);
  if (!is_new && std::abs(now_s_ - known->second) < again_s) return;
  known->second = now_s_;
  rcl_interfaces::Log line;
  line.stamp = stamp_of(now_s_);
  line.level = static_cast<std::uint8_t>(level);
  line.name = name_;
  line.msg = sentence;
  send(rosout, line);
  events_.push_back({now_s_, level, std::move(sentence)});
}

std::string Node::why_missing(std::string_view what, const std::optional<double>& came_s,
                              double most_s) const {
  if (!came_s) return fmt::format("no {} has come yet", what);
  if (now_s_ - *came_s > most_s) return fmt::format("no {} has come for {:g} s", what, most_s);
  return {};
}

void Node::set_status(NodeLevel level, std::string state, std::string sentence) {
  NodeStatus next{level, std::move(state), std::move(sentence)};
  if (next == status_) return;
  const bool other = next.state != status_.state;
  status_ = std::move(next);
  if (other) tell(status_.level, fmt::format("{}: {}", status_.state, status_.sentence));
  send_status();
}

void Node::send_status() {
  status_sent_s_ = now_s_;
  diagnostic_msgs::DiagnosticStatus message;
  message.level = status_.level == NodeLevel::info ? 0 : status_.level == NodeLevel::warning ? 1 : 2;
  message.name = name_;
  message.message = status_.sentence;
  message.values = {{"state", status_.state}};
  send(status_output, message);
}

}  // namespace outrider
