// Every reader of logs promises for any bytes: messages in the order of time, of channels that exist, or a
// refusal with a sentence.
#pragma once

#include <cstdlib>

#include "outrider/log/log_reader.hpp"

inline void require(bool kept) {
  if (!kept) std::abort();
}

/// Reads some messages; a few bytes may hold very many.
inline void read_fuzzed_log(const outrider::Outcome<std::unique_ptr<outrider::LogReader>>& reader) {
  if (!reader) return require(!reader.error().sentence.empty());
  constexpr int most_messages = 1000;
  std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();
  std::size_t sum = 0;
  for (int i = 0; i < most_messages; ++i) {
    const auto message = (*reader)->next();
    if (!message) return require(!message.error().sentence.empty());
    if (!*message) return;
    require((*message)->time_ns >= last_ns);
    require((*message)->channel < (*reader)->channels().size());
    last_ns = (*message)->time_ns;
    for (const char c : (*message)->data) sum += static_cast<unsigned char>(c);  // reads every byte
  }
  require(sum < std::numeric_limits<std::size_t>::max());
}
