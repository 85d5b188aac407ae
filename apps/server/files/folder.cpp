#include "files/folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "outrider/core/text.hpp"

namespace outrider::server {
namespace {

constexpr std::size_t most_head_bytes = 300;  // the mark of a saved file lies within them

/// Returns the Content-Type of a file. Never returns one that a browser would execute.
std::string type_of(const std::filesystem::path& path) {
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

}  // namespace

bool is_saved_here(std::string_view content) {
  return content.substr(0, most_head_bytes).find(saved_here) != std::string_view::npos;
}

bool good_name(std::string_view name) {
  return !name.empty() && name.size() <= 255 && name[0] != '.' && name.find('\\') == std::string_view::npos &&
         is_printable(name);
}

Outcome<std::string> checked_path(std::string_view path) {
  std::string_view rest = path;
  for (bool more = true; more;) {
    const std::string_view name = rest.substr(0, rest.find('/'));
    more = name.size() < rest.size();
    if (!good_name(name)) {
      return bad_input("it is no path under the folder; names stand between slashes and begin with no dot",
                       std::string(path.substr(0, 200)));
    }
    if (more) rest.remove_prefix(name.size() + 1);
  }
  return std::string(path);
}

Outcome<Folder> Folder::open(const std::string& path) {
  auto gate = OpenFolder::open(path);
  if (!gate) {
    return bad_input(fmt::format("'{}' is no folder that can be read; name one with scenarios", path), "DIR");
  }
  std::error_code error;
  const auto link = fmt::format("/proc/self/fd/{}", gate->descriptor());
  return Folder(std::move(*gate), std::filesystem::read_symlink(link, error).string());
}

std::shared_ptr<const OpenFile> Folder::open_file(std::string_view path) const {
  const auto good = checked_path(path);
  return good ? OpenFile::in(gate_, *good) : nullptr;
}

Outcome<std::string> Folder::text(std::string_view path, std::size_t most_bytes) const {
  const std::string where(path.substr(0, 200));
  const auto file = open_file(path);
  if (!file) return bad_input("there is no such file", where);
  if (file->bytes() > most_bytes)
    return bad_input(fmt::format("it has more than {} bytes", most_bytes), where);
  return file->part(0, file->bytes());
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

/// Writes files of one folder, or returns the refusal. `replaces` says whether the last one was there.
std::optional<Response> Folder::write(const std::vector<NamedContent>& files, bool only_new,
                                      bool only_saved_here, bool& replaces) const {
  const std::string& path = files.back().path;
  const auto good = checked_path(path);
  if (!good) return error_response(good.error());
  const std::string above = path.substr(0, path.find_last_of('/') + 1);
  const auto folder = gate_.folder(above);
  if (!folder) return not_found("there is no such folder", path);
  std::vector<NamedContent> named;
  for (const auto& [file, content] : files) {
    const std::string name = file.substr(above.size());
    const auto there = folder->status(name);
    const auto refused = [&](int status, const char* code, const char* why) {
      return error_response(status, code, why, file);
    };
    if (there && !there->is_file)
      return refused(403, "forbidden", "a link or a folder is there; choose another name");
    if (there && only_new)
      return refused(412, "precondition_failed", "there is a file of that name; choose another");
    const auto old = only_saved_here && there ? OpenFile::in(*folder, name) : nullptr;
    if (old && !is_saved_here(old->part(0, most_head_bytes)))
      return refused(403, "forbidden", "this file was not saved here, so it stays; choose another name");
    replaces = there.has_value();
    named.push_back({name, content});
  }
  const Status ok = folder->write(named);
  if (ok) return std::nullopt;
  if (ok.error().code == FaultCode::cannot_write) return error_response(ok.error());
  return error_response(403, "forbidden", ok.error().sentence, path);
}

Response Folder::save(std::string_view path, std::string_view text, bool only_new) const {
  const std::string where(path.substr(0, 200));
  if (!path.ends_with(".yaml")) {
    return error_response(403, "forbidden", "only scenarios are saved; give it a name that ends in .yaml",
                          where);
  }
  if (text.size() > largest_saved_bytes) {
    return error_response(413, "too_large", "a scenario has at most 1 MiB", where);
  }
  bool replaces = false;
  auto refused = write({{std::string(path), std::string(text)}}, only_new, false, replaces);
  if (refused) return std::move(*refused);
  return json_response({{"path", path}, {"bytes", text.size()}}, replaces ? 200 : 201);
}

Response Folder::save_scenario(std::string_view path, const std::vector<NamedContent>& files,
                               bool only_new) const {
  bool replaces = false;
  auto refused = write(files, only_new, true, replaces);
  if (refused) return std::move(*refused);
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  for (const NamedContent& file : files) names.push_back(file.path);
  return json_response({{"path", path}, {"files", std::move(names)}}, replaces ? 200 : 201);
}

}  // namespace outrider::server
