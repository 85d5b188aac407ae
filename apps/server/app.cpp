#include "app.hpp"

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <thread>

#include "files/temporary_folder.hpp"
#include "http/compression.hpp"
#include "http/gunzip.hpp"
#include "live/foxglove.hpp"
#include "outrider/core/base64.hpp"
#include "scenarios/scenarios.hpp"

namespace outrider::server {
namespace {

constexpr double requests_per_second = 500.0;
constexpr double requests_at_once = 2000.0;
constexpr double refusals_per_second = 100.0;
constexpr double refusals_at_once = 400.0;
constexpr std::size_t most_plans_waiting = 16;
constexpr std::string_view live_path = "/api/v1/live";
constexpr std::string_view page_policy =
    "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "connect-src 'self'; worker-src 'self' blob:; object-src 'none'; frame-ancestors 'none'; "
    "base-uri 'none'; form-action 'none'";
constexpr std::string_view data_policy = "default-src 'none'; frame-ancestors 'none'; sandbox";

std::size_t planning_slots() { return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 64); }

/// Decodes the files of a request about a map.
Outcome<std::vector<NamedContent>> files_of(const Json& list) {
  std::vector<NamedContent> files;
  if (list.empty() || list.size() > 8) return bad_input("expected 1 to 8 files", "files");
  for (std::size_t i = 0; i < list.size(); ++i) {
    Fields fields(list[i], "files[" + std::to_string(i) + "]");
    std::string name = fields.text("name");
    auto bytes = base64_decoded(fields.text("base64"));
    if (!bytes) fields.refuse("base64", "this is no base64");
    if (auto ok = fields.end(); !ok) return pass_on(ok);
    files.push_back({std::move(name), std::move(*bytes)});
  }
  return files;
}

bool is_image(const std::string& name) {
  std::string plain = name;
  if (plain.ends_with(".gz")) plain.resize(plain.size() - 3);
  return plain.ends_with(".png") || plain.ends_with(".pgm");
}

Response wait_a_second(const std::string& why) {
  Response response = error_response(429, "too_many", why + "; wait a second");
  response.headers.emplace_back("Retry-After", "1");
  return response;
}

void add_headers(Response& response, std::string_view policy, std::string_view cache) {
  response.headers.emplace_back("Content-Security-Policy", policy);
  response.headers.emplace_back("X-Content-Type-Options", "nosniff");
  response.headers.emplace_back("Referrer-Policy", "no-referrer");
  response.headers.emplace_back("Cross-Origin-Resource-Policy", "same-origin");
  response.headers.emplace_back("Cache-Control", cache);
}

}  // namespace

App::App(Folder folder, AppSettings settings)
    : folder_(std::move(folder)),
      settings_(std::move(settings)),
      files_(folder_, settings_.read),
      rate_(requests_per_second, requests_at_once),
      strangers_(refusals_per_second, refusals_at_once),
      shared_(planning_slots()),
      runs_(folder_, settings_.runs, settings_.read),
      live_(runs_, shared_, settings_.version) {}

void App::close() {
  live_.close();
  runs_.cancel_all();
}

std::span<const App::Endpoint> App::table() {
  static constexpr Endpoint rows[] = {
      {"GET", "/api/v1/version", &App::version},
      {"GET", "/api/v1/files", &App::list_files},
      {"GET", "/api/v1/files/{path}", &App::read_file},
      {"PUT", "/api/v1/files/{path}", &App::save_file},
      {"GET", "/api/v1/scenarios/{path}", &App::read_scenario},
      {"PUT", "/api/v1/scenarios/{path}", &App::save_scenario},
      {"GET", "/api/v1/scenes/{path}", &App::read_scene},
      {"GET", "/api/v1/catalogue", &App::catalogue},
      {"POST", "/api/v1/maps", &App::read_map},
      {"POST", "/api/v1/plan", &App::plan},
      {"POST", "/api/v1/runs", &App::start_run},
      {"GET", "/api/v1/runs", &App::list_runs},
      {"GET", "/api/v1/runs/{id}", &App::run_state},
      {"DELETE", "/api/v1/runs/{id}", &App::cancel_run},
      {"GET", "/api/v1/runs/{id}/log", &App::run_log},
      {"GET", "/api/v1/runs/{id}/result", &App::run_result},
      {"GET", "/api/v1/live", &App::live_by_http},
  };
  return rows;
}

std::vector<Route> App::routes() {
  std::vector<Route> routes;
  for (const Endpoint& row : table()) routes.push_back({row.method, row.pattern});
  return routes;
}

/// Limits refused requests separately, so that a flood of them does not affect the others.
std::optional<Response> App::limit_rate(bool refused) {
  if ((refused ? strangers_ : rate_).take(RateLimit::Clock::now())) return std::nullopt;
  return wait_a_second("too many requests");
}

/// Applies the guard. Once an address has shown many wrong tokens, no token of it is looked at for a while,
/// the right one neither: else every guess would have its answer.
std::optional<Response> App::refused_by_guard(const Request& request) {
  GuessLimit& guesses = guesses_[std::hash<std::string>()(request.client) % guesses_.size()];
  const bool guess = !settings_.token.empty() && !token_shown(request).empty();
  const auto now = RateLimit::Clock::now();
  if (guess && !guesses.take(now, 0.0)) return wait_a_second("too many wrong tokens came from this address");
  auto refused = refusal(request, settings_.token);
  if (guess && refused && refused->status == 401) guesses.take(now);
  return refused;
}

std::optional<Response> App::refuse_socket(const Request& request) {
  std::optional<Response> refused = refused_by_guard(request);
  if (auto limited = limit_rate(refused.has_value())) return limited;
  if (refused || request.path == live_path) return refused;
  if (request.path != "/" && request.path != "/foxglove") {
    return not_found(
        "there is no WebSocket here; the page opens /api/v1/live, and Foxglove opens / or /foxglove");
  }
  if (subprotocol(request).empty()) {
    return error_response(400, "bad_input", "expected foxglove.websocket.v1 or foxglove.sdk.v1",
                          "Sec-WebSocket-Protocol");
  }
  const std::string run = request.parameter("run");
  if (const auto known = runs_.next(run, 0); !run.empty() && !known)
    return not_found(known.error().sentence, run.substr(0, 64));
  return std::nullopt;
}

std::string App::subprotocol(const Request& request) {
  if (request.path == live_path) return {};
  return foxglove::subprotocol_of(request.header("sec-websocket-protocol"));
}

std::shared_ptr<Viewer> App::open_viewer(const Request& request) {
  return request.path == live_path ? live_.open() : live_.open_foxglove(request.parameter("run"));
}

std::optional<Response> App::refuse(const Request& request) {
  auto refused = refused_by_guard(request);
  if (!refused) return std::nullopt;
  if (auto limited = limit_rate(true)) refused = std::move(limited);
  add_headers(*refused, data_policy, "no-store");
  return refused;
}

Response App::answer(const Request& request) {
  if (auto refused = refuse(request)) return std::move(*refused);
  if (auto limited = limit_rate(false)) return std::move(*limited);
  Response response;
  const bool api = request.path == "/api" || request.path.starts_with("/api/");
  try {
    response = api ? dispatch(request) : page_file(request);
    apply_range(request, response);
    compress(request, response, shared_.answers);
  } catch (const std::bad_alloc&) {
    response = error_response(503, "too_large", "there is not enough memory for that; ask for less");
  } catch (const std::exception& broken) {
    response = error_response(500, "internal", std::string("this is a bug: ") + broken.what());
  }
  if (api || response.status != 200) add_headers(response, data_policy, "no-store");
  return response;
}

Response App::dispatch(const Request& request) {
  if (request.body.size() > largest_body_bytes) {
    return error_response(413, "too_large", "a request has at most 32 MiB");
  }
  const auto values = shared_.values.take(memory_of_json(request.body));
  if (!values) return error_response(503, "too_many", "too much is being asked at the same time; ask again");
  const auto path = path_parts(request.path);
  if (!path) return error_response(path.error());
  std::string allowed;
  const std::string method = request.method == "HEAD" ? "GET" : request.method;
  for (const Endpoint& row : table()) {
    const auto parts = match_path(row.pattern, *path);
    if (!parts) continue;
    if (row.method == method) return (this->*row.handler)(request, *parts);
    allowed += (allowed.empty() ? "" : ", ") + std::string(row.method);
  }
  if (allowed.empty()) return not_found("there is nothing here; docs/server.md lists what there is");
  Response response =
      error_response(405, "method_not_allowed", "expected " + allowed, request.method.substr(0, 16));
  response.headers.emplace_back("Allow", allowed);
  return response;
}

Response App::version(const Request&, const Parts&) {
  return json_response({{"name", "outrider"}, {"version", settings_.version}, {"api", 1}});
}

/// Lists the files. A scenario of an unknown job is listed as an ordinary file; one without a description has
/// that of its job.
Response App::list_files(const Request& request, const Parts&) {
  auto listed = files_.list(request.stop);
  if (!listed) return error_response(listed.error());
  for (auto& file : (*listed)["files"]) {
    if (file["kind"] != "scenario") continue;
    const auto job = std::ranges::find(settings_.jobs, file.value("job", ""), &Job::name);
    const bool known = job != settings_.jobs.end();
    if (!known) file["kind"] = "other";
    if (!known) file.erase("description");
    if (known && !file.contains("description")) file["description"] = job->sentence;
  }
  return json_response(*listed);
}

Response App::read_file(const Request&, const Parts& parts) { return folder_.read(parts[0]); }

Response App::save_file(const Request& request, const Parts& parts) {
  return folder_.save(parts[0], request.body, request.header("if-none-match") == "*");
}

Response App::read_scenario(const Request& request, const Parts& parts) {
  if (!folder_.has_file(parts[0])) {
    return not_found("there is no such scenario", parts[0].substr(0, 200));
  }
  auto scenario = settings_.read(folder_, {{"scenario", parts[0]}}, request.stop);
  if (scenario) scenario = with_kept_map(std::move(*scenario), shared_.planning.maps);
  return scenario ? json_response(*scenario) : error_response(scenario.error());
}

Response App::read_scene(const Request& request, const Parts& parts) {
  if (!folder_.has_file(parts[0])) {
    return not_found("there is no such scenario", parts[0].substr(0, 200));
  }
  const auto scene = settings_.read(folder_, {{"scene", parts[0]}}, request.stop);
  return scene ? json_response(*scene) : error_response(scene.error());
}

Response App::save_scenario(const Request& request, const Parts& parts) {
  const auto body = parse_json(request.body, "body");
  if (!body) return error_response(body.error());
  const auto files = scenario_files(parts[0], *body, folder_, shared_.planning, settings_.read, request.stop);
  if (!files) return error_response(files.error());
  return folder_.save_scenario(parts[0], *files, request.header("if-none-match") == "*");
}

Response App::catalogue(const Request&, const Parts&) {
  return json_response(catalogue_json(settings_.jobs));
}

Outcome<KnownMap> App::read_known_map(const Folder& folder, const std::string& path,
                                      const std::stop_token& stop) {
  const auto read = settings_.read(folder, {{"map", path}}, stop);
  return read ? unpacked(*read) : Outcome<KnownMap>(pass_on(read));
}

/// Reads a map from uploaded files; the first one that is not an image is the map.
Outcome<KnownMap> App::read_dropped_map(const std::vector<NamedContent>& files, const std::stop_token& stop) {
  auto home = TemporaryFolder::make();
  if (!home) return pass_on(home);
  auto folder = Folder::open(home->path().string());
  if (!folder) return pass_on(folder);
  std::string map;
  for (const auto& [name, bytes] : files) {
    if (!good_name(name) || name.find('/') != std::string::npos)
      return bad_input("it is no name of a file", name);
    if (auto ok = folder->gate().write({{name, bytes}}); !ok) return pass_on(ok);
    if (map.empty() || (is_image(map) && !is_image(name))) map = name;
  }
  return read_known_map(*folder, map, stop);
}

/// Returns the map of a JSON request: from the folder, from uploaded files, or drawn.
Outcome<KnownMap> App::map_of(const Json& request, const std::stop_token& stop) {
  Fields fields(request, "");
  const bool path = fields.has("path"), files = fields.has("files"), grid = fields.has("grid");
  if (path + files + grid + fields.has("polygons") != 1) {
    return bad_input("give one of path, files, grid and polygons", "");
  }
  const std::string name = path ? fields.text("path") : "";
  const Json* sent = fields.list("files");
  const Json* shape = path || files ? nullptr : fields.object(grid ? "grid" : "polygons");
  if (auto ok = fields.end(); !ok) return pass_on(ok);
  if (grid) return grid_map_from_json(*shape, "grid");
  if (shape != nullptr) return polygon_map_from_json(*shape, "polygons");
  if (path) return read_known_map(folder_, name, stop);
  auto named = files_of(*sent);
  if (!named) return pass_on(named);
  return read_dropped_map(*named, stop);
}

Response App::read_map(const Request& request, const Parts&) {
  Outcome<KnownMap> map = bad_input("");
  if (request.header("content-type").starts_with("application/json")) {
    const auto body = parse_json(request.body, "body");
    if (!body) return error_response(body.error());
    map = map_of(*body, request.stop);
  } else {
    const std::string name = request.parameter("name");
    if (name.empty())
      return error_response(400, "bad_input", "name the file, as in /api/v1/maps?name=room.map", "name");
    map = read_dropped_map({{name, request.body}}, request.stop);
  }
  if (!map) return error_response(map.error());
  return json_response(map_json(*shared_.planning.maps.keep(std::move(*map))));
}

Response App::plan(const Request& request, const Parts&) {
  const auto body = parse_json(request.body, "body");
  if (!body) return error_response(body.error());
  auto place = shared_.workspaces.take(nullptr, longest_planning, most_plans_waiting, request.stop);
  if (!place) return error_response(503, "too_many", "other plans are being made; ask again");
  const auto plan = answer_plan(*body, shared_.planning, place->workspace(), request.stop);
  return plan ? json_response(*plan) : error_response(plan.error());
}

Response App::start_run(const Request& request, const Parts&) {
  const auto body = parse_json(request.body, "body");
  if (!body) return error_response(body.error());
  const auto run = run_request(*body);
  return run ? runs_.start(*run, request.stop) : error_response(run.error());
}

Response App::list_runs(const Request&, const Parts&) { return json_response(runs_.list()); }

Response App::run_state(const Request&, const Parts& parts) { return runs_.state(parts[0]); }

Response App::cancel_run(const Request&, const Parts& parts) { return runs_.cancel(parts[0]); }

Response App::run_log(const Request&, const Parts& parts) { return runs_.log(parts[0]); }

Response App::run_result(const Request&, const Parts& parts) { return runs_.result(parts[0]); }

Response App::live_by_http(const Request&, const Parts&) {
  return error_response(400, "bad_input", "this is a WebSocket; open it as one");
}

Response App::page_file(const Request& request) {
  if (request.method != "GET" && request.method != "HEAD") {
    return error_response(405, "method_not_allowed", "expected GET", request.method.substr(0, 16));
  }
  if (settings_.files.empty()) return error_response(503, "no_page", std::string(page::missing));
  // A path without a dot is a view of the page, which index.html shows.
  const bool place = request.path.find('.') == std::string::npos;
  const std::string path = place ? "index.html" : request.path.substr(1);
  const auto found = std::find_if(settings_.files.begin(), settings_.files.end(),
                                  [&](const page::File& file) { return file.path == path; });
  if (found == settings_.files.end()) return not_found("the page has no such file", path.substr(0, 200));
  Response response{200, std::string(found->type), {}, {}};
  if (accepts_gzip(request.header("accept-encoding"))) {
    response.body = found->gzip;
    response.headers.emplace_back("Content-Encoding", "gzip");
  } else {
    response.body = gunzipped(found->gzip);
  }
  response.headers.emplace_back("Vary", "Accept-Encoding");
  const bool hashed = path.starts_with("assets/");
  add_headers(response, page_policy, hashed ? "public, max-age=31536000, immutable" : "no-cache");
  return response;
}

}  // namespace outrider::server
