// Logs as numpy arrays: a record for each message, by the dtype that is made from its type.
//
//   NumpyArrays arrays;
//   arrays.append("/scan", message.time_ns, message_type<sensor_msgs::LaserScan>(), &scan);
//   for (const NumpyArray& array : arrays.finish()) save(array.name + ".npy", array.bytes);
//
// A record has `time_ns`, when the message was recorded, and `message`. There a number is a number, an array
// of fixed length a subarray, a message a record, and a text a Unicode string as long as the longest of its
// field. A sequence is the range [begin, end) of the elements of an array of its own, named after its field:
//
//   begin, end = scan["message"]["ranges"][i]
//   ranges = scan_ranges[begin:end]      # of the array "scan/ranges"
//
// Bytes are those of the .npy format (numpy.lib.format in the manual of numpy), little-endian. Takes O(bytes
// of the messages), except that each text of a field is as long as the longest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/log/encoding/message_type.hpp"

namespace outrider {

/// Returns the dtype of a message as a Python literal, with texts of `text_length` characters.
std::string numpy_dtype(const MessageType& type, std::size_t text_length = 1);

struct NumpyArray {
  std::string name;        ///< the topic without its first '/', and the path of the sequence: "scan/ranges"
  std::size_t length = 0;  ///< records or elements
  std::string bytes;       ///< of a .npy file
};

/// Collects messages as arrays. Thread rule: one thread.
class NumpyArrays {
 public:
  NumpyArrays();
  NumpyArrays(NumpyArrays&&) noexcept;
  NumpyArrays& operator=(NumpyArrays&&) noexcept;
  ~NumpyArrays();

  /// Appends the message of that type at `message`. All messages of a topic have one type. Fault: bad_input
  /// if the records have more than 4 GiB.
  Status append(std::string_view topic, std::int64_t time_ns, const MessageType& type, const void* message);

  /// Returns the arrays by their names, and forgets the messages. Fault: bad_input with the name of an array
  /// that would have more than 4 GiB, because a text is long.
  Outcome<std::vector<NumpyArray>> finish();

 private:
  class Records;
  std::map<std::string, std::unique_ptr<Records>, std::less<>> records_;
  std::size_t bytes_ = 0;
};

}  // namespace outrider
