// The server without sockets: takes a request, returns a response. docs/server.md is the manual of the
// interface; docs/openapi.yaml describes it for machines.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "catalogue.hpp"
#include "files/file_list.hpp"
#include "files/folder.hpp"
#include "files/reading.hpp"
#include "http/guard.hpp"
#include "http/message.hpp"
#include "live/live.hpp"
#include "page.hpp"
#include "planning/planning.hpp"
#include "runs/runs.hpp"

namespace outrider::server {

inline constexpr std::size_t largest_body_bytes = std::size_t{32} << 20U;

struct AppSettings {
  std::string version;
  std::string token;      ///< if empty, loopback only and no token needed
  std::vector<Job> jobs;  ///< jobs that can be run
  std::span<const page::File> files = page::files();
  RunSettings runs;
  ReadFiles read = {};  ///< reads maps and scenarios
};

/// Names the requests that a handler answers. A {name} in the pattern matches one part of the path; {path}
/// matches all that follows.
struct Route {
  std::string method;
  std::string pattern;
};

/// Answers requests. Thread rule: any thread may call.
class App {
 public:
  App(Folder folder, AppSettings settings);

  Response answer(const Request& request);
  /// Returns the refusal of a request before its body has arrived, or nothing; answer() refuses it in the
  /// same way.
  std::optional<Response> refuse(const Request& request);
  /// Returns the refusal of a WebSocket, or nothing.
  std::optional<Response> refuse_socket(const Request& request);
  /// Returns the subprotocol that a WebSocket speaks; empty for that of the page.
  static std::string subprotocol(const Request& request);
  /// Returns the viewer for a WebSocket that is not refused.
  std::shared_ptr<Viewer> open_viewer(const Request& request);
  Live& live() { return live_; }
  Shared& shared() { return shared_; }
  /// Cancels all runs and closes every viewer.
  void close();

  /// Returns the routes of the interface, in the order of docs/server.md.
  static std::vector<Route> routes();

 private:
  using Parts = std::vector<std::string>;  // path parts that match the names in the pattern
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
  Response read_scene(const Request& request, const Parts& parts);
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
  Response run_log(const Request& request, const Parts& parts);
  Response run_result(const Request& request, const Parts& parts);
  Response live_by_http(const Request& request, const Parts& parts);
  Response page_file(const Request& request);
  Outcome<KnownMap> map_of(const Json& request, const std::stop_token& stop);
  Outcome<KnownMap> read_dropped_map(const std::vector<NamedContent>& files, const std::stop_token& stop);
  Outcome<KnownMap> read_known_map(const Folder& folder, const std::string& path,
                                   const std::stop_token& stop);
  std::optional<Response> limit_rate(bool refused);
  std::optional<Response> refused_by_guard(const Request& request);

  Folder folder_;
  AppSettings settings_;
  FileList files_;
  RateLimit rate_;                        // for accepted requests
  RateLimit strangers_;                   // for refused requests, so they do not slow the accepted ones
  std::array<GuessLimit, 1024> guesses_;  // by a hash of the address
  Shared shared_;
  Runs runs_;
  Live live_;
};

}  // namespace outrider::server
