// MCAP: any bytes are a log or a refusal with a sentence; times never decrease, and every message has a
// channel.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz_entry.hpp"
#include "mcap/mcap_attachments.hpp"
#include "mcap/read/mcap_reader.hpp"
#include "read_fuzzed_log.hpp"

namespace {

void read(std::string_view bytes, const outrider::LogSelection& selection) {
  const auto log = outrider::open_mcap(outrider::memory_source(bytes, "run.mcap"), selection);
  if (!log) {
    require(!log.error().sentence.empty());
    return;
  }
  std::int64_t last_ns = 0;
  while (true) {
    const auto message = (*log)->next();
    if (!message) {
      require(!message.error().sentence.empty() && !(*log)->next());
      return;
    }
    if (!*message) return;
    require((*message)->channel < (*log)->channels().size() && (*message)->time_ns >= last_ns);
    last_ns = (*message)->time_ns;
  }
}

}  // namespace

extern "C" int FUZZ_ENTRY(mcap)(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  read(bytes, {});
  read(bytes, {.topics = {"/a"}, .from_ns = 10, .to_ns = 1000});
  const auto attachments = outrider::read_attachments(*outrider::memory_source(bytes, "run.mcap"));
  require(attachments || !attachments.error().sentence.empty());
  return 0;
}
