// Makes SDF text fit for sdformat: keeps what says where collisions stand, repairs it, and brings in
// the files it names. sdf.hpp is the manual.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "sdf_elements.hpp"

namespace outrider {

/// Warnings by what was done, each with its first place and how often.
class SdfWarnings {
 public:
  void add(const std::string& where, const std::string& sentence);
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  struct Repair {
    std::string where;
    std::string sentence;
    std::size_t count = 0;
  };
  std::vector<Repair> entries_;                 // in the order of first appearance
  std::map<std::string, std::size_t> by_text_;  // sentence -> entry
};

struct RepairedSdf {
  std::string text;                     ///< one <world>; <mesh><uri> is the path of a file that exists
  SdfCounts counts;                     ///< of its elements
  std::map<std::string, Pose3> stated;  ///< world poses from <state>, by "model::nested::link"
  bool bare = false;                    ///< there was no <world>
};

Outcome<RepairedSdf> repair_sdf(std::string_view text, const std::string& name, const std::string& model_path,
                                SdfWarnings& warnings);

}  // namespace outrider
