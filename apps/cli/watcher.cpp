#include "watcher.hpp"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <string_view>

namespace outrider::cli {

int watched_descriptor(const char* variable) {
  const char* text = std::getenv(variable);
  const std::string_view word = text == nullptr ? "" : text;
  int number = -1;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size() || number <= 2) return -1;
  std::signal(SIGPIPE, SIG_IGN);  // the watching program may exit
  return number;
}

void Watcher::send(std::string line) const {
  if (!is_there()) return;
  line += '\n';
  for (std::string_view left = line; !left.empty();) {
    const ssize_t written = ::write(descriptor_, left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    left.remove_prefix(static_cast<std::size_t>(written));
  }
}

}  // namespace outrider::cli
