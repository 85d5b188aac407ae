#include "outrider/log/copy_log.hpp"

#include <map>
#include <optional>

#include "encoding/definition.hpp"
#include "encoding/ros1_to_cdr.hpp"

namespace outrider {
namespace {

/// The destination of a channel's messages, and their conversion if they need one.
struct Route {
  std::size_t to = 0;  ///< channel in the file that is written
  std::optional<Ros1ToCdr> converter;
};

Outcome<std::vector<Route>> add_channels(const LogReader& from, McapWriter& to, LogCopy& copy) {
  std::vector<Route> routes;
  for (const Channel& channel : from.channels()) {
    Route route;
    if (channel.encoding == "ros1" && !channel.schema.empty()) {
      auto converter = Ros1ToCdr::of(channel);
      if (!converter) return pass_on(converter);
      route.converter = std::move(*converter);
    }
    Channel written = route.converter ? route.converter->channel() : channel;
    if (written.encoding == "ros1") {
      written.type = short_name(written.type);
      copy.kept_ros1.push_back(channel.topic);
    }
    route.to = to.add_channel(written);
    routes.push_back(std::move(route));
  }
  return routes;
}

}  // namespace

Outcome<LogCopy> copy_log(LogReader& from, McapWriter& to, const std::function<bool(double)>& progress) {
  constexpr std::size_t messages_between_reports = 1000;
  LogCopy copy;
  auto routes = add_channels(from, to, copy);
  if (!routes) return pass_on(routes);
  for (;;) {
    auto read = from.next();
    if (!read) return pass_on(read);
    if (!*read) return copy;
    const LogMessage& message = **read;
    const Route& route = (*routes)[message.channel];
    if (route.converter) {
      const auto cdr = route.converter->convert(message.data);
      if (!cdr) return pass_on(cdr);
      if (auto ok = to.write(route.to, message.time_ns, *cdr); !ok) return pass_on(ok);
    } else if (auto ok = to.write(route.to, message.time_ns, message.data); !ok) {
      return pass_on(ok);
    }
    const bool reports = ++copy.messages % messages_between_reports == 0;
    if (reports && progress && !progress(from.progress())) {
      return fault(FaultCode::cancelled, "the copy was stopped");
    }
  }
}

}  // namespace outrider
