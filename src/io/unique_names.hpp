// UniqueNames: gives each name only once.
#pragma once

#include <fmt/format.h>

#include <map>
#include <set>
#include <string>

namespace outrider {

class UniqueNames {
 public:
  /// Returns the wanted name, or the first free one of name_2, name_3 ... Apart from the look-up, repeated
  /// requests for the same name take constant time.
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
  std::map<std::string, std::size_t> next_;  // by wanted name: all numbers from 2 to below this one are taken
};

}  // namespace outrider
