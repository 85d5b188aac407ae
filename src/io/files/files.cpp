#include "outrider/io/files/files.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <memory>
#include <system_error>

#include "files/open_file.hpp"
#include "outrider/core/sha256.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

using GzFile = std::unique_ptr<gzFile_s, decltype([](gzFile file) { gzclose(file); })>;

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

namespace fs = std::filesystem;

constexpr std::size_t most_path = 200;  ///< bytes of a path that is shown

tl::unexpected<Fault> no_folder(const std::string& folder, const std::string& reason) {
  return bad_input(fmt::format("cannot make the folder '{}' ({}); name one that can be written to",
                               excerpt(folder, most_path), excerpt(reason, most_path)));
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

Status check_folder(const std::string& folder) {
  if (folder.empty()) return no_folder(folder, "its name is empty");
  std::error_code error;
  fs::path nearest = fs::absolute(folder, error);  // the nearest parent that exists
  for (std::error_code why; !error && nearest.has_relative_path(); nearest = nearest.parent_path()) {
    if (fs::exists(fs::symlink_status(nearest, why))) break;
    if (why == std::errc::filename_too_long) return no_folder(folder, why.message());
  }
  if (error) return no_folder(folder, error.message());
  if (!fs::is_directory(nearest, error)) return no_folder(folder, nearest.string() + " is no folder");
  if (::access(nearest.c_str(), W_OK | X_OK) != 0) {
    return no_folder(folder, "nothing may be written to " + nearest.string());
  }
  return {};
}

Status make_folder(const std::string& folder) {
  if (auto ok = check_folder(folder); !ok) return ok;
  std::error_code error;
  fs::create_directories(folder, error);
  if (std::error_code ignored; !fs::is_directory(folder, ignored)) return no_folder(folder, error.message());
  return {};
}

}  // namespace outrider
