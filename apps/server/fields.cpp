#include "fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "http/message.hpp"
#include "outrider/core/options.hpp"

namespace outrider::server {
namespace {

constexpr int deepest = 32;
constexpr double farthest_m = 1e6;

/// Returns the beginning of a value as it was sent.
std::string shown(const Json& value) {
  std::string text = text_of(value);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

/// Returns an upper bound of the number of values in the text: each value but the first follows one of these
/// characters.
std::size_t count_of_values(std::string_view text) {
  return 1 + static_cast<std::size_t>(std::ranges::count_if(
                 text, [](char c) { return c == ',' || c == '[' || c == '{' || c == ':'; }));
}

}  // namespace

std::size_t memory_of_json(std::string_view text) {
  constexpr std::size_t bytes_a_value = 64;
  return text.size() + bytes_a_value * std::min(count_of_values(text), most_json_values);
}

Outcome<Json> parse_json(std::string_view text, const std::string& where, std::size_t most_values) {
  if (count_of_values(text) > most_values) {
    return bad_input(fmt::format("the JSON has more than {} values", most_values), where);
  }
  bool too_deep = false;
  const auto watch = [&](int depth, Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > deepest;
    return !too_deep;
  };
  Json value = Json::parse(text, watch, false);
  if (too_deep) return bad_input(fmt::format("the JSON is nested more than {} deep", deepest), where);
  if (value.is_discarded()) return bad_input("this is no JSON (UTF-8)", where);
  return value;
}

std::optional<Vec2> point_of(const Json& value) {
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) return {};
  const Vec2 p{value[0].get<double>(), value[1].get<double>()};
  if (!(std::abs(p.x) <= farthest_m && std::abs(p.y) <= farthest_m)) return {};
  return p;
}

Fields::Fields(const Json& object, std::string where) : object_(object), where_(std::move(where)) {
  if (!object_.is_object()) status_ = bad_input("expected a JSON object", where_);
}

std::string Fields::place(std::string_view name) const {
  return where_.empty() ? std::string(name) : fmt::format("{}.{}", where_, name);
}

void Fields::refuse(std::string_view name, const std::string& sentence) {
  if (status_) status_ = bad_input(sentence, place(name));
}

void Fields::wrong(std::string_view name, const Json& value, const std::string& right) {
  refuse(name, fmt::format("{} is not valid; expected {}", shown(value), right));
}

const Json* Fields::find(std::string_view name, bool needed) {
  known_.emplace_back(name);
  if (!object_.is_object()) return nullptr;
  const auto found = object_.find(std::string(name));
  if (found != object_.end()) return &*found;
  if (needed) refuse(name, "it is missing");
  return nullptr;
}

bool Fields::has(std::string_view name) { return find(name, false) != nullptr; }

double Fields::number(std::string_view name, double low, double high, std::optional<double> otherwise) {
  const Json* value = find(name, !otherwise);
  if (value == nullptr) return otherwise.value_or(low);
  const double number = value->is_number() ? value->get<double>() : low - 1.0;
  if (low <= number && number <= high) return number;
  wrong(name, *value, fmt::format("a number from {} to {}", low, high));
  return low;
}

std::int64_t Fields::integer(std::string_view name, std::int64_t low, std::int64_t high,
                             std::optional<std::int64_t> otherwise) {
  const Json* value = find(name, !otherwise);
  if (value == nullptr) return otherwise.value_or(low);
  const double number = value->is_number() ? value->get<double>() : 0.5;
  const bool whole = number == std::floor(number) && static_cast<double>(low) <= number &&
                     number <= static_cast<double>(high) && std::abs(number) < 9e15;
  if (whole) return static_cast<std::int64_t>(number);
  wrong(name, *value, fmt::format("a whole number from {} to {}", low, high));
  return low;
}

bool Fields::boolean(std::string_view name, bool otherwise) {
  const Json* value = find(name, false);
  if (value == nullptr) return otherwise;
  if (value->is_boolean()) return value->get<bool>();
  wrong(name, *value, "true or false");
  return otherwise;
}

std::string Fields::text(std::string_view name, std::optional<std::string> otherwise) {
  const Json* value = find(name, !otherwise);
  if (value == nullptr) return otherwise.value_or(std::string{});
  if (value->is_string()) return value->get<std::string>();
  wrong(name, *value, "text");
  return {};
}

Vec2 Fields::point(std::string_view name, std::optional<Vec2> otherwise) {
  const Json* value = find(name, !otherwise);
  if (value == nullptr) return otherwise.value_or(Vec2{});
  if (const auto p = point_of(*value)) return *p;
  wrong(name, *value, "[x, y] in m, such as [1.5, -2]");
  return {};
}

std::vector<Vec2> Fields::polygon(std::string_view name) {
  std::vector<Vec2> corners;
  const Json* value = find(name, true);
  if (value == nullptr) return corners;
  bool good = value->is_array();
  for (std::size_t i = 0; good && i < value->size(); ++i) {
    const auto p = point_of((*value)[i]);
    good = p.has_value();
    if (good) corners.push_back(*p);
  }
  if (!good) wrong(name, *value, "a list of corners [x, y] in m");
  return corners;
}

std::vector<std::int64_t> Fields::integers(std::string_view name, std::size_t count) {
  const Json* value = find(name, true);
  std::vector<std::int64_t> numbers;
  if (value == nullptr) return std::vector<std::int64_t>(count, 0);
  bool good = value->is_array() && value->size() == count;
  for (std::size_t i = 0; good && i < count; ++i) {
    const Json& one = (*value)[i];
    good = one.is_number_integer() && std::abs(one.get<double>()) < 1e9;
    if (good) numbers.push_back(one.get<std::int64_t>());
  }
  if (!good) wrong(name, *value, fmt::format("{} whole numbers in brackets", count));
  numbers.resize(count, 0);
  return numbers;
}

const Json* Fields::list(std::string_view name) {
  static const Json empty = Json::array();
  const Json* value = find(name, false);
  if (value == nullptr) return &empty;
  if (value->is_array()) return value;
  wrong(name, *value, "a list");
  return nullptr;
}

const Json* Fields::object(std::string_view name) {
  const Json* value = find(name, false);
  if (value == nullptr || value->is_object()) return value;
  wrong(name, *value, "an object");
  return nullptr;
}

Status Fields::end() const {
  if (!status_ || !object_.is_object()) return status_;
  for (const auto& [name, value] : object_.items()) {
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    const std::string nearest = nearest_name(name.substr(0, 64), known_);
    const std::string hint = nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
    return bad_input("there is no such member" + hint, place(name.substr(0, 64)));
  }
  return {};
}

}  // namespace outrider::server
