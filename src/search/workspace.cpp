#include "outrider/search/workspace.hpp"

namespace outrider {

std::shared_ptr<void>& Workspace::slot(std::type_index type) {
  for (auto& [known, memory] : slots_) {
    if (known == type) return memory;
  }
  return slots_.emplace_back(type, nullptr).second;
}

}  // namespace outrider
