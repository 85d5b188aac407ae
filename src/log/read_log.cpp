#include "outrider/log/read_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "messages/run_messages.hpp"
#include "outrider/core/text.hpp"
#include "outrider/log/encoding/channel_decoder.hpp"

namespace outrider {
namespace {

/// Decodes a message and appends it to a log.
using AppendDecoded = std::function<Status(Log& log, const LogMessage& message)>;

/// A type of message, and the function that makes the decoder of a channel of that type.
struct KnownType {
  std::string_view name;
  Outcome<AppendDecoded> (*decoder_of)(const Channel& channel);
};

template <class Message>
Outcome<AppendDecoded> decoder_of(const Channel& channel) {
  auto decoder = ChannelDecoder<Message>::of(channel);
  if (!decoder) return pass_on(decoder);
  return AppendDecoded([topic = channel.topic, decoder = *decoder](Log& log, const LogMessage& message) {
    Message decoded;
    auto ok = decoder.decode(message.data, decoded);
    if (ok) log.append(topic, seconds(message.time_ns), std::move(decoded));
    return ok;
  });
}

template <class... Messages>
constexpr std::array<KnownType, sizeof...(Messages)> known_types(MessageList<Messages...> /*unused*/) {
  return {{{Messages::type, &decoder_of<Messages>}...}};
}

constexpr auto run_types = known_types(RunMessages());

/// Returns the decoders of the channels; an empty one for a channel whose type a run never has.
Outcome<std::vector<AppendDecoded>> decoders_of(const std::vector<Channel>& channels,
                                                const std::string& path) {
  std::vector<AppendDecoded> decoders;
  for (const Channel& channel : channels) {
    const auto* known = std::ranges::find(run_types, ros2_type_name(channel.type), &KnownType::name);
    if (known == run_types.end()) {
      decoders.emplace_back();
      continue;
    }
    auto decoder = known->decoder_of(channel);
    if (!decoder) return bad_input(decoder.error().sentence, path + ": " + decoder.error().where);
    decoders.push_back(std::move(*decoder));
  }
  return decoders;
}

/// Refuses a topic with channels of two types, which a run never has.
Status check_topics(const std::vector<Channel>& channels, const std::string& path) {
  std::map<std::string_view, std::string_view> type_of;
  for (const Channel& channel : channels) {
    const std::string_view type = type_of.emplace(channel.topic, channel.type).first->second;
    if (type == channel.type) continue;
    return bad_input(
        fmt::format("the topic '{}' has messages of two types, {} and {}; a run never leaves that",
                    excerpt(channel.topic), excerpt(type), excerpt(channel.type)),
        path);
  }
  return {};
}

}  // namespace

Outcome<StoredLog> read_log(const std::string& path) {
  constexpr std::size_t most_bytes = std::size_t{4} << 30;
  auto reader = open_log(path);
  if (!reader) return pass_on(reader);
  if (auto ok = check_topics((*reader)->channels(), path); !ok) return pass_on(ok);
  const auto decoders = decoders_of((*reader)->channels(), path);
  if (!decoders) return pass_on(decoders);
  StoredLog stored;
  std::size_t bytes = 0;
  while (true) {
    auto next = (*reader)->next();
    if (!next) return pass_on(next);
    const std::optional<LogMessage> message = *next;
    if (!message) break;
    bytes += message->data.size();
    if (bytes > most_bytes)
      return bad_input("its messages have more than 4 GiB; open it with the page instead", path);
    const AppendDecoded& append = (*decoders)[message->channel];
    if (!append) continue;
    if (auto ok = append(stored.log, *message); !ok) {
      const std::string& topic = (*reader)->channels()[message->channel].topic;
      return bad_input(fmt::format("a message on '{}' at {:.3f} s: {}", excerpt(topic),
                                   seconds(message->time_ns), ok.error().sentence),
                       path);
    }
  }
  stored.cut_short = (*reader)->cut_short();
  return stored;
}

}  // namespace outrider
