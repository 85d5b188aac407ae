#include "runs/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>

extern char** environ;

namespace outrider::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_errors = std::size_t{64} << 10U;
constexpr std::size_t longest_line = std::size_t{64} << 10U;
constexpr std::size_t most_log_at_once = std::size_t{1} << 20U;  // more than a pipe holds
constexpr int progress_descriptor = 3;
constexpr int log_descriptor = 4;
constexpr int out_descriptor = 5;  // child_out
constexpr int poll_ms = 20;
constexpr std::chrono::seconds grace{1};  // between SIGTERM and SIGKILL

/// Owns a pipe and reads from it; the destructor closes it.
class Reader {
 public:
  Reader() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) ends_ = {-1, -1};
    if (ends_[0] >= 0) ::fcntl(ends_[0], F_SETFL, O_NONBLOCK);
  }
  ~Reader() {
    close_writer();
    if (ends_[0] >= 0) ::close(ends_[0]);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  [[nodiscard]] int descriptor() const { return ends_[0]; }
  [[nodiscard]] int writer() const { return ends_[1]; }
  void close_writer() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }
  /// Appends the available data to `text`, and drops what exceeds `most`. Returns false at the end of the
  /// stream.
  bool read(std::string& text, std::size_t most) const {
    return each_part(std::numeric_limits<std::size_t>::max(), [&](std::string_view part) {
      text.append(part.substr(0, most - std::min(most, text.size())));
    });
  }
  /// Passes on the available data in parts, until they are `enough`. Returns false at the end of the stream.
  template <class OnPart>
  bool each_part(std::size_t enough, OnPart on_part) const {
    std::array<char, 65536> buffer;  // NOLINT: read() fills it
    for (std::size_t done = 0; done < enough;) {
      const ssize_t count = ::read(ends_[0], buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return count < 0 && errno == EAGAIN;
      on_part(std::string_view(buffer.data(), static_cast<std::size_t>(count)));
      done += static_cast<std::size_t>(count);
    }
    return true;
  }

 private:
  std::array<int, 2> ends_{};
};

/// Holds the content in a memory file, positioned at its beginning. The descriptor is -1 if the system has no
/// room.
class Input {
 public:
  explicit Input(std::string_view content) : descriptor_(::memfd_create("input", MFD_CLOEXEC)) {
    while (descriptor_ >= 0 && !content.empty()) {
      const ssize_t count = ::write(descriptor_, content.data(), content.size());
      if (count <= 0) break;
      content.remove_prefix(static_cast<std::size_t>(count));
    }
    if (descriptor_ >= 0) ::lseek(descriptor_, 0, SEEK_SET);
  }
  ~Input() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Holds what the child needs. It is made before the fork, where memory may be allocated.
struct Start {
  char* const* words;
  char* const* environment;
  rlim_t memory_bytes, processor_s;
  int folder, in, out, err, progress, log, out_folder;
};

/// Returns the environment for the child, confined to its working folder, with the descriptors for its
/// progress and its log.
std::vector<std::string> environment() {
  std::vector<std::string> all = {"OUTRIDER_CONFINE=."};
  const std::string_view ours[] = {
      "OUTRIDER_PROGRESS=", "OUTRIDER_LIVE=", "OUTRIDER_CONFINE=", "OUTRIDER_TOKEN="};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const auto is_it = [&](std::string_view name) { return std::string_view(*entry).starts_with(name); };
    if (std::ranges::none_of(ours, is_it)) all.emplace_back(*entry);
  }
  all.push_back(std::string(ours[0]) + std::to_string(progress_descriptor));
  all.push_back(std::string(ours[1]) + std::to_string(log_descriptor));
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

/// Turns the forked child into the program. Only calls that are safe after a fork are allowed here.
[[noreturn]] void become(const Start& start, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent || ::fchdir(start.folder) != 0) ::_exit(127);  // the parent has already ended
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  const rlimit memory{start.memory_bytes, start.memory_bytes};
  if (limits_memory && start.memory_bytes > 0) ::setrlimit(RLIMIT_DATA, &memory);
  const rlimit processor{start.processor_s, start.processor_s + 1};
  ::setrlimit(RLIMIT_CPU, &processor);
  ::setpriority(PRIO_PROCESS, 0, 5);  // keeps the page responsive while a mission is planned
  sigset_t all;
  ::sigemptyset(&all);
  ::sigprocmask(SIG_SETMASK, &all, nullptr);
  for (const int number : {SIGINT, SIGTERM, SIGPIPE, SIGHUP, SIGXCPU}) ::signal(number, SIG_DFL);
  // Moves the descriptors to high numbers first, because one may have the number that another one needs.
  int from[out_descriptor + 1];  // NOLINT: the loop fills it
  const int given[] = {start.in, start.out, start.err, start.progress, start.log, start.out_folder};
  const int last = start.out_folder < 0 ? log_descriptor : out_descriptor;
  for (int to = 0; to <= last; ++to) from[to] = ::fcntl(given[to], F_DUPFD_CLOEXEC, 10);
  for (int to = 0; to <= last; ++to) {
    if (::dup2(from[to], to) < 0) ::_exit(127);
  }
  ::execve(start.words[0], start.words, start.environment);
  ::_exit(127);
}

/// Passes on the complete lines of `pending`, and keeps the rest.
void give_lines(std::string& pending, const std::function<void(std::string_view)>& on_line) {
  std::size_t begin = 0;
  for (std::size_t end = pending.find('\n'); end != std::string::npos; end = pending.find('\n', begin)) {
    if (on_line) on_line(std::string_view(pending).substr(begin, end - begin));
    begin = end + 1;
  }
  pending.erase(0, begin);
  if (pending.size() > longest_line) pending.clear();
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Asks the child to end, kills it after the grace period, and reaps it in every case.
class Ending {
 public:
  explicit Ending(pid_t child) : child_(child) {}
  Ending(const Ending&) = delete;
  Ending& operator=(const Ending&) = delete;
  ~Ending() {
    ::kill(-child_, SIGKILL);  // also kills processes that it left behind
    if (!ended_) ::waitpid(child_, nullptr, 0);
  }
  /// Returns true if the child has ended; tells what it has used.
  bool ended(int& status, rusage& used) {
    return ended_ = ::wait4(child_, &status, WNOHANG, &used) == child_;
  }
  void ask() {
    if (!asked_) ::kill(-child_, SIGTERM);
    if (!asked_) last_moment_ = Clock::now() + grace;
    asked_ = true;
    if (Clock::now() > last_moment_) ::kill(-child_, SIGKILL);
  }

 private:
  pid_t child_;
  bool asked_ = false;
  bool ended_ = false;
  Clock::time_point last_moment_;
};

}  // namespace

ChildResult run_child(const ChildProgram& program, const std::stop_token& stop,
                      const ChildListener& listener) {
  ChildResult result;
  Reader out, err, progress, log;
  const Input input(program.input);
  std::vector<std::string> word_copies = program.words, variables = environment();
  const std::vector<char*> word_pointers = pointers(word_copies), variable_pointers = pointers(variables);
  const pid_t parent = ::getpid();
  const Start start{word_pointers.data(),
                    variable_pointers.data(),
                    program.memory_bytes,
                    static_cast<rlim_t>(program.limit.count()),
                    program.folder.descriptor(),
                    input.descriptor(),
                    out.writer(),
                    err.writer(),
                    progress.writer(),
                    log.writer(),
                    program.out ? program.out->descriptor() : -1};
  const bool room = std::min({start.in, start.out, start.err, start.progress, start.log}) >= 0;
  const pid_t child = room ? ::fork() : -1;
  if (child == 0) become(start, parent);
  if (child < 0) {
    result.errors = "the mission could not be started: the system has no room for another process";
    return result;
  }
  ::setpgid(child, child);  // also done here, because the child may not have run yet
  for (Reader* reader : {&out, &err, &progress, &log}) reader->close_writer();

  Ending ending(child);
  std::string pending;
  int status = 0;
  rusage used{};
  for (bool running = true; running;) {
    std::array<pollfd, 4> waits = {{{out.descriptor(), POLLIN, 0},
                                    {err.descriptor(), POLLIN, 0},
                                    {progress.descriptor(), POLLIN, 0},
                                    {log.descriptor(), POLLIN, 0}}};
    ::poll(waits.data(), waits.size(), poll_ms);
    result.cancelled = result.cancelled || stop.stop_requested();
    if (result.cancelled) ending.ask();
    running = !ending.ended(status, used);
    bool open = out.read(result.output, program.most_output_bytes);
    open = err.read(result.errors, most_errors) && open;
    open = progress.read(pending, 2 * longest_line) && open;
    give_lines(pending, listener.on_line);
    const auto pass_on_log = [&](std::string_view part) {
      if (listener.on_log) listener.on_log(part);
    };
    open = log.each_part(most_log_at_once, pass_on_log) && open;
    if (running && !open) ::usleep(1000 * poll_ms);  // polling a closed pipe would not wait
  }
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  constexpr double nearly = 0.9;  // the kernel counts for the limit in ticks, and here exactly
  const double limit_s = std::chrono::duration<double>(program.limit).count();
  result.timed_out =
      result.status != 0 && seconds(used.ru_utime) + seconds(used.ru_stime) >= nearly * limit_s;
  return result;
}

}  // namespace outrider::server
