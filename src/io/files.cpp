#include "outrider/io/files.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <system_error>

#include "open_file.hpp"
#include "outrider/core/sha256.hpp"

namespace outrider {
namespace {

struct CloseGz {
  void operator()(gzFile file) const { gzclose(file); }
};
using GzFile = std::unique_ptr<gzFile_s, CloseGz>;

Outcome<GzFile> open_for_reading(const std::string& path) {
  auto descriptor = open_file(path);
  if (!descriptor) return pass_on(descriptor);
  GzFile file(gzdopen(*descriptor, "rb"));
  if (!file) {
    ::close(*descriptor);
    return bad_input("there is no memory left to read it", path);
  }
  return file;
}

tl::unexpected<Fault> too_long(const std::string& path, std::size_t limit_bytes) {
  return bad_input(fmt::format("it holds more than {} bytes, the most that is read", limit_bytes), path);
}

}  // namespace

bool file_exists(const std::string& path) { return file_kind(path) == FileKind::other; }

Outcome<std::string> read_file(const std::string& path, std::size_t limit_bytes) {
  if (const std::string* content = supplied_content(path)) {
    if (content->size() > limit_bytes) return too_long(path, limit_bytes);
    return *content;
  }
  auto file = open_for_reading(path);
  if (!file) return pass_on(file);
  std::string content;
  constexpr std::size_t chunk = std::size_t{1} << 18;
  for (;;) {
    const std::size_t before = content.size();
    content.resize(before + std::min(chunk, limit_bytes - before + 1));
    const int got =
        gzread(file->get(), content.data() + before, static_cast<unsigned>(content.size() - before));
    content.resize(before + static_cast<std::size_t>(std::max(got, 0)));
    int error = Z_OK;
    const std::string_view message = gzerror(file->get(), &error);
    if (got < 0 || error == Z_BUF_ERROR) {
      const std::string_view what =
          error == Z_ERRNO ? "it cannot be read" : "its gzip data is damaged or cut short";
      return bad_input(fmt::format("{} ({})", what, message), path);
    }
    if (content.size() > limit_bytes) return too_long(path, limit_bytes);
    if (got == 0) return content;
    constexpr std::size_t any = std::size_t{16} << 20U, most_times = 100;
    if (content.size() > any && content.size() / most_times > static_cast<std::size_t>(gzoffset(file->get())))
      return bad_input(
          fmt::format("its gzip data holds more than {} times its size; unpack it first", most_times), path);
  }
}

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
