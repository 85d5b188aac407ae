#include "outrider/job/plan_cache.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/job/run_job.hpp"

namespace outrider {
namespace {

/// The value as it is in memory, which value_text() rounds if it is an angle.
std::string exact_text(const Option& option) {
  return std::visit([](const auto* value) { return fmt::format("{}", *value); }, option.value);
}

}  // namespace

std::any* PlanCache::use(const std::string& key) {
  const auto found = std::ranges::find(plans_, key, &std::pair<std::string, std::any>::first);
  if (found == plans_.end()) return nullptr;
  std::rotate(plans_.begin(), found, found + 1);
  return &plans_.front().second;
}

void PlanCache::insert(const std::string& key, std::any plan) {
  if (std::any* kept = use(key); kept != nullptr) {
    *kept = std::move(plan);
    return;
  }
  if (plans_.size() == capacity_) plans_.pop_back();
  plans_.emplace(plans_.begin(), key, std::move(plan));
}

std::string plan_key(const std::vector<OptionGroup>& groups, const std::vector<std::string>& left_out) {
  const auto is_left_out = [&](const std::string& name) {
    return std::ranges::find(left_out, name) != left_out.end();
  };
  std::string key;
  for (const OptionGroup& group : groups) {
    if (is_left_out(group.name)) continue;
    for (const Option& option : group.options) {
      if (group.name.empty() && is_left_out(option.name)) continue;
      key += key_of(group, option) + '=' + exact_text(option) + '\n';
    }
  }
  return key;
}

}  // namespace outrider
