#include "outrider/io/log/log_export.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "files/zip.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/log/log_file.hpp"
#include "outrider/log/bytes/byte_sink.hpp"
#include "outrider/log/messages/known_messages.hpp"
#include "outrider/log/numpy.hpp"

namespace outrider {
namespace {

using UseMessage = std::function<Status(const Channel& channel, std::int64_t time_ns, const AnyMessage&)>;

/// Decodes the messages of the channels whose types are known.
Outcome<LogExport> for_each_message(LogReader& log, const ExportProgress& progress, const UseMessage& use) {
  constexpr std::size_t messages_between_reports = 1000;
  LogExport done;
  std::vector<std::optional<AnyMessage>> messages;
  for (const Channel& channel : log.channels()) {
    auto message = AnyMessage::of(channel);
    if (!message) return pass_on(message);
    if (!message->has_value()) done.left_out.push_back(fmt::format("{} ({})", channel.topic, channel.type));
    messages.push_back(std::move(*message));
  }
  for (std::size_t read = 1;; ++read) {
    auto next = log.next();
    if (!next) return pass_on(next);
    const std::optional<LogMessage> encoded = *next;
    if (!encoded) return done;
    if (read % messages_between_reports == 0 && progress && !progress(log.progress()))
      return fault(FaultCode::cancelled, "the conversion was stopped");
    std::optional<AnyMessage>& message = messages[encoded->channel];
    if (!message) continue;
    if (auto ok = message->decode(encoded->data); !ok) return pass_on(ok);
    if (auto ok = use(log.channels()[encoded->channel], encoded->time_ns, *message); !ok) return pass_on(ok);
    ++done.messages;
  }
}

}  // namespace

Outcome<LogExport> write_json_lines(LogReader& log, const std::string& path, const ExportProgress& progress) {
  Outcome<LogExport> done;
  auto written = write_under_part_name(path, [&](const std::string& part) -> Status {
    auto file = make_file_sink(part);
    if (!file) return fault(file.error().code, file.error().sentence, path);
    done = for_each_message(
        log, progress, [&](const Channel& channel, std::int64_t time_ns, const AnyMessage& message) {
          return (*file)->write(fmt::format(
              "{{\"topic\":{},\"time_ns\":{},\"type\":\"{}\",\"message\":{}}}\n",
              nlohmann::json(channel.topic).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
              time_ns, message.type().name,
              encode(MessageEncoding::json, message.type(), message.content())));
        });
    if (!done) return pass_on(done);
    return (*file)->close();
  });
  if (!written) return pass_on(written);
  return done;
}

Outcome<LogExport> write_numpy(LogReader& log, const std::string& path, const ExportProgress& progress) {
  NumpyArrays arrays;
  auto done = for_each_message(
      log, progress, [&](const Channel& channel, std::int64_t time_ns, const AnyMessage& message) {
        return arrays.append(channel.topic, time_ns, message.type(), message.content());
      });
  if (!done) return done;
  auto made = arrays.finish();
  if (!made) return pass_on(made);
  ZipFile zip;
  for (NumpyArray& array : *made) {
    if (auto ok = zip.add(array.name + ".npy", array.bytes); !ok) return pass_on(ok);
    std::string().swap(array.bytes);  // an assignment would keep the memory
  }
  if (auto ok = write_file(path, std::move(zip).finish()); !ok) return pass_on(ok);
  return done;
}

}  // namespace outrider
