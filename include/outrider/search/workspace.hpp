// Workspace: memory that planners keep between queries, so that a query allocates nothing.
//
// A planner asks for its own kind of memory by type and finds it as the last query left it; what a
// query answers never depends on that, unless the planner's header says how. Thread rule: one workspace for
// each thread.
#pragma once

#include <memory>
#include <typeindex>
#include <typeinfo>
#include <utility>
#include <vector>

#include "outrider/core/trace.hpp"

namespace outrider {

class Workspace {
 public:
  Trace* trace = nullptr;  ///< filled by the next queries when set; owned by the caller

  /// The memory of that type, made on first use. Valid as long as the workspace lives.
  template <class Memory>
  Memory& get() {
    std::shared_ptr<void>& kept = slot(typeid(Memory));
    if (!kept) kept = std::make_shared<Memory>();
    return *static_cast<Memory*>(kept.get());
  }

 private:
  std::shared_ptr<void>& slot(std::type_index type);

  std::vector<std::pair<std::type_index, std::shared_ptr<void>>> slots_;
};

}  // namespace outrider
