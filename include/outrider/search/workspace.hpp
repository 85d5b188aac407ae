// Workspace: memory that planners keep between queries, so that later queries allocate nothing.
//
// A planner gets its memory by type, in the state in which the previous query left it. The result of a query
// does not depend on that state, unless the header of the planner says so. Thread rule: one workspace per
// thread.
#pragma once

#include <memory>
#include <typeindex>
#include <typeinfo>
#include <utility>
#include <vector>

#include "outrider/core/trace.hpp"

namespace outrider {

/// Memory of planners, by type.
class Workspace {
 public:
  Trace* trace = nullptr;  ///< receives the trace of the next queries, if set; owned by the caller

  /// Returns the memory of that type and creates it on first use. It stays valid as long as the workspace.
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
