#include "tool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <string_view>

#include "commands/commands.hpp"
#include "commands/job_command.hpp"
#include "commands/research.hpp"
#include "output/output.hpp"
#include "output/terminal.hpp"
#include "outrider/io/files/confinement.hpp"
#include "stop_on_signal.hpp"

namespace outrider::cli {
namespace {

/// Returns true if JSON is requested; needed for faults that come before the flags are read.
bool wants_json(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--json" || word == "--json=true") return true;
  }
  return false;
}

int run(const std::vector<Job>& jobs, int argc, char** argv) {
  std::vector<std::string> given(argv + 1, argv + argc);
  if (!given.empty() && given[0] == "research")
    return print_fault(become_research({given.begin() + 1, given.end()}), wants_json(argc, argv));
  // Handles signals from the start, except while a scenario is read from standard input: then nothing has
  // begun that would need a clean end.
  std::optional<StopOnSignal> stop;
  const bool listens =
      runs_job(jobs, given) ||
      (!given.empty() && (given[0] == "convert" || given[0] == "ros" || given[0] == "sweep"));
  if (listens && std::ranges::count(given, "--stdin") == 0) stop.emplace();
  const auto words = expand_run(jobs, std::move(given));
  if (!words) return print_fault(words.error(), wants_json(argc, argv));
  if (listens && !stop) stop.emplace();
  Command tool("outrider", "A ground robot finds its way, and does a job, in a yard or a building.",
               OUTRIDER_VERSION);
  tool.footer(
      "\n'outrider COMMAND --help' shows the flags of a command.\n"
      "Exit status: 0 the job was done, 1 it was not, 2 the request or an input was wrong,\n"
      "3 an answer could not be written, as on a full disk.\n"
      "'outrider research COMMAND' has reference methods to compare with, where they are built.");
  add_run(tool);
  add_jobs(tool, jobs, stop ? stop->token() : std::stop_token());
  add_calibrate(tool);
  add_detect(tool);
  add_convert(tool, stop ? stop->token() : std::stop_token());
  add_ros(tool, stop ? stop->token() : std::stop_token());
  add_sweep(tool, jobs, stop ? stop->token() : std::stop_token());
  add_replay(tool, jobs);
  add_serve(tool, jobs);
  add_bench(tool);
  add_list(tool, jobs);
  add_schema(tool, jobs);
  add_completion(tool);
  const auto status = tool.run(*words);
  return status ? *status : print_fault(status.error(), wants_json(argc, argv));
}

bool json_wanted = false;
std::terminate_handler usual_end = std::abort;
std::atomic<char*> reserve = nullptr;  ///< memory for cleaning up when there is none left

/// Gives the reserve back when memory ends, so the allocation is tried again; the next one may fail.
void give_reserve_back() {
  if (char* const given = reserve.exchange(nullptr)) {
    delete[] given;
  } else {
    std::set_new_handler(nullptr);
  }
}

/// Reports that memory has ended, without allocating any.
int report_no_memory() {
  const char* const json =
      "{\"status\":\"refused\",\"code\":\"bad_input\",\"reason\":\"there is not enough memory; ask for less, "
      "such as a coarser resolution\",\"where\":\"\"}\n";
  complain_without_memory("there is not enough memory; ask for less, such as a coarser resolution",
                          json_wanted ? json : "");
  return refused;
}

/// Ends a process whose destructors find no memory either.
void terminate() {
  if (reserve != nullptr) usual_end();
  std::_Exit(report_no_memory());
}

/// Runs the tool and reports uncaught exceptions as faults.
int guarded_run(const std::vector<Job>& jobs, int argc, char** argv) {
  const bool json = json_wanted = wants_json(argc, argv);
  try {
    constexpr std::size_t reserve_bytes = std::size_t{1} << 20U;
    reserve = new char[reserve_bytes];
    std::set_new_handler(give_reserve_back);
    usual_end = std::set_terminate(terminate);
    if (const char* root = std::getenv("OUTRIDER_CONFINE"); root != nullptr) {
      if (auto ok = confine_reading(root); !ok) return print_fault(ok.error(), json);
    }
    return run(jobs, argc, argv);
  } catch (const std::bad_alloc&) {
    return report_no_memory();
  } catch (const std::exception& broken) {
    if (std::ferror(stdout) != 0) return job_done;  // run_tool() reports the failed output
    return print_fault({FaultCode::bad_input, fmt::format("this is a bug: {}", broken.what()), {}}, json);
  }
}

}  // namespace

int run_tool(const std::vector<Job>& jobs, int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // hitting the file size limit becomes a fault with a sentence
  const int status = guarded_run(jobs, argc, argv);
  if (std::ferror(stdout) == 0 && std::fflush(stdout) == 0) return status;
  return print_fault({FaultCode::cannot_write, "standard output cannot be written to; is the disk full?", {}},
                     false);
}

}  // namespace outrider::cli
