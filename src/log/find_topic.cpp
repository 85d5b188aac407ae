#include "outrider/log/find_topic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "outrider/core/text.hpp"
#include "outrider/log/encoding/channel_decoder.hpp"

namespace outrider {
namespace {

/// Lists at most so many names that a line holds them.
std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    text += (i > 0 ? ", " : "") + excerpt(names[i]);
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  return text;
}

bool is_wished(const Channel& channel, const TopicWish& wish) {
  return std::ranges::find(wish.types, ros2_type_name(channel.type)) != wish.types.end();
}

/// Returns each topic once: those of a wish, or all.
std::vector<std::string> topics_of(const std::vector<Channel>& channels, const TopicWish* wish) {
  std::vector<std::string> topics;
  std::set<std::string_view> seen;
  for (const Channel& channel : channels) {
    if (wish != nullptr && !is_wished(channel, *wish)) continue;
    if (seen.insert(channel.topic).second) topics.push_back(channel.topic);
  }
  return topics;
}

std::string types_of(const TopicWish& wish) { return fmt::format("{}", fmt::join(wish.types, " or ")); }

tl::unexpected<Fault> no_topic(const std::vector<Channel>& channels, const TopicWish& wish) {
  const auto candidates = topics_of(channels, &wish);
  if (!candidates.empty()) {
    return bad_input(fmt::format("the log has no topic '{}'; {} has {}", excerpt(wish.topic), types_of(wish),
                                 list_of(candidates)),
                     std::string(wish.option));
  }
  const auto all = topics_of(channels, nullptr);
  return bad_input(fmt::format("the log has no topic of the type {}; it has {}", types_of(wish),
                               all.empty() ? "no topic at all" : list_of(all)),
                   std::string(wish.option));
}

}  // namespace

Outcome<std::vector<std::size_t>> find_topic(const std::vector<Channel>& channels, const TopicWish& wish) {
  std::string topic = wish.topic;
  if (topic.empty()) {
    const auto candidates = topics_of(channels, &wish);
    if (candidates.size() > 1) {
      return bad_input(fmt::format("the log has several topics of the type {}: {}; name one of them",
                                   types_of(wish), list_of(candidates)),
                       std::string(wish.option));
    }
    if (candidates.empty()) return no_topic(channels, wish);
    topic = candidates.front();
  }
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].topic != topic) continue;
    if (!is_wished(channels[i], wish)) {
      return bad_input(fmt::format("the messages of {} are {}, and not {}; name another topic",
                                   excerpt(topic), excerpt(channels[i].type), types_of(wish)),
                       std::string(wish.option));
    }
    found.push_back(i);
  }
  if (found.empty()) return no_topic(channels, wish);
  return found;
}

}  // namespace outrider
