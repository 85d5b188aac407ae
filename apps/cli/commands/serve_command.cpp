#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "app.hpp"
#include "commands/commands.hpp"
#include "files/reading.hpp"
#include "files/temporary_folder.hpp"
#include "flags.hpp"
#include "http/web_server.hpp"
#include "output/output.hpp"
#include "output/terminal.hpp"
#include "outrider/core/text.hpp"
#include "outrider/io/files/files.hpp"

namespace outrider::cli {
namespace {

struct ServeCommand {
  std::string folder = ".";
  std::int64_t port = 8080;
  std::string listen = "127.0.0.1";
  std::string token;
  std::string token_file;
  std::int64_t jobs = 2;
  std::int64_t memory_mib = 4096;
};

OptionGroup describe(ServeCommand& command) {
  return {"",
          "serve",
          {{"port", "", 0, 65535, "port to listen at; 0: one that is free", &command.port},
           {"listen", "", 0, 0, "address to listen at; another than loopback needs --token", &command.listen},
           {"token", "", 0, 0,
            "what every request must show; 16 letters or more; other users of the machine can see it",
            &command.token},
           {"token_file", "", 0, 0, "file with the token in its first line; or set OUTRIDER_TOKEN",
            &command.token_file},
           {"jobs", "", 1, 64, "missions that run at the same time; others wait", &command.jobs},
           {"memory", "MiB", 64, 1e6, "most that one mission may take", &command.memory_mib}}};
}

constexpr std::size_t shortest_token = 16;

/// Refuses a file from which others could learn the token.
Status check_token_file(const ServeCommand& command) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto others = fs::perms::group_all | fs::perms::others_all;
  if ((fs::status(command.token_file, error).permissions() & others) != fs::perms::none) {
    return bad_input(
        fmt::format("others can read or change it; say 'chmod 600 {}' first", command.token_file),
        "--token-file");
  }
  const fs::path file = fs::canonical(command.token_file, error);
  const fs::path folder = error ? fs::path() : fs::canonical(command.folder, error);
  if (error || std::ranges::mismatch(folder, file).in1 != folder.end()) return {};
  return bad_input("it lies in the folder that is served; move it elsewhere", "--token-file");
}

/// Reads the token from the flag, the file, or the variable; refuses more than one of them.
Status find_token(ServeCommand& command) {
  const char* variable = std::getenv("OUTRIDER_TOKEN");
  const std::string from_variable = variable == nullptr ? "" : variable;
  if (!command.token.empty() + !command.token_file.empty() + !from_variable.empty() > 1) {
    return bad_input("there is more than one token; give one of --token, --token-file and OUTRIDER_TOKEN",
                     "--token");
  }
  if (!from_variable.empty()) command.token = from_variable;
  if (command.token_file.empty()) return {};
  auto text = read_file(command.token_file, 4096);
  if (!text) return bad_input(text.error().sentence, "--token-file");
  if (auto ok = check_token_file(command); !ok) return ok;
  command.token = text->substr(0, text->find_first_of("\r\n"));
  if (command.token.empty())
    return bad_input("its first line is empty; write the token there", "--token-file");
  return {};
}

Status check_token(const ServeCommand& command) {
  const auto plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
  };
  if (command.token.empty()) {
    if (server::is_loopback(command.listen)) return {};
    return bad_input(
        fmt::format("{} can be reached from other machines; give --token with 16 letters or more, as "
                    "'openssl rand -hex 16' prints",
                    excerpt(command.listen)),
        "--listen");
  }
  if (command.token.size() >= shortest_token &&
      std::all_of(command.token.begin(), command.token.end(), plain)) {
    return {};
  }
  return bad_input("expected 16 or more of the letters a-z, A-Z, 0-9, - and _", "--token");
}

/// Returns the path of this program, which runs the missions.
std::string own_path() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).string();
}

void print_address(const ServeCommand& command, int port, const server::Folder& folder) {
  const bool six = command.listen.find(':') != std::string::npos;
  const std::string host = six ? "[" + command.listen + "]" : command.listen;
  const std::string query = command.token.empty() ? "" : "?token=" + command.token;
  show("  page     http://{}:{}/{}\n  files    {}\n  Ctrl-C ends it.\n", host, port, query, folder.path());
  std::fflush(stdout);
  if (page::files().empty()) {
    warn(fmt::format("{}; the interface under /api/v1 works", page::missing));
  }
}

int execute(ServeCommand& command, const std::vector<Job>& jobs, const Command& flags) {
  if (auto ok = apply_flags(flags, {describe(command)}); !ok) return print_fault(ok.error(), false);
  if (auto ok = find_token(command); !ok) return print_fault(ok.error(), false);
  if (auto ok = check_token(command); !ok) return print_fault(ok.error(), false);
  auto folder = server::Folder::open(command.folder);
  if (!folder) return print_fault(folder.error(), false);

  sigset_t ends;  // signals that end the server; this thread waits for them
  ::sigemptyset(&ends);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&ends, number);
  ::pthread_sigmask(SIG_BLOCK, &ends, nullptr);

  server::AppSettings settings;
  settings.version = OUTRIDER_VERSION;
  settings.token = command.token;
  settings.jobs = jobs;
  settings.runs.tool = own_path();
  settings.runs.at_once = static_cast<std::size_t>(command.jobs);
  settings.runs.memory_bytes = static_cast<std::size_t>(command.memory_mib) << 20U;
  settings.read = server::reading_in_a_child({.tool = settings.runs.tool});
  server::TemporaryFolder::remove_abandoned();
  server::App app(*folder, std::move(settings));
  auto web = server::WebServer::start(app, {command.listen, static_cast<int>(command.port)});
  if (!web) return print_fault(web.error(), false);
  print_address(command, (*web)->port(), *folder);
  int number = 0;
  ::sigwait(&ends, &number);
  return job_done;
}

}  // namespace

void add_serve(Command& tool, const std::vector<Job>& jobs) {
  Command& serve = tool.add("serve", "the page: watch, try, and run missions live, in a browser");
  auto command = std::make_shared<ServeCommand>();
  serve.positional("folder", &command->folder, "folder with scenarios, maps and reports [.]").type("DIR");
  add_flags(serve, {describe(*command)});
  serve.does([command, jobs](const Command& flags) { return execute(*command, jobs, flags); });
  serve.footer("\nExample: outrider serve scenarios");

  Command& reader = tool.add("serve-reader", "reads files for 'outrider serve'").hidden();
  reader.does([jobs](const Command&) { return server::serve_reader(jobs); });
}

}  // namespace outrider::cli
