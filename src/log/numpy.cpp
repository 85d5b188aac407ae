#include "outrider/log/numpy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "numpy_column.hpp"
#include "outrider/core/text.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_bytes = std::size_t{4} << 30U;

/// The field of a record that holds the message.
MessageField message_field(const MessageType& type) {
  MessageField field;
  field.name = "message";
  field.kind = FieldKind::message;
  field.message = &type;
  return field;
}

/// Returns a .npy file of version 2.0 up to its data.
std::string npy_head(const std::string& dtype, std::size_t length) {
  constexpr std::string_view magic{"\x93NUMPY\2\0", 8};
  constexpr std::size_t alignment = 64;  // of the data, which the format asks for
  std::string head = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': ({},), }}", dtype, length);
  const std::size_t before = magic.size() + sizeof(std::uint32_t);
  head.append((alignment - (before + head.size() + 1) % alignment) % alignment, ' ');
  head += '\n';
  std::string bytes(magic);
  append_number(bytes, static_cast<std::uint32_t>(head.size()));
  return bytes + head;
}

Status check_size(const std::string& name, std::size_t length, std::size_t bytes) {
  if (length == 0 || bytes <= most_bytes / length) return {};
  return bad_input(
      fmt::format("the array '{}' would have more than 4 GiB; select fewer topics", excerpt(name)));
}

/// Appends an array for each sequence in the values, named after `path`.
Status add_sequences(const std::string& path, const NumpyValues& values, std::vector<NumpyArray>& arrays) {
  for (const NumpyColumn& column : values.columns()) {
    const std::string name = fmt::format("{}/{}", path, column.name());
    if (column.is_sequence()) {
      const std::size_t length = column.element_count();
      if (auto ok = check_size(name, length, column.values().bytes()); !ok) return ok;
      NumpyArray array{name, length, npy_head(column.values().dtype(), length)};
      const char* from = column.elements().data();
      column.values().expand(from, length, array.bytes);
      arrays.push_back(std::move(array));
    }
    if (auto ok = add_sequences(name, column.values(), arrays); !ok) return ok;
  }
  return {};
}

}  // namespace

std::string numpy_dtype(const MessageType& type, std::size_t text_length) {
  const MessageField field = message_field(type);
  NumpyValues values(field);
  values.widen_texts(text_length);
  return values.dtype();
}

/// The messages of a topic.
class NumpyArrays::Records {
 public:
  explicit Records(const MessageType& type) : field_(message_field(type)), messages_(field_) {}

  /// Returns the number of bytes appended.
  std::size_t append(std::int64_t time_ns, const void* message) {
    const std::size_t before = packed_.size();
    append_number(packed_, time_ns);
    const std::size_t elsewhere = messages_.pack(static_cast<const char*>(message), 1, packed_);
    ++length_;
    return packed_.size() - before + elsewhere;
  }

  Status finish(const std::string& name, std::vector<NumpyArray>& arrays) const {
    const std::size_t record_bytes = sizeof(std::int64_t) + messages_.bytes();
    if (auto ok = check_size(name, length_, record_bytes); !ok) return ok;
    const std::string dtype = fmt::format("[('time_ns', '<i8'), ('message', {})]", messages_.dtype());
    NumpyArray array{name, length_, npy_head(dtype, length_)};
    array.bytes.reserve(array.bytes.size() + length_ * record_bytes);
    const char* from = packed_.data();
    for (std::size_t i = 0; i < length_; ++i) {
      array.bytes.append(from, sizeof(std::int64_t));
      from += sizeof(std::int64_t);
      messages_.expand(from, 1, array.bytes);
    }
    arrays.push_back(std::move(array));
    return add_sequences(name, messages_, arrays);
  }

 private:
  MessageField field_;
  NumpyValues messages_;
  std::string packed_;  ///< for each record its time, and what NumpyValues::pack() writes
  std::size_t length_ = 0;
};

NumpyArrays::NumpyArrays() = default;
NumpyArrays::NumpyArrays(NumpyArrays&&) noexcept = default;
NumpyArrays& NumpyArrays::operator=(NumpyArrays&&) noexcept = default;
NumpyArrays::~NumpyArrays() = default;

Status NumpyArrays::append(std::string_view topic, std::int64_t time_ns, const MessageType& type,
                           const void* message) {
  if (topic.starts_with('/')) topic.remove_prefix(1);
  auto found = records_.find(topic);
  if (found == records_.end())
    found = records_.emplace(std::string(topic), std::make_unique<Records>(type)).first;
  bytes_ += found->second->append(time_ns, message);
  if (bytes_ > most_bytes) return bad_input("its messages have more than 4 GiB; select fewer topics");
  return {};
}

Outcome<std::vector<NumpyArray>> NumpyArrays::finish() {
  std::vector<NumpyArray> arrays;
  for (auto& [name, records] : std::exchange(records_, {})) {
    if (auto ok = records->finish(name, arrays); !ok) return pass_on(ok);
  }
  bytes_ = 0;
  return arrays;
}

}  // namespace outrider
