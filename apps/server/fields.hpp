// The members of a JSON object in a request, read one by one; the first that is wrong is the fault of all.
//
//   Fields fields(object, "");
//   request.start = fields.point("start");
//   request.trace = fields.integer("trace", 0, 100'000, 0);
//   if (auto ok = fields.end(); !ok) return pass_on(ok);
//
// The fault names the place (edits[2].block), the value, and what would be right; a member that nobody asked
// for is refused with the nearest that would do.
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

/// Refuses what is no JSON, nested more than 32 deep, or has more values. `where` names it.
Outcome<Json> parse_json(std::string_view text, const std::string& where,
                         std::size_t most_values = most_json_values);

/// At most how many bytes parse_json() will take for it. O(length), without any.
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
  /// Four or so whole numbers.
  std::vector<std::int64_t> integers(std::string_view name, std::size_t count);
  /// A list, empty when it is left out; null when it is wrong.
  const Json* list(std::string_view name);
  /// An object, null when it is left out or wrong.
  const Json* object(std::string_view name);

  /// Where a member stands, as in `grid.runs`.
  [[nodiscard]] std::string place(std::string_view name) const;
  /// The first fault, or that of a member that was not asked for.
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

/// A point [x, y] in m, both within 1e6; nothing otherwise.
std::optional<Vec2> point_of(const Json& value);

}  // namespace outrider::server
