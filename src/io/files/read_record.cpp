#include "outrider/io/files/read_record.hpp"

#include <atomic>
#include <mutex>

#include "files/open_file.hpp"

namespace outrider {
namespace {

std::atomic<bool> recording = false;
std::mutex mutex;  // guards `noted`
std::set<std::string> noted;

}  // namespace

void note_read(const std::string& path) {
  if (!recording.load(std::memory_order_relaxed)) return;
  const std::lock_guard lock(mutex);
  noted.insert(path);
}

ReadRecord::ReadRecord() {
  const std::lock_guard lock(mutex);
  noted.clear();
  recording = true;
}

ReadRecord::~ReadRecord() { recording = false; }

std::set<std::string> ReadRecord::paths() const {
  const std::lock_guard lock(mutex);
  return noted;
}

}  // namespace outrider
