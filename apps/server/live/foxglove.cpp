#include "live/foxglove.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "http/message.hpp"
#include "outrider/core/text.hpp"

namespace outrider::server::foxglove {
namespace {

constexpr std::string_view known_subprotocols[] = {"foxglove.sdk.v1",
                                                   "foxglove.websocket.v1"};  // the first is best
constexpr char message_data_op = 0x01;
constexpr char time_op = 0x02;

/// Appends a number, the lowest byte first.
template <class Number>
void append_number(std::string& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof(Number); ++i) bytes += static_cast<char>((number >> (8U * i)) & 0xffU);
}

/// Returns a number of 32 bits; nothing if the value is not one.
std::optional<std::uint32_t> number_of(const Json& value) {
  if (!value.is_number_unsigned()) return std::nullopt;
  const auto number = value.get<std::uint64_t>();
  if (number > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

const Json* member(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

Outcome<std::vector<Request>> subscriptions_of(const Json& list) {
  std::vector<Request> requests;
  for (const Json& item : list) {
    const Json* const id = member(item, "id");
    const Json* const channel = member(item, "channelId");
    const auto numbers =
        std::pair(id ? number_of(*id) : std::nullopt, channel ? number_of(*channel) : std::nullopt);
    if (!numbers.first || !numbers.second)
      return bad_input("a subscription has an id and a channelId, each a number");
    requests.push_back({*numbers.first, true, *numbers.second});
  }
  return requests;
}

Outcome<std::vector<Request>> ends_of(const Json& list) {
  std::vector<Request> requests;
  for (const Json& item : list) {
    const auto id = number_of(item);
    if (!id) return bad_input("subscriptionIds are numbers");
    requests.push_back({*id, false, 0});
  }
  return requests;
}

}  // namespace

std::string subprotocol_of(std::string_view offered) {
  std::string best;
  for (const std::string_view known : known_subprotocols) {
    for (std::string_view rest = offered; !rest.empty() && best.empty();) {
      const std::string_view one = rest.substr(0, rest.find(','));
      rest.remove_prefix(std::min(rest.size(), one.size() + 1));
      if (trimmed(one) == known) best = known;
    }
  }
  return best;
}

std::string server_info(const std::string& version) {
  return text_of(Json{{"op", "serverInfo"},
                      {"name", "outrider " + version},
                      {"capabilities", {"time"}},
                      {"metadata", Json::object()}});
}

std::string status(Level level, const std::string& sentence) {
  return text_of(Json{{"op", "status"}, {"level", static_cast<int>(level)}, {"message", sentence}});
}

std::string advertise(std::span<const Channel> channels, std::uint32_t first_id) {
  Json list = Json::array();
  for (const Channel& channel : channels) {
    list.push_back({{"id", first_id++},
                    {"topic", channel.topic},
                    {"encoding", channel.encoding},
                    {"schemaName", channel.type},
                    {"schema", channel.schema},
                    {"schemaEncoding", channel.schema_encoding}});
  }
  return text_of(Json{{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string unadvertise(std::uint32_t first_id, std::size_t count) {
  Json ids = Json::array();
  for (std::size_t i = 0; i < count; ++i) ids.push_back(first_id + i);
  return text_of(Json{{"op", "unadvertise"}, {"channelIds", std::move(ids)}});
}

std::string message_data(std::uint32_t subscription, std::int64_t time_ns, std::string_view data) {
  std::string bytes(1, message_data_op);
  bytes.reserve(data.size() + 13);
  append_number(bytes, subscription);
  append_number(bytes, static_cast<std::uint64_t>(time_ns));
  return bytes.append(data);
}

std::string time(std::int64_t time_ns) {
  std::string bytes(1, time_op);
  append_number(bytes, static_cast<std::uint64_t>(time_ns));
  return bytes;
}

Outcome<std::vector<Request>> requests_of(const Json& message) {
  const Json* const op = member(message, "op");
  if (op == nullptr || !op->is_string()) return bad_input("a message has an op", "op");
  const bool begins = *op == "subscribe";
  if (!begins && *op != "unsubscribe") return std::vector<Request>{};
  const char* const key = begins ? "subscriptions" : "subscriptionIds";
  const Json* const list = member(message, key);
  if (list == nullptr || !list->is_array()) return bad_input(std::string("expected a list of ") + key, key);
  return begins ? subscriptions_of(*list) : ends_of(*list);
}

}  // namespace outrider::server::foxglove
