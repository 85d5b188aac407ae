// An HTTP request and its response as values, so that everything except the sockets can be tested without
// sockets.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/io/files/open_folder.hpp"

namespace outrider::server {

struct Request {
  std::string method;                          ///< GET, PUT, ...
  std::string path;                            ///< as sent, still percent-encoded
  std::string query;                           ///< after the question mark
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
  std::stop_token stop = {};  ///< raised when the client has left
  std::string client = {};    ///< bytes of its address, of IPv6 those of its network

  /// Returns the value of the header; empty if there is none. `name` is in lower case.
  [[nodiscard]] std::string header(const std::string& name) const;
  /// Returns the decoded value of a key in the query; empty if there is none.
  [[nodiscard]] std::string parameter(std::string_view key) const;
};

/// Streams a file from the disk without holding it in memory. The destructor closes it.
class OpenFile {
 public:
  OpenFile(int descriptor, std::uintmax_t bytes) : descriptor_(descriptor), bytes_(bytes) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile();
  /// Opens a regular file beneath a folder; null if there is none.
  static std::shared_ptr<const OpenFile> in(const OpenFolder& folder, const std::string& path);

  [[nodiscard]] std::uintmax_t bytes() const { return bytes_; }
  /// Returns at most `most` bytes from `offset` on; fewer than expected if the file was truncated meanwhile.
  [[nodiscard]] std::string part(std::uintmax_t offset, std::size_t most) const;

 private:
  int descriptor_;
  std::uintmax_t bytes_;
};

/// A part of a file, in bytes.
struct ByteRange {
  std::uintmax_t first = 0;
  std::uintmax_t count = 0;
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  std::shared_ptr<const OpenFile> file = nullptr;  ///< if set, sent instead of the body
  std::optional<ByteRange> range = {};  ///< the part of the file that is sent; all of it if not set
};

/// Makes the response with a file the answer to the header Range of its request: status 206 with the part
/// that is asked for, 416 if the file has no such part. Other responses, several ranges at once, and what
/// cannot be understood stay as they are. Source: RFC 9110, section 14.
void apply_range(const Request& request, Response& response);

/// Decodes percent-encoding such as %41. Faults on a percent sign without two hexadecimal digits.
Outcome<std::string> percent_decoded(std::string_view text);

/// Splits a path and decodes each part on its own, so that an encoded slash stays within its part.
Outcome<std::vector<std::string>> path_parts(std::string_view path);
/// Returns the values of the names in the pattern (Route); nothing if the path does not match.
std::optional<std::vector<std::string>> match_path(std::string_view pattern,
                                                   const std::vector<std::string>& path);

/// Returns the JSON as text; bytes that are not valid UTF-8 become U+FFFD.
std::string text_of(const nlohmann::ordered_json& value);
Response json_response(const nlohmann::ordered_json& value, int status = 200);

/// Returns {"error": sentence, "code", "where"}.
nlohmann::ordered_json error_json(const std::string& sentence, std::string_view code,
                                  const std::string& where = {});
Response error_response(int status, std::string_view code, const std::string& sentence,
                        const std::string& where = {});
/// Returns the response for a fault: status 400; 503 if a budget is exhausted or it was not begun, 507 if the
/// disk failed.
Response error_response(const Fault& fault);
Response not_found(const std::string& sentence, const std::string& where = {});

/// Returns the reason phrase of a status for the first line of a response.
std::string_view reason_phrase(int status);

}  // namespace outrider::server
