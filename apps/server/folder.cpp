#include "folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "head_comment.hpp"
#include "outrider/core/text.hpp"
#include "outrider/io/confinement.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/scenario.hpp"

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_head_bytes = 300;  // the mark of a saved file lies within them

bool good_name(std::string_view name) {
  return !name.empty() && name.size() <= 255 && name[0] != '.' && name.find('\\') == std::string_view::npos &&
         is_printable(name);
}

tl::unexpected<Fault> bad_path(std::string_view path) {
  return bad_input("it is no path under the folder; names stand between slashes and begin with no dot",
                   std::string(path.substr(0, 200)));
}

std::string lower_extension(const fs::path& path) {
  fs::path name = path;
  if (name.extension() == ".gz") name.replace_extension();
  std::string extension = name.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

/// Returns the job that run.json names in its first keys; empty for other JSON.
std::string job_of_result(const std::string& head) {
  if (head.find("\"status\"") == std::string::npos) return {};
  std::size_t at = head.find("\"job\"");
  if (at == std::string::npos) return {};
  at = head.find('"', head.find(':', at));
  if (at == std::string::npos) return {};
  return head.substr(at + 1, head.find('"', at + 1) - at - 1);
}

bool has_key(const std::string& yaml, const std::string& key) {
  return yaml.starts_with(key + ":") || yaml.find("\n" + key + ":") != std::string::npos;
}

/// Returns the Content-Type of a file. Never returns one that a browser would execute.
std::string type_of(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".json" || extension == ".geojson") return "application/json";
  if (extension == ".png") return "image/png";
  if (extension == ".pgm") return "image/x-portable-graymap";
  if (extension == ".jpg" || extension == ".jpeg") return "image/jpeg";
  for (const char* text :
       {".yaml", ".yml", ".txt", ".csv", ".map", ".sdf", ".world", ".md", ".svg", ".obj"}) {
    if (extension == text) return "text/plain; charset=utf-8";
  }
  return "application/octet-stream";
}

Response not_saved(const Fault& fault, const std::string& where) {
  if (fault.code == FaultCode::cannot_write) return error_response(fault);
  return error_response(403, "forbidden", fault.sentence, where);
}

}  // namespace

bool is_saved_here(std::string_view content) {
  return content.substr(0, most_head_bytes).find(saved_here) != std::string_view::npos;
}

std::string without_folder(std::string sentence, const fs::path& folder) {
  const std::string prefix = folder.string() + "/";
  for (std::size_t at = sentence.find(prefix); at != std::string::npos; at = sentence.find(prefix)) {
    sentence.erase(at, prefix.size());
  }
  return sentence;
}

Fault without_folder(Fault fault, const fs::path& folder) {
  return {fault.code, without_folder(std::move(fault.sentence), folder),
          without_folder(std::move(fault.where), folder)};
}

Outcome<Folder> Folder::open(const std::string& path) {
  std::error_code error;
  const fs::path root = fs::canonical(path, error);
  if (error || !fs::is_directory(root)) {
    return bad_input(fmt::format("'{}' is no folder that can be read; name one with scenarios", path), "DIR");
  }
  const int descriptor = ::open(root.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return bad_input(fmt::format("the folder '{}' cannot be opened", path), "DIR");
  return Folder(root, descriptor);
}

Folder::Folder(fs::path root, int descriptor)
    : root_(std::move(root)), descriptor_(new int(descriptor), [](const int* opened) {
        ::close(*opened);
        delete opened;
      }) {}

std::shared_ptr<const OpenFile> Folder::open_file(std::string_view path) const {
  for (std::string_view rest = path; !rest.empty();) {
    const std::string_view name = rest.substr(0, rest.find('/'));
    if (!good_name(name)) return nullptr;
    rest.remove_prefix(std::min(rest.size(), name.size() + 1));
  }
  const Outcome<int> descriptor =
      path.empty() ? Outcome<int>(bad_input("")) : open_beneath(*descriptor_, std::string(path));
  struct stat status{};
  if (!descriptor || ::fstat(*descriptor, &status) != 0) return nullptr;
  return std::make_shared<const OpenFile>(*descriptor, static_cast<std::uintmax_t>(status.st_size));
}

std::string Folder::first_bytes(std::string_view path, std::size_t count) const {
  const auto file = open_file(path);
  return file ? file->part(0, count) : std::string{};
}

Outcome<std::string> Folder::text(std::string_view path, std::size_t most_bytes) const {
  const std::string where(path.substr(0, 200));
  const auto file = open_file(path);
  if (!file) return bad_input("there is no such file", where);
  if (file->bytes() > most_bytes)
    return bad_input(fmt::format("it has more than {} bytes", most_bytes), where);
  return file->part(0, file->bytes());
}

Folder::Kind Folder::kind_of(const std::string& path) const {
  const std::string extension = lower_extension(path);
  if (extension == ".mcap") return {"log"};
  if (fs::path(path).filename() == "run.json") {
    std::string job = job_of_result(first_bytes(path, 400));
    return {job.empty() ? "other" : "result", job};
  }
  if (extension == ".yaml" || extension == ".yml") {
    const std::string head = first_bytes(path, 4000);
    if (has_key(head, "image")) return {"map"};
    const auto content = text(path, largest_saved_bytes);
    const auto job = content ? scenario_job_from_text(*content, path) : Outcome<std::string>("");
    return job && !job->empty() ? Kind{"scenario", *job, head_comment(*content)} : Kind{"other"};
  }
  for (const char* map : {".map", ".sdf", ".world", ".png", ".pgm"}) {
    if (extension == map) return {"map"};
  }
  const bool polygons = extension == ".txt" && first_bytes(path, 65536).find("---") != std::string::npos;
  return {polygons ? "map" : "other"};
}

bool Folder::holds(const fs::path& place) const {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(place, error);
  if (error) return false;
  const auto [end, rest] = std::mismatch(root_.begin(), root_.end(), real.begin(), real.end());
  return end == root_.end();
}

Outcome<fs::path> Folder::resolve(std::string_view path) const {
  fs::path place = root_;
  std::string_view rest = path;
  for (bool more = true; more;) {
    const std::size_t slash = rest.find('/');
    more = slash != std::string_view::npos;
    const std::string_view name = rest.substr(0, slash);
    if (!good_name(name)) return bad_path(path);
    place /= name;
    if (more) rest.remove_prefix(slash + 1);
  }
  if (!holds(place)) return bad_path(path);
  std::error_code error;
  return fs::weakly_canonical(place, error);
}

nlohmann::ordered_json Folder::list() const {
  std::vector<std::pair<std::string, fs::path>> found;
  bool truncated = false;
  std::error_code error;
  fs::recursive_directory_iterator it(root_, fs::directory_options::skip_permission_denied, error);
  for (const fs::recursive_directory_iterator end; !error && it != end; it.increment(error)) {
    const fs::path& path = it->path();
    if (!good_name(path.filename().string()) || it.depth() >= deepest_folder) {
      it.disable_recursion_pending();
      continue;
    }
    if (!it->is_regular_file(error) || (it->is_symlink(error) && !holds(path))) continue;
    if (found.size() == most_listed_files) {
      truncated = true;
      break;
    }
    found.emplace_back(path.lexically_relative(root_).generic_string(), path);
  }
  std::sort(found.begin(), found.end());
  auto files = nlohmann::ordered_json::array();
  for (const auto& [name, path] : found) {
    const Kind kind = kind_of(name);
    nlohmann::ordered_json file = {{"path", name}, {"kind", kind.name}};
    if (!kind.job.empty()) file["job"] = kind.job;
    if (!kind.description.empty()) file["description"] = kind.description;
    const std::uintmax_t bytes = fs::file_size(path, error);
    file["bytes"] = error ? 0 : bytes;
    files.push_back(std::move(file));
  }
  return {{"folder", name()}, {"files", std::move(files)}, {"truncated", truncated}};
}

Response Folder::read(std::string_view path) const {
  auto file = open_file(path);
  if (!file) return not_found("there is no such file", std::string(path.substr(0, 200)));
  if (file->bytes() > largest_served_bytes && !path.ends_with(".mcap")) {
    return error_response(413, "too_large",
                          fmt::format("the file is larger than {} MiB", largest_served_bytes >> 20U),
                          std::string(path.substr(0, 200)));
  }
  return {200, type_of(path), {}, {}, std::move(file)};
}

Response Folder::save(std::string_view path, std::string_view text, bool only_new) const {
  const auto place = resolve(path);
  if (!place) return error_response(place.error());
  const std::string where(path.substr(0, 200));
  if (place->extension() != ".yaml" || !path.ends_with(".yaml")) {
    return error_response(403, "forbidden", "only scenarios are saved; give it a name that ends in .yaml",
                          where);
  }
  if (text.size() > largest_saved_bytes) {
    return error_response(413, "too_large", "a scenario has at most 1 MiB", where);
  }
  std::error_code error;
  if (!fs::is_directory(place->parent_path(), error)) return not_found("there is no such folder", where);
  const bool there = fs::exists(*place, error);
  if (there && only_new) {
    return error_response(412, "precondition_failed", "there is a file of that name; choose another", where);
  }
  if (auto ok = write_file(place->string(), text); !ok) return not_saved(ok.error(), where);
  return json_response({{"path", path}, {"bytes", text.size()}}, there ? 200 : 201);
}

Response Folder::save_scenario(std::string_view path, const std::vector<NamedContent>& files,
                               bool only_new) const {
  std::vector<NamedContent> placed;
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  bool there = false;
  for (const auto& [name, content] : files) {
    const auto place = resolve(name);
    if (!place) return error_response(place.error());
    std::error_code error;
    if (!fs::is_directory(place->parent_path(), error)) return not_found("there is no such folder", name);
    if (*place != root_ / name || fs::is_symlink(*place, error)) {
      return error_response(403, "forbidden", "a link is on the way; scenarios are saved without any", name);
    }
    there = fs::exists(*place, error);
    if (there && only_new) {
      return error_response(412, "precondition_failed", "there is a file of that name; choose another", name);
    }
    if (there && !is_saved_here(first_bytes(name, most_head_bytes))) {
      return error_response(403, "forbidden",
                            "this file was not saved here, so it stays; choose another name", name);
    }
    placed.push_back({place->string(), content});
    names.push_back(name);
  }
  if (auto ok = write_files(placed); !ok) {
    return not_saved(without_folder(ok.error(), root_), std::string(path.substr(0, 200)));
  }
  return json_response({{"path", path}, {"files", std::move(names)}}, there ? 200 : 201);
}

}  // namespace outrider::server
