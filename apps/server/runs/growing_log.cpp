#include "runs/growing_log.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace outrider::server {
namespace {

constexpr const char* meanwhile = "the mission goes on, and its log can be fetched when it has ended";

std::string disk_failed(int error) {
  return fmt::format("the live log cannot be kept ({}); {}", std::generic_category().message(error),
                     meanwhile);
}

}  // namespace

GrowingLog::GrowingLog(OpenFolder folder, std::string name, std::uint64_t most_bytes, ByteBudget& shared)
    : folder_(std::move(folder)),
      name_(std::move(name)),
      most_bytes_(most_bytes),
      shared_(shared),
      descriptor_(folder_.create_file(name_)) {
  if (descriptor_ < 0) stop(disk_failed(errno));
}

GrowingLog::~GrowingLog() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (descriptor_ >= 0) folder_.remove(name_);
}

std::string GrowingLog::path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

bool GrowingLog::append(std::string_view bytes) {
  if (!stopped().empty()) return true;
  if (bytes.size() > most_bytes_ - bytes_) {
    stop(fmt::format("the live log ends here, because it has the {} MiB that the server keeps of one; {}",
                     most_bytes_ >> 20U, meanwhile));
    return true;
  }
  if (!shared_.grow(lease_, bytes.size())) return false;
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      stop(disk_failed(errno));
      return true;
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
    bytes_ += static_cast<std::uint64_t>(count);
  }
  return true;
}

void GrowingLog::stop(std::string sentence) {
  const std::lock_guard lock(mutex_);
  if (stopped_.empty()) stopped_ = std::move(sentence);
}

std::string GrowingLog::stopped() const {
  const std::lock_guard lock(mutex_);
  return stopped_;
}

std::string GrowingLog::part(std::uint64_t offset, std::size_t most) const {
  const std::uint64_t there = bytes_;
  if (offset >= there) return {};
  std::string bytes(static_cast<std::size_t>(std::min<std::uint64_t>(most, there - offset)), '\0');
  std::size_t count = 0;
  while (count < bytes.size()) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data() + count, bytes.size() - count, static_cast<off_t>(offset + count));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    count += static_cast<std::size_t>(got);
  }
  bytes.resize(count);
  return bytes;
}

}  // namespace outrider::server
