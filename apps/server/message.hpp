// An HTTP request and its response as values, so that all but sockets can be tested without any.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider::server {

struct Request {
  std::string method;                          ///< GET, PUT, ...
  std::string path;                            ///< as it was sent, percent signs and all
  std::string query;                           ///< after the question mark
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
  std::stop_token stop = {};  ///< raised when whoever asked has left

  /// The header's value; empty without one. `name` is in lower case.
  [[nodiscard]] std::string header(const std::string& name) const;
  /// The decoded value of a key of the query; empty without one.
  [[nodiscard]] std::string parameter(std::string_view key) const;
};

/// A file that is sent from the disk as it is read, never held in memory. Closed with the object.
class OpenFile {
 public:
  OpenFile(int descriptor, std::uintmax_t bytes) : descriptor_(descriptor), bytes_(bytes) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile();

  [[nodiscard]] std::uintmax_t bytes() const { return bytes_; }
  /// The bytes from `offset` on, at most `most`; fewer than there should be when the file was cut meanwhile.
  [[nodiscard]] std::string part(std::uintmax_t offset, std::size_t most) const;

 private:
  int descriptor_;
  std::uintmax_t bytes_;
};

struct Response {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  std::shared_ptr<const OpenFile> file = nullptr;  ///< in place of the body
};

/// Resolves %41 and the like; nothing on a percent sign without two hexadecimal digits.
Outcome<std::string> percent_decoded(std::string_view text);

/// Text of JSON; bytes that are no UTF-8 become U+FFFD.
std::string text_of(const nlohmann::ordered_json& value);
Response json_response(const nlohmann::ordered_json& value, int status = 200);

/// {"error": sentence, "code", "where"}
nlohmann::ordered_json error_json(const std::string& sentence, std::string_view code,
                                  const std::string& where = {});
Response error_response(int status, std::string_view code, const std::string& sentence,
                        const std::string& where = {});
/// Of a fault: status 400; 503 when a budget ended, 507 when the disk failed.
Response error_response(const Fault& fault);
Response not_found(const std::string& sentence, const std::string& where = {});

/// The word for a status in the first line of a response.
std::string_view reason_phrase(int status);

}  // namespace outrider::server
