#include "outrider/io/file_hash.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "open_file.hpp"
#include "outrider/core/sha256.hpp"

namespace outrider {

Outcome<std::string> file_hash(const std::string& path) {
  if (const std::string* content = supplied_content(path)) return sha256(*content);
  const auto descriptor = open_file(path);
  if (!descriptor) return pass_on(descriptor);
  Sha256 hash;
  std::string piece(std::size_t{1} << 18U, '\0');
  int error = 0;
  for (;;) {
    const ssize_t got = ::read(*descriptor, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) error = errno;
    if (got <= 0) break;
    hash.add(std::string_view(piece).substr(0, static_cast<std::size_t>(got)));
  }
  ::close(*descriptor);
  if (error != 0) {
    return bad_input(fmt::format("it cannot be read: {}", std::generic_category().message(error)), path);
  }
  return hash.hex();
}

}  // namespace outrider
