// The server without sockets: a request in, a response out. docs/server.md is the manual of the interface,
// and docs/openapi.yaml says the same to machines.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "catalogue.hpp"
#include "folder.hpp"
#include "guard.hpp"
#include "live.hpp"
#include "message.hpp"
#include "page.hpp"
#include "planning.hpp"
#include "reading.hpp"
#include "runs.hpp"

namespace outrider::server {

inline constexpr std::size_t largest_body_bytes = std::size_t{32} << 20U;

struct AppSettings {
  std::string version;
  std::string token;      ///< empty: loopback only, no token
  std::vector<Job> jobs;  ///< that can be run
  std::span<const page::File> files = page::files();
  RunSettings runs;
  ReadFiles read = {};  ///< reads maps and scenarios
};

/// What a request is answered with: a path with {names} for one part each, or at the end {path...} for all.
struct Route {
  std::string method;
  std::string pattern;
};

/// Thread rule: any thread may call.
class App {
 public:
  App(Folder folder, AppSettings settings);

  Response answer(const Request& request);
  /// The refusal of a request before its body has come, or nothing; answer() gives the same.
  std::optional<Response> refuse(const Request& request);
  /// The refusal of a WebSocket, or nothing.
  std::optional<Response> refuse_socket(const Request& request);
  Live& live() { return live_; }
  Shared& shared() { return shared_; }
  /// Cancels what runs and lets every viewer go.
  void close();

  /// Of the interface, in the order of docs/server.md.
  static std::vector<Route> routes();

 private:
  using Parts = std::vector<std::string>;  // of the path, where the pattern has names
  using Handler = Response (App::*)(const Request&, const Parts&);
  struct Endpoint {
    const char* method;
    const char* pattern;
    Handler handler;
  };
  static std::span<const Endpoint> table();

  Response dispatch(const Request& request);
  Response version(const Request& request, const Parts& parts);
  Response read_scenario(const Request& request, const Parts& parts);
  Response save_scenario(const Request& request, const Parts& parts);
  Response list_files(const Request& request, const Parts& parts);
  Response read_file(const Request& request, const Parts& parts);
  Response save_file(const Request& request, const Parts& parts);
  Response catalogue(const Request& request, const Parts& parts);
  Response read_map(const Request& request, const Parts& parts);
  Response plan(const Request& request, const Parts& parts);
  Response start_run(const Request& request, const Parts& parts);
  Response list_runs(const Request& request, const Parts& parts);
  Response run_state(const Request& request, const Parts& parts);
  Response cancel_run(const Request& request, const Parts& parts);
  Response run_report(const Request& request, const Parts& parts);
  Response live_by_http(const Request& request, const Parts& parts);
  Response page_file(const Request& request);
  Outcome<KnownMap> map_of(const Json& request, const std::stop_token& stop);
  Outcome<KnownMap> read_dropped_map(const std::vector<NamedContent>& files, const std::stop_token& stop);
  Outcome<KnownMap> read_known_map(const Folder& folder, const std::string& path,
                                   const std::stop_token& stop);
  std::optional<Response> limit_rate(bool refused);

  Folder folder_;
  AppSettings settings_;
  RateLimit rate_;       // of those who may ask
  RateLimit strangers_;  // of those who are refused: they take nothing from the others
  Shared shared_;
  Runs runs_;
  Live live_;
};

}  // namespace outrider::server
