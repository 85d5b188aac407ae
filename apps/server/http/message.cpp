#include "http/message.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <nlohmann/json.hpp>

namespace outrider::server {

OpenFile::~OpenFile() { ::close(descriptor_); }

std::shared_ptr<const OpenFile> OpenFile::in(const OpenFolder& folder, const std::string& path) {
  const auto descriptor = folder.open_file(path);
  struct stat status{};
  if (!descriptor) return nullptr;
  (void)::fstat(*descriptor, &status);
  return std::make_shared<const OpenFile>(*descriptor, static_cast<std::uintmax_t>(status.st_size));
}

std::string OpenFile::part(std::uintmax_t offset, std::size_t most) const {
  std::string bytes(most, '\0');
  std::size_t count = 0;
  while (count < most) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data() + count, most - count, static_cast<off_t>(offset + count));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    count += static_cast<std::size_t>(got);
  }
  bytes.resize(count);
  return bytes;
}

std::string Request::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? std::string{} : found->second;
}

std::string Request::parameter(std::string_view key) const {
  std::string_view rest = query;
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos || pair.substr(0, equals) != key) continue;
    return percent_decoded(pair.substr(equals + 1)).value_or(std::string{});
  }
  return {};
}

Outcome<std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    unsigned value = 0;
    const std::string_view digits = text.substr(i + 1, 2);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (digits.size() != 2 || error != std::errc{} || end != digits.data() + 2) {
      return bad_input("a percent sign stands before two hexadecimal digits, such as %20", "path");
    }
    decoded += static_cast<char>(value);
    i += 2;
  }
  return decoded;
}

Outcome<std::vector<std::string>> path_parts(std::string_view path) {
  std::vector<std::string> parts;
  path.remove_prefix(std::min<std::size_t>(1, path.size()));
  for (bool more = true; more;) {
    const std::size_t slash = path.find('/');
    more = slash != std::string_view::npos;
    auto part = percent_decoded(path.substr(0, slash));
    if (!part) return pass_on(part);
    if (part->find('/') != std::string::npos) return bad_input("a name holds a slash", "path");
    parts.push_back(std::move(*part));
    if (more) path.remove_prefix(slash + 1);
  }
  return parts;
}

std::optional<std::vector<std::string>> match_path(std::string_view pattern,
                                                   const std::vector<std::string>& path) {
  std::vector<std::string> found;
  const auto wanted = *path_parts(pattern);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (i >= path.size()) return std::nullopt;
    if (wanted[i] == "{path}") {
      std::string rest = path[i];
      for (std::size_t k = i + 1; k < path.size(); ++k) rest += "/" + path[k];
      found.push_back(std::move(rest));
      return found;
    }
    if (wanted[i].starts_with('{')) {
      found.push_back(path[i]);
    } else if (wanted[i] != path[i]) {
      return std::nullopt;
    }
  }
  if (wanted.size() != path.size()) return std::nullopt;
  return found;
}

std::string text_of(const nlohmann::ordered_json& value) {
  return value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Response json_response(const nlohmann::ordered_json& value, int status) {
  return {status, "application/json", text_of(value) + "\n", {}};
}

nlohmann::ordered_json error_json(const std::string& sentence, std::string_view code,
                                  const std::string& where) {
  return {{"error", sentence}, {"code", code}, {"where", where}};
}

Response error_response(int status, std::string_view code, const std::string& sentence,
                        const std::string& where) {
  return json_response(error_json(sentence, code, where), status);
}

Response error_response(const Fault& fault) {
  const bool ask_again = fault.code == FaultCode::budget_exhausted || fault.code == FaultCode::cancelled;
  const int status = ask_again ? 503 : fault.code == FaultCode::cannot_write ? 507 : 400;
  return error_response(status, to_string(fault.code), fault.sentence, fault.where);
}

Response not_found(const std::string& sentence, const std::string& where) {
  return error_response(404, "not_found", sentence, where);
}

std::string_view reason_phrase(int status) {
  switch (status) {
    case 200: return "OK";
    case 201: return "Created";
    case 202: return "Accepted";
    case 206: return "Partial Content";
    case 400: return "Bad Request";
    case 401: return "Unauthorized";
    case 403: return "Forbidden";
    case 404: return "Not Found";
    case 405: return "Method Not Allowed";
    case 408: return "Request Timeout";
    case 409: return "Conflict";
    case 411: return "Length Required";
    case 412: return "Precondition Failed";
    case 413: return "Content Too Large";
    case 416: return "Range Not Satisfiable";
    case 429: return "Too Many Requests";
    case 500: return "Internal Server Error";
    case 503: return "Service Unavailable";
    case 507: return "Insufficient Storage";
    default: return "Error";
  }
}

}  // namespace outrider::server
