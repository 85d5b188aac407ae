// Names that are each given once.
#pragma once

#include <fmt/format.h>

#include <map>
#include <set>
#include <string>

namespace outrider {

class UniqueNames {
 public:
  /// The wanted name, or the first of name_2, name_3 ... that is free. Constant time for equal names, but
  /// for the look-up.
  std::string take(const std::string& wanted) {
    if (taken_.insert(wanted).second) return wanted;
    std::size_t& number = next_.try_emplace(wanted, 2).first->second;
    for (;; ++number) {
      std::string name = fmt::format("{}_{}", wanted, number);
      if (taken_.insert(name).second) return name;
    }
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, std::size_t> next_;  // by wanted name: all numbers from 2 to below this are taken
};

}  // namespace outrider
