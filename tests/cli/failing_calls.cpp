// Makes calls of the system fail in a program that is started with it in LD_PRELOAD: what a full disk, or a
// lack of memory, does at one point of its work. The settings are variables of the environment:
//
//   FAIL_CALL      malloc, open, write, short_write, fsync, close, rename, link, mkdir or fork; short_write
//   writes half FAIL_AT        number of the first call that fails, from 1 FAIL_ERROR     its errno
//   FAIL_LASTS     if set, all later calls fail too, as on a disk that stays full
//   FAIL_BENEATH   calls are counted once a file whose path contains this text is opened for writing
//   FAIL_COUNT     file to which the number of calls is written in the end
//
// Forked processes count on. Calls that the C library makes itself (stdio) are not seen. Thread rule: any
// thread.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t size) noexcept;
void* __libc_calloc(std::size_t count, std::size_t size) noexcept;
void* __libc_realloc(void* place, std::size_t size) noexcept;
void* __libc_memalign(std::size_t alignment, std::size_t size) noexcept;

// The mode is there only if a file may be made, which makes no difference to how it is passed on.
int failing_open(const char* path, int flags, mode_t mode) asm("open");
int failing_open64(const char* path, int flags, mode_t mode) asm("open64");
int failing_openat(int folder, const char* path, int flags, mode_t mode) asm("openat");
int failing_openat64(int folder, const char* path, int flags, mode_t mode) asm("openat64");
}

namespace {

struct State {
  std::atomic<bool> armed = false;
  std::atomic<long> calls = 0;
};

State* state = nullptr;  // shared with forked processes; none until the settings are read
const char *failing_call = "", *beneath = "";
long at = 0;
int error = 0;
bool lasts = false;

/// Counts the call and returns true if it is to fail, with errno set.
bool fails(const char* call) {
  if (state == nullptr || !state->armed || std::strcmp(call, failing_call) != 0) return false;
  const long number = ++state->calls;
  if (number != at && !(lasts && number > at)) return false;
  errno = error;
  return true;
}

template <class Function>
Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool is_file(int descriptor) {
  struct stat status{};
  return descriptor > STDERR_FILENO && ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

bool fails_to_open(const char* path, int flags) {
  if ((flags & O_ACCMODE) == O_RDONLY) return false;
  if (state != nullptr && std::strstr(path, beneath) != nullptr) state->armed = true;
  return fails("open");
}

[[gnu::constructor]] void read_settings() {
  const char* call = std::getenv("FAIL_CALL");
  if (call == nullptr) return;
  failing_call = call;
  beneath = std::getenv("FAIL_BENEATH");
  at = std::atol(std::getenv("FAIL_AT"));
  error = std::atoi(std::getenv("FAIL_ERROR"));
  lasts = std::getenv("FAIL_LASTS") != nullptr;
  void* shared = ::mmap(nullptr, sizeof(State), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  state = new (shared) State;
}

[[gnu::destructor]] void write_count() {
  const char* path = std::getenv("FAIL_COUNT");
  if (state == nullptr || path == nullptr) return;
  state->armed = false;
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) return;
  std::fprintf(file, "%ld\n", state->calls.load());
  std::fclose(file);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept { return fails("malloc") ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) noexcept {
  return fails("malloc") ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* place, std::size_t size) noexcept {
  return fails("malloc") ? nullptr : __libc_realloc(place, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return fails("malloc") ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** place, std::size_t alignment, std::size_t size) noexcept {
  if (fails("malloc")) return ENOMEM;
  *place = __libc_memalign(alignment, size);
  return *place == nullptr ? ENOMEM : 0;
}

int failing_openat(int folder, const char* path, int flags, mode_t mode) {
  static const auto real = reinterpret_cast<decltype(&failing_openat)>(::dlsym(RTLD_NEXT, "openat"));
  return fails_to_open(path, flags) ? -1 : real(folder, path, flags, mode);
}
int failing_openat64(int folder, const char* path, int flags, mode_t mode) {
  return failing_openat(folder, path, flags, mode);
}
int failing_open(const char* path, int flags, mode_t mode) {
  return failing_openat(AT_FDCWD, path, flags, mode);
}
int failing_open64(const char* path, int flags, mode_t mode) {
  return failing_openat(AT_FDCWD, path, flags, mode);
}
ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  static const auto real = next(&::write, "write");
  if (is_file(descriptor)) {
    if (fails("write")) return -1;
    if (count > 1 && fails("short_write")) count /= 2;
  }
  return real(descriptor, bytes, count);
}
int fsync(int descriptor) {
  static const auto real = next(&::fsync, "fsync");
  return fails("fsync") ? -1 : real(descriptor);
}
int close(int descriptor) {
  static const auto real = next(&::close, "close");
  const bool fail = is_file(descriptor) && fails("close");
  const int result = real(descriptor), code = fail ? error : errno;
  errno = code;
  return fail ? -1 : result;
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  static const auto real = next(&::renameat, "renameat");
  return fails("rename") ? -1 : real(from_folder, from, to_folder, to);
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
  static const auto real = next(&::linkat, "linkat");
  return fails("link") ? -1 : real(from_folder, from, to_folder, to, flags);
}
int mkdir(const char* path, mode_t mode) noexcept {
  static const auto real = next(&::mkdir, "mkdir");
  if (state != nullptr && std::strstr(path, beneath) != nullptr) state->armed = true;
  return fails("mkdir") ? -1 : real(path, mode);
}
pid_t fork() noexcept {
  static const auto real = next(&::fork, "fork");
  return fails("fork") ? -1 : real();
}
}
