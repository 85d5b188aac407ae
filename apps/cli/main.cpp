// outrider: a ground robot finds its way, and does a job. See commands.hpp.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "commands.hpp"
#include "output.hpp"
#include "outrider/io/confinement.hpp"

namespace outrider::cli {
namespace {

/// Whether JSON was asked for, for faults that come before the flags are read.
bool wants_json(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--json" || word == "--json=true") return true;
  }
  return false;
}

int run(int argc, char** argv) {
  Command tool("outrider", "A ground robot finds its way, and does a job, in a yard or a building.",
               OUTRIDER_VERSION);
  tool.footer(
      "\n'outrider COMMAND --help' shows the flags of a command.\n"
      "Exit status: 0 the job was done, 1 it was not, 2 the request or an input was wrong,\n"
      "3 an answer could not be written, as on a full disk.");
  add_run(tool);
  add_guard(tool);
  add_pursue(tool);
  add_cover(tool);
  add_explore(tool);
  add_drive(tool);
  add_calibrate(tool);
  add_plan(tool);
  add_slam(tool);
  add_detect(tool);
  add_replay(tool);
  add_serve(tool);
  add_bench(tool);
  add_list(tool);
  add_schema(tool);
  const auto status = tool.run(argc, argv);
  return status ? *status : say(status.error(), wants_json(argc, argv));
}

/// Runs the tool; what nobody caught is said, not dumped.
int guarded_run(int argc, char** argv) {
  const bool json = wants_json(argc, argv);
  try {
    if (const char* root = std::getenv("OUTRIDER_CONFINE"); root != nullptr) {
      if (auto ok = confine_reading(root); !ok) return say(ok.error(), json);
    }
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return say(
        {FaultCode::bad_input, "there is not enough memory; ask for less, such as a coarser resolution", {}},
        json);
  } catch (const std::exception& broken) {
    if (std::ferror(stdout) != 0) return job_done;  // main() says that nothing could be printed
    return say({FaultCode::bad_input, fmt::format("this is a bug: {}", broken.what()), {}}, json);
  }
}

}  // namespace
}  // namespace outrider::cli

int main(int argc, char** argv) {
  using namespace outrider;
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a fault with a sentence
  const int status = cli::guarded_run(argc, argv);
  if (std::ferror(stdout) == 0 && std::fflush(stdout) == 0) return status;
  return cli::say({FaultCode::cannot_write, "standard output cannot be written to; is the disk full?", {}},
                  false);
}
