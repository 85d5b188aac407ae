// ROS 2 bags in SQLite files: any bytes are a log or a refusal with a sentence.
#include "formats.hpp"
#include "fuzz_entry.hpp"
#include "read_fuzzed_log.hpp"

extern "C" int FUZZ_ENTRY(db3)(const unsigned char* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  read_fuzzed_log(outrider::open_db3_bytes("run.db3", bytes));
  return 0;
}
