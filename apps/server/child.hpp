// A program run on our behalf: what it prints is collected, what it tells of itself given on, and it ends
// when it is told to.
//
// A mission is a process of its own: it can be ended at any moment, what it takes is freed, and no fault of
// it is one of the server. It ends with us as well, however we end.
#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace outrider::server {

struct ChildResult {
  int status = -1;         ///< exit status; -1 when it was ended or could not be started
  bool cancelled = false;  ///< the stop token ended it
  bool timed_out = false;  ///< the limit ended it
  std::string output;      ///< of its standard output, at most 16 MiB
  std::string errors;      ///< the same of standard error, at most 64 KiB
};

/// Runs `words` (the first is the program) in `folder` until it ends, `stop` is raised, or the limit has
/// passed. Each line that it writes to the descriptor that the variables OUTRIDER_PROGRESS and OUTRIDER_LIVE
/// name is given to `on_line`, on the calling thread, which must live as long as the child. The child waits
/// for no longer than that takes.
ChildResult run_child(const std::vector<std::string>& words, const std::string& folder,
                      std::chrono::seconds limit, const std::stop_token& stop,
                      const std::function<void(std::string_view line)>& on_line);

}  // namespace outrider::server
