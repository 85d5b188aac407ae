// ROS 1 bags: any bytes are a log or a refusal with a sentence, with and without a selection.
#include "formats.hpp"
#include "fuzz_entry.hpp"
#include "read_fuzzed_log.hpp"

extern "C" int FUZZ_ENTRY(bag)(const unsigned char* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  read_fuzzed_log(outrider::open_bag(outrider::memory_source(bytes, "run.bag")));
  read_fuzzed_log(outrider::open_bag(outrider::memory_source(bytes, "run.bag"),
                                     {.topics = {"/scan"}, .from_ns = 2, .to_ns = 30}));
  return 0;
}
