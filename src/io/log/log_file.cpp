#include "outrider/io/log/log_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "files/open_file.hpp"

namespace outrider {
namespace {

constexpr std::string_view sqlite_magic = "SQLite format 3";

/// Returns the first bytes of a file; empty if it cannot be read.
std::string start_of(const std::string& path) {
  const auto descriptor = open_file(path);
  if (!descriptor) return {};
  std::string start(16, '\0');
  const ssize_t count = ::pread(*descriptor, start.data(), start.size(), 0);
  ::close(*descriptor);
  start.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return start;
}

std::string log_of_run(const std::string& folder) { return folder + "/run.mcap"; }

}  // namespace

bool is_log_file(const std::string& path) {
  if (supplied_content(path) != nullptr) return false;
  if (file_kind(path) == FileKind::folder) return true;
  return starts_as_log(start_of(path));
}

Outcome<std::unique_ptr<LogReader>> open_log_file(const std::string& path, const LogSelection& selection) {
  const bool folder = file_kind(path) == FileKind::folder;
  if (folder && file_kind(log_of_run(path)) == FileKind::other)
    return open_log_file(log_of_run(path), selection);
  const bool opens_others = folder || start_of(path).starts_with(sqlite_magic);
  if (opens_others) {
    if (!reading_is_confined()) return open_log(path, selection);
    return bad_input("ROS 2 bags are not read here; \"outrider convert\" writes it as MCAP", path);
  }
  const auto descriptor = open_file(path);
  if (!descriptor) return pass_on(descriptor);
  return open_log(*descriptor, path, selection);
}

Status write_under_part_name(const std::string& path,
                             const std::function<Status(const std::string& part)>& write) {
  std::error_code error;
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    return bad_input("its folder does not exist; make it first", path);
  const std::string part = path + ".part";
  Status written = write(part);
  if (written) std::filesystem::rename(part, path, error);
  if (error) written = fault(FaultCode::cannot_write, "it cannot be written: " + error.message(), path);
  if (!written) std::filesystem::remove(part, error);
  return written;
}

Status write_log_file(const std::string& path, const std::function<Status(McapWriter&)>& fill) {
  return write_under_part_name(path, [&](const std::string& part) -> Status {
    auto writer = McapWriter::create(part);
    if (!writer) return fault(writer.error().code, writer.error().sentence, path);
    if (auto ok = fill(*writer); !ok) return ok;
    return writer->finish();
  });
}

}  // namespace outrider
