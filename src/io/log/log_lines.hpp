// Shared by the readers of logs and graphs: lines of words and numbers.
#pragma once

#include <functional>
#include <span>

#include "outrider/io/files/text.hpp"
#include "outrider/io/log/landmark_logs.hpp"

namespace outrider {

/// Calls `read` with the words of each line that is not empty; '#' starts a comment. Adds file and line to
/// its faults.
Status for_each_line(const NamedText& text,
                     const std::function<Status(std::span<const std::string_view>)>& read);

/// Returns the words as numbers. Fault: bad_input, with the form `takes`, unless there are `count` words and
/// all are finite numbers.
Outcome<std::vector<double>> line_numbers(std::span<const std::string_view> words, std::size_t count,
                                          std::string_view takes);

}  // namespace outrider
