#include "output/terminal.hpp"

#include <cstdio>

#include "outrider/core/text.hpp"

namespace outrider::cli {

void show_text(std::string_view text) {
  const std::string safe = printable(text, "\n\t");
  std::fwrite(safe.data(), 1, safe.size(), stdout);
}

void complain(std::string_view sentence) { fmt::print(stderr, "outrider: {}\n", printable(sentence)); }

void warn(std::string_view sentence) { complain(fmt::format("warning: {}", sentence)); }

void warn(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) warn(sentence);
}

void complain_without_memory(const char* sentence, const char* text) {
  for (const char* part : {"outrider: ", sentence, "\n"}) std::fputs(part, stderr);
  std::fputs(text, stdout);
  std::fflush(stdout);
}

}  // namespace outrider::cli
