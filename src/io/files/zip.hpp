// ZipFile: files in one, not compressed. After APPNOTE.TXT 6.3.3 of PKWARE, sections 4.3.7, 4.3.12, 4.3.16.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"

namespace outrider {

class ZipFile {
 public:
  /// Adds a file. Fault: bad_input, if the zip would have more than 4 GiB or 65,535 files.
  Status add(std::string_view name, std::string_view content);

  /// Returns the bytes of the zip. The files have no date (that is 1980), so the same files give the same
  /// bytes.
  [[nodiscard]] std::string finish() &&;

 private:
  std::string bytes_;
  std::string directory_;
  std::size_t count_ = 0;
};

}  // namespace outrider
