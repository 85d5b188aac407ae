// A child process of the server. Collects its output, passes on its progress and its log as they come, and
// ends it on request.
//
// Each mission is its own process: it can be ended at any moment, its memory is freed, and its faults do not
// affect the server. It reads no file outside its folder, cannot exceed its limits of memory and processor
// time, and ends with the server, however the server ends.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/io/files/open_folder.hpp"

namespace outrider::server {

/// Is false under the sanitizers, whose programs reserve more memory than there is.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool limits_memory = false;
#else
inline constexpr bool limits_memory = true;
#endif

struct ChildProgram {
  std::vector<std::string> words;  ///< the first is the program
  OpenFolder folder;               ///< its working folder, to which OUTRIDER_CONFINE confines it
  std::string input{};             ///< text for its standard input
  std::chrono::seconds limit{60};  ///< processor time, at least 1 s
  std::size_t memory_bytes = 0;    ///< limit of its data segment; 0: none
  std::size_t most_output_bytes = std::size_t{16} << 20U;  ///< limit of standard output; the rest is dropped
  std::optional<OpenFolder> out = {};                      ///< another folder, which it finds as child_out
};

/// The path under which a program finds the folder `out`.
inline constexpr std::string_view child_out = "/proc/self/fd/5";

struct ChildResult {
  int status = -1;         ///< exit status; -1 if it was killed or could not be started
  bool cancelled = false;  ///< the stop token ended it
  bool timed_out = false;  ///< it has used up its processor time
  std::string output;      ///< its standard output
  std::string errors;      ///< its standard error, at most 64 KiB
};

/// Receives what a program writes while it runs. Both functions are called on the thread of run_child().
struct ChildListener {
  std::function<void(std::string_view line)> on_line = {};  ///< a line of its progress: OUTRIDER_PROGRESS
  std::function<void(std::string_view bytes)> on_log = {};  ///< bytes of its log: OUTRIDER_LIVE
};

/// Runs the program until it ends, `stop` is raised, or its processor time is used up: then it gets SIGXCPU,
/// and a second of it later SIGKILL. Nobody else's work counts. The variables OUTRIDER_PROGRESS
/// and OUTRIDER_LIVE name descriptors to which the program may write; the listener receives what comes there.
/// A program that writes waits at most as long as the listener takes.
ChildResult run_child(const ChildProgram& program, const std::stop_token& stop,
                      const ChildListener& listener);

}  // namespace outrider::server
