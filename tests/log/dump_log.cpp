// dump_log FILE: prints each channel and each message of a log, the data in hexadecimal digits.
#include <cstdio>
#include <string>

#include "outrider/log/log_reader.hpp"

namespace {

int complain(const std::string& sentence) {
  std::fprintf(stderr, "dump_log: %s\n", sentence.c_str());
  return 1;
}

std::string hexadecimal(std::string_view bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += {digits[byte / 16U], digits[byte % 16U]};
  }
  return text;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return complain("expected a FILE");
  auto reader = outrider::open_log(words[1]);
  if (!reader) return complain(outrider::to_string(reader.error()));
  const auto& channels = (*reader)->channels();
  for (const auto& channel : channels) {
    std::printf("channel %s %s %s %s\n", channel.topic.c_str(), channel.type.c_str(),
                channel.encoding.c_str(), hexadecimal(channel.schema).c_str());
  }
  while (true) {
    auto message = (*reader)->next();
    if (!message) return complain(outrider::to_string(message.error()));
    if (!*message) break;
    const auto& channel = channels.at((*message)->channel);
    std::printf("message %s %lld %s\n", channel.topic.c_str(), static_cast<long long>((*message)->time_ns),
                hexadecimal((*message)->data).c_str());
  }
  const std::string cut = (*reader)->cut_short();
  if (!cut.empty()) std::printf("cut %s\n", cut.c_str());
  return 0;
}
