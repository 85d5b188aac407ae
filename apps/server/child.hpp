// A program run on our behalf: what it prints is collected, each line of its progress is passed on, and it
// ends when it is told to.
//
// A mission is a process of its own: it can be ended at any moment, what it takes is freed, and no fault of
// it is one of the server. It reads no file outside its folder, takes no more memory and time than it is
// allowed, and ends with us, however we end.
#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace outrider::server {

/// Programs of the sanitizers reserve more memory than there is, so theirs is not limited.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool limits_memory = false;
#else
inline constexpr bool limits_memory = true;
#endif

struct ChildProgram {
  std::vector<std::string> words;  ///< the first is the program
  std::string folder;              ///< it works here, and OUTRIDER_CONFINE names it
  std::string input{};             ///< on its standard input
  std::chrono::seconds limit{60};
  std::size_t memory_bytes = 0;                            ///< of its data; 0: no limit
  std::size_t most_output_bytes = std::size_t{16} << 20U;  ///< of its standard output; the rest is dropped
};

struct ChildResult {
  int status = -1;         ///< exit status; -1 when it was ended or could not be started
  bool cancelled = false;  ///< the stop token ended it
  bool timed_out = false;  ///< the limit ended it
  std::string output;      ///< of its standard output
  std::string errors;      ///< of standard error, at most 64 KiB
};

/// Runs the program until it ends, `stop` is raised, or the limit has passed. Each line that it writes to the
/// descriptor that the variables OUTRIDER_PROGRESS and OUTRIDER_LIVE name is given to `on_line`, on the
/// calling thread, which must live as long as the child. The child waits for no longer than that takes.
ChildResult run_child(const ChildProgram& program, const std::stop_token& stop,
                      const std::function<void(std::string_view line)>& on_line);

}  // namespace outrider::server
