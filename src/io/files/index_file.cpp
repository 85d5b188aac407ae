#include "outrider/io/files/index_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "files/open_file.hpp"
#include "outrider/io/files/files.hpp"

namespace outrider {
namespace {

Status check_usable(const std::string& path, const ConfiguredPlanner& planner, const IndexedGround& ground) {
  if (reading_is_confined()) return bad_input("index files are not available here; leave it out", path);
  if (!planner.load_index || !planner.save_index)
    return bad_input(
        "the planner has no index that can be kept; take hub_labels, octile_labels or terrain_labels", path);
  if (ground.grid == nullptr) return bad_input("an index is kept for a grid; take a map that is one", path);
  return {};
}

/// Maps an open file and closes it; the mapping stays.
Outcome<StoredIndex> mapped(int descriptor, const std::string& path) {
  struct stat status{};
  const bool known = ::fstat(descriptor, &status) == 0;
  const auto size = known ? static_cast<std::size_t>(status.st_size) : 0;
  if (size == 0) {
    ::close(descriptor);
    return StoredIndex{};
  }
  void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  const int error = errno;
  ::close(descriptor);
  if (memory == MAP_FAILED)
    return bad_input(fmt::format("it cannot be mapped: {}", std::generic_category().message(error)), path);
  std::shared_ptr<const void> owner(memory, [size](const void* p) { ::munmap(const_cast<void*>(p), size); });
  return StoredIndex{{static_cast<const std::byte*>(memory), size}, std::move(owner)};
}

}  // namespace

Outcome<bool> load_index_file(const std::string& path, const ConfiguredPlanner& planner,
                              const IndexedGround& ground, Workspace& workspace) {
  if (auto ok = check_usable(path, planner, ground); !ok) return pass_on(ok);
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return false;
  if (!std::filesystem::is_regular_file(status))
    return bad_input("it is not a regular file; name another", path);
  auto descriptor = open_file(path);
  if (!descriptor) return pass_on(descriptor);
  const auto stored = mapped(*descriptor, path);
  if (!stored) return pass_on(stored);
  if (auto ok = planner.load_index(ground, *stored, workspace); !ok)
    return bad_input(std::move(ok.error().sentence), path);
  return true;
}

Status save_index_file(const std::string& path, const ConfiguredPlanner& planner, const IndexedGround& ground,
                       const Budget& budget, Workspace& workspace) {
  if (auto ok = check_usable(path, planner, ground); !ok) return ok;
  const auto bytes = planner.save_index(ground, budget, workspace);
  if (!bytes) return pass_on(bytes);
  return write_file(path, *bytes);
}

}  // namespace outrider
