// The messages of the Foxglove WebSocket protocol, version 1, as text and bytes.
//
// Source: the specification, docs/spec.md of https://github.com/foxglove/ws-protocol. The subprotocol
// foxglove.sdk.v1 has the same messages.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fields.hpp"
#include "outrider/log/log_reader.hpp"

namespace outrider::server::foxglove {

/// Returns the subprotocol to speak with a client that offers these, separated by commas; empty if none fits.
std::string subprotocol_of(std::string_view offered);

enum class Level { info = 0, warning = 1, error = 2 };

std::string server_info(const std::string& version);
std::string status(Level level, const std::string& sentence);
/// Announces channels; their ids count up from `first_id`.
std::string advertise(std::span<const Channel> channels, std::uint32_t first_id);
/// Withdraws `count` channels from `first_id` on.
std::string unadvertise(std::uint32_t first_id, std::size_t count);
/// Returns a message of a channel, for the subscription of a client; the time is that of the run, in ns.
std::string message_data(std::uint32_t subscription, std::int64_t time_ns, std::string_view data);
/// Returns the time of the run, in ns.
std::string time(std::int64_t time_ns);

/// A request of a client: to subscribe to the messages of a channel, or to end a subscription.
struct Request {
  std::uint32_t subscription = 0;
  bool begins = false;        ///< subscribe, not unsubscribe
  std::uint32_t channel = 0;  ///< as advertised; only of a subscription that begins
};

/// Reads a message of a client; other operations than subscribe and unsubscribe give no requests. Fault:
/// bad_input if the message is not as the protocol asks.
Outcome<std::vector<Request>> requests_of(const Json& message);

}  // namespace outrider::server::foxglove
