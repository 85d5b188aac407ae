// NumpyColumn: the values of a field, collected for a numpy array.
//
// Until all are there, nobody knows how long the texts are. So rows are packed with a number for each text,
// and are expanded in the end.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/log/encoding/message_type.hpp"

namespace outrider {

template <class Number>
void append_number(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

class NumpyColumn;

/// The values that a field has, or the elements of its array or sequence: numbers, texts or records.
class NumpyValues {
 public:
  explicit NumpyValues(const MessageField& field);

  /// Appends `count` values at `at` to packed rows. Returns how many bytes went elsewhere.
  std::size_t pack(const char* at, std::size_t count, std::string& rows);
  /// Appends `count` values of packed rows from `from` on, which is moved past them.
  void expand(const char*& from, std::size_t count, std::string& rows) const;
  /// Makes texts at least so long.
  void widen_texts(std::size_t characters);

  [[nodiscard]] std::string dtype() const;
  /// Returns the size of an expanded value.
  [[nodiscard]] std::size_t bytes() const;
  /// Returns the fields of records.
  [[nodiscard]] const std::vector<NumpyColumn>& columns() const { return columns_; }

 private:
  FieldKind kind_;
  std::size_t stride_;  ///< from one value in memory to the next
  std::vector<NumpyColumn> columns_;
  std::vector<std::u32string> texts_;
  std::size_t longest_text_ = 1;
};

class NumpyColumn {
 public:
  explicit NumpyColumn(const MessageField& field) : field_(&field), values_(field) {}

  std::size_t pack(const char* message, std::string& row);
  void expand(const char*& from, std::string& row) const;
  void widen_texts(std::size_t characters) { values_.widen_texts(characters); }

  /// Returns the entry of the list that is the dtype of a record: "('x', '<f8')".
  [[nodiscard]] std::string dtype_entry() const;
  [[nodiscard]] std::size_t bytes() const;

  [[nodiscard]] std::string_view name() const { return field_->name; }
  [[nodiscard]] bool is_sequence() const { return field_->shape == FieldShape::sequence; }
  [[nodiscard]] const NumpyValues& values() const { return values_; }
  /// Returns the packed elements of a sequence, of all rows.
  [[nodiscard]] const std::string& elements() const { return elements_; }
  [[nodiscard]] std::size_t element_count() const { return element_count_; }

 private:
  const MessageField* field_;
  NumpyValues values_;
  std::string elements_;
  std::size_t element_count_ = 0;
};

}  // namespace outrider
