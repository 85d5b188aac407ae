// PlanCache: the plans that runs with the same inputs share, such as the runs of a sweep that differ in their
// seeds and faults. For measurements of the time saved see docs/sweep.md.
//
//   PlanCache plans;
//   for (...) run_task(job, task, {.plans = &plans});
//
// A job finds its plan under all options that the plan depends on:
//   const std::string key = plan_key(options(), {"seed", "faults"});
//   if (auto planned = find_plan<YardPlan>(watch.plans, key)) return planned;
//   ...
//   return keep_plan(watch.plans, key, YardPlan{...});
//
// A plan that is kept is the one that would be made, so a cache changes no result but the times of the
// machine. Files are known by their names: a cache lives no longer than they stay as they are.
#pragma once

#include <any>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "outrider/core/options.hpp"

namespace outrider {

/// Keeps the plans that were used last. Thread rule: any thread. Two threads that miss the same plan both
/// make it.
class PlanCache {
 public:
  /// Keeps that many plans. Expects 1 or more.
  explicit PlanCache(std::size_t capacity = 4) : capacity_(capacity) {}

  /// Returns the plan of this key; null if there is none of this type. O(capacity).
  template <class Plan>
  [[nodiscard]] std::shared_ptr<const Plan> find(const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto* plan = std::any_cast<std::shared_ptr<const Plan>>(use(key));
    return plan != nullptr ? *plan : nullptr;
  }

  /// Returns how many plans are kept.
  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return plans_.size();
  }

  /// Keeps a plan, in place of the one of this key or else of the one that was used longest ago.
  template <class Plan>
  void keep(const std::string& key, std::shared_ptr<const Plan> plan) {
    const std::lock_guard lock(mutex_);
    insert(key, std::move(plan));
  }

 private:
  /// Moves the plan of this key to the front. Null if there is none.
  std::any* use(const std::string& key);
  void insert(const std::string& key, std::any plan);

  std::size_t capacity_;
  mutable std::mutex mutex_;
  std::vector<std::pair<std::string, std::any>> plans_;  // the one that was used last comes first
};

/// PlanCache::find() in the cache, if there is one.
template <class Plan>
std::shared_ptr<const Plan> find_plan(PlanCache* plans, const std::string& key) {
  return plans != nullptr ? plans->find<Plan>(key) : nullptr;
}

/// Returns a plan that was made, and keeps it in the cache, if there is one.
template <class Plan>
std::shared_ptr<const Plan> keep_plan(PlanCache* plans, const std::string& key, Plan plan) {
  auto made = std::make_shared<const Plan>(std::move(plan));
  if (plans != nullptr) plans->keep(key, made);
  return made;
}

/// Returns the keys and exact values of all options, one a line, without the top-level options and the groups
/// whose names are in `left_out`.
std::string plan_key(const std::vector<OptionGroup>& groups, const std::vector<std::string>& left_out);

}  // namespace outrider
