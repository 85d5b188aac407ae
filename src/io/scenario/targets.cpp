#include "outrider/io/scenario/targets.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <set>

#include "outrider/core/options.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_targets = 100'000;
constexpr double farthest_target_m = 1e6;
constexpr double largest_side_m = 1e3;
constexpr std::array<Vec3, 4> size_by_type = {
    {{0.5, 0.205, 0.372}, {0.46, 0.36, 0.178}, {0.51, 0.1372, 0.526}, {0.2576, 0.164, 0.3712}}};

using Words = std::map<std::string, std::string_view, std::less<>>;

Outcome<Words> key_values(std::string_view line, const std::string& where) {
  static const std::vector<std::string> keys = {"type", "x", "y", "z", "rz", "size", "name"};
  Words result;
  for (const std::string_view word : words(line)) {
    const std::size_t equals = word.find('=');
    const std::string_view key = word.substr(0, equals);
    if (equals == std::string_view::npos) {
      return bad_input(fmt::format("'{}' is no key=value; write e.g. type=1 x=2 y=3", excerpt(word)), where);
    }
    if (std::ranges::find(keys, key) == keys.end()) {
      const std::string nearest = nearest_name(key.substr(0, 64), keys);
      return bad_input(fmt::format("'{}' is no key of a target; {}", excerpt(key),
                                   nearest.empty() ? "they are type, x, y, z, rz, size and name"
                                                   : fmt::format("did you mean '{}'?", nearest)),
                       where);
    }
    if (!result.emplace(key, word.substr(equals + 1)).second) {
      return bad_input(fmt::format("'{}' is given twice; leave one", key), where);
    }
  }
  return result;
}

Outcome<double> coordinate(const Words& keys, std::string_view key, std::optional<double> otherwise,
                           const std::string& where) {
  const auto found = keys.find(key);
  if (found == keys.end()) {
    if (otherwise) return *otherwise;
    return bad_input(fmt::format("{0} is missing; write {0}=<metres>", key), where);
  }
  const auto value = number<double>(found->second);
  if (!value || std::abs(*value) > farthest_target_m) {
    return bad_input(
        fmt::format("{}={} is not valid; expected a number from -1e6 to 1e6", key, excerpt(found->second)),
        where);
  }
  return *value;
}

Outcome<std::optional<std::size_t>> type_of(const Words& keys, const std::string& where) {
  const auto found = keys.find("type");
  if (found == keys.end()) return std::optional<std::size_t>{};
  const auto type = number<std::size_t>(found->second);
  if (!type || *type < 1 || *type > size_by_type.size()) {
    return bad_input(
        fmt::format("type={} is unknown; types are 1 to {}", excerpt(found->second), size_by_type.size()),
        where);
  }
  return type;
}

Outcome<Vec3> size_of(const Words& keys, std::optional<std::size_t> type, const std::string& where) {
  const auto found = keys.find("size");
  if (found == keys.end()) {
    if (type) return size_by_type[*type - 1];
    return bad_input("its size is unknown; write type=1 to 4 or size=length,width,height", where);
  }
  const auto sides = numbers_of(parts_between(found->second, ','), largest_side_m);
  if (!sides || sides->size() != 3 || std::ranges::min(*sides) <= 0.0) {
    return bad_input(
        fmt::format("size={} is not valid; expected length,width,height, each above 0 and at most 1000 m",
                    excerpt(found->second)),
        where);
  }
  return Vec3{(*sides)[0], (*sides)[1], (*sides)[2]};
}

/// Reads all of a target except its name.
Outcome<Target> target_of(const Words& keys, std::optional<std::size_t> type, const std::string& where) {
  auto x = coordinate(keys, "x", {}, where);
  if (!x) return pass_on(x);
  auto y = coordinate(keys, "y", {}, where);
  if (!y) return pass_on(y);
  auto z = coordinate(keys, "z", 0.0, where);
  if (!z) return pass_on(z);
  auto heading = coordinate(keys, "rz", 0.0, where);
  if (!heading) return pass_on(heading);
  auto size = size_of(keys, type, where);
  if (!size) return pass_on(size);
  return Target{{}, {*x, *y, *z}, *size, *heading};
}

}  // namespace

Outcome<std::vector<Target>> targets_from_text(std::string_view text, const std::string& name,
                                               const World& world) {
  std::vector<Target> targets;
  std::map<std::string, std::size_t> count_by_type;
  std::set<std::string> names;
  TextLines lines{text, name};
  while (lines.next_filled()) {
    const std::string where = lines.where();
    auto keys = key_values(lines.line, where);
    if (!keys) return pass_on(keys);
    if (targets.size() == most_targets) {
      return bad_input(fmt::format("more than {} targets; split the list", most_targets), where);
    }
    auto type = type_of(*keys, where);
    if (!type) return pass_on(type);
    auto target = target_of(*keys, *type, where);
    if (!target) return pass_on(target);
    if (!keys->contains("z")) target->base.z = world.ground_z_m(xy(target->base));
    const std::optional<std::size_t> number_of_type = *type;
    const std::string kind = number_of_type ? std::to_string(*number_of_type) : "target";
    target->name = fmt::format("{}_{}", kind, count_by_type[kind]++);
    if (const auto given = keys->find("name"); given != keys->end()) target->name = given->second;
    if (target->name.empty() || !is_printable(target->name) || !names.insert(target->name).second) {
      return bad_input(fmt::format("the name '{}' is empty, unreadable or taken; give another with name=",
                                   excerpt(target->name)),
                       where);
    }
    targets.push_back(std::move(*target));
  }
  if (targets.empty()) return bad_input("it holds no target; write a line such as type=1 x=2 y=3", name);
  return targets;
}

std::string targets_text(const std::vector<Target>& targets) {
  std::string text;
  for (const auto& [name, base, size, heading_rad] : targets) {
    text += fmt::format("name={} size={},{},{} x={} y={} z={} rz={}\n", name, size.x, size.y, size.z, base.x,
                        base.y, base.z, heading_rad);
  }
  return text;
}

Outcome<std::vector<Target>> load_targets(const std::string& path, const World& world) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  return targets_from_text(*text, path, world);
}

}  // namespace outrider
