// Reads the members of a JSON object in a request one by one and keeps the first fault.
//
//   Fields fields(object, "");
//   request.start = fields.point("start");
//   request.trace = fields.integer("trace", 0, 100'000, 0);
//   if (auto ok = fields.end(); !ok) return pass_on(ok);
//
// The fault names the place (edits[2].block), the value, and what would be right. A member that was never
// read is refused, with the nearest valid name.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider::server {

using Json = nlohmann::ordered_json;

inline constexpr std::size_t most_json_values = 2'000'000;

/// Parses JSON. Refuses text that is not JSON, is nested more than 32 deep, or has more than `most_values`
/// values. The fault names `where`.
Outcome<Json> parse_json(std::string_view text, const std::string& where,
                         std::size_t most_values = most_json_values);

/// Returns an upper bound of the bytes that parse_json() needs for the text. O(length), allocates nothing.
std::size_t memory_of_json(std::string_view text);

class Fields {
 public:
  /// `object` must outlive the reader.
  Fields(const Json& object, std::string where);

  [[nodiscard]] bool has(std::string_view name);
  double number(std::string_view name, double low, double high, std::optional<double> otherwise = {});
  std::int64_t integer(std::string_view name, std::int64_t low, std::int64_t high,
                       std::optional<std::int64_t> otherwise = {});
  bool boolean(std::string_view name, bool otherwise);
  std::string text(std::string_view name, std::optional<std::string> otherwise = {});
  Vec2 point(std::string_view name, std::optional<Vec2> otherwise = {});
  std::vector<Vec2> polygon(std::string_view name);
  /// Returns a list of exactly `count` integers.
  std::vector<std::int64_t> integers(std::string_view name, std::size_t count);
  /// Returns a list; an empty one if it is left out, null if it is wrong.
  const Json* list(std::string_view name);
  /// Returns an object; null if it is left out or wrong.
  const Json* object(std::string_view name);

  /// Returns the place of a member, such as `grid.runs`.
  [[nodiscard]] std::string place(std::string_view name) const;
  /// Returns the first fault, or else that of a member that was never read.
  [[nodiscard]] Status end() const;
  void refuse(std::string_view name, const std::string& sentence);

 private:
  const Json* find(std::string_view name, bool needed);
  void wrong(std::string_view name, const Json& value, const std::string& right);

  const Json& object_;
  std::string where_;
  std::vector<std::string> known_;
  Status status_;
};

/// Returns a point [x, y] in m, both coordinates within 1e6; nothing otherwise.
std::optional<Vec2> point_of(const Json& value);

}  // namespace outrider::server
