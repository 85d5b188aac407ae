// Prepares SDF text for sdformat: keeps the elements that determine the poses of collisions, repairs them,
// and inserts included files. See sdf.hpp.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "sdf_elements.hpp"

namespace outrider {

/// Warnings by sentence, each with its first position and its count.
class SdfWarnings {
 public:
  void add(const std::string& where, const std::string& sentence);
  /// Adds that a file which the world names was not found.
  void add_missing(const std::string& where, const std::string& sentence);
  /// Returns the first of these, with its place; empty if all files were found.
  [[nodiscard]] const std::string& first_missing() const { return first_missing_; }
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  struct Repair {
    std::string where;
    std::string sentence;
    std::size_t count = 0;
  };
  std::vector<Repair> entries_;                 // in the order of first appearance
  std::map<std::string, std::size_t> by_text_;  // sentence -> entry
  std::string first_missing_;
};

struct RepairedSdf {
  std::string text;                     ///< one <world>; <mesh><uri> is the path of a file that exists
  SdfCounts counts;                     ///< numbers of its elements
  std::map<std::string, Pose3> stated;  ///< world poses from <state>, by "model::nested::link"
  bool bare = false;                    ///< true if there was no <world>
};

Outcome<RepairedSdf> repair_sdf(std::string_view text, const std::string& name, const std::string& model_path,
                                SdfWarnings& warnings);

}  // namespace outrider
