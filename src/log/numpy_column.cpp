#include "numpy_column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "outrider/core/text.hpp"

namespace outrider {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

constexpr std::string_view range_dtype = "[('begin', '<i8'), ('end', '<i8')]";
constexpr std::size_t range_bytes = 2 * sizeof(std::int64_t);

/// Returns the code of a number or, without a length, of a text.
std::string_view code_of(FieldKind kind) {
  switch (kind) {
    case FieldKind::boolean: return "|b1";
    case FieldKind::int8: return "|i1";
    case FieldKind::uint8: return "|u1";
    case FieldKind::int16: return "<i2";
    case FieldKind::uint16: return "<u2";
    case FieldKind::int32: return "<i4";
    case FieldKind::uint32: return "<u4";
    case FieldKind::int64: return "<i8";
    case FieldKind::uint64: return "<u8";
    case FieldKind::float32: return "<f4";
    case FieldKind::float64: return "<f8";
    case FieldKind::text: return "<U";
    case FieldKind::message: break;
  }
  return "";
}

/// Returns the characters of a text; '?' for each byte that is not UTF-8 or a control character.
std::u32string characters_of(std::string_view text) {
  std::u32string characters;
  for (const char c : printable(text, "\t\r\n")) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >> 6U == 2U)  // a further byte of the last character
      characters.back() = characters.back() << 6U | (byte & 0x3FU);
    else
      characters += static_cast<char32_t>(byte < 0x80 ? byte : byte & (0x7FU >> std::countl_one(byte)));
  }
  return characters;
}

}  // namespace

NumpyValues::NumpyValues(const MessageField& field) : kind_(field.kind), stride_(field.element_bytes) {
  if (kind_ != FieldKind::message) return;
  for (const MessageField& inner : field.message->fields) columns_.emplace_back(inner);
}

std::size_t NumpyValues::pack(const char* at, std::size_t count, std::string& rows) {
  if (kind_ != FieldKind::text && kind_ != FieldKind::message) {
    rows.append(at, count * stride_);
    return 0;
  }
  std::size_t elsewhere = 0;
  for (std::size_t i = 0; i < count; ++i, at += stride_) {
    if (kind_ == FieldKind::message) {
      for (NumpyColumn& column : columns_) elsewhere += column.pack(at, rows);
      continue;
    }
    append_number(rows, static_cast<std::uint32_t>(texts_.size()));
    texts_.push_back(characters_of(*reinterpret_cast<const std::string*>(at)));
    widen_texts(texts_.back().size());
    elsewhere += texts_.back().size() * sizeof(char32_t) + sizeof(std::u32string);
  }
  return elsewhere;
}

void NumpyValues::expand(const char*& from, std::size_t count, std::string& rows) const {
  if (kind_ != FieldKind::text && kind_ != FieldKind::message) {
    rows.append(from, count * stride_);
    from += count * stride_;
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (kind_ == FieldKind::message) {
      for (const NumpyColumn& column : columns_) column.expand(from, rows);
      continue;
    }
    std::uint32_t number = 0;
    std::memcpy(&number, from, sizeof number);
    from += sizeof number;
    const std::u32string& text = texts_[number];
    rows.append(reinterpret_cast<const char*>(text.data()), text.size() * sizeof(char32_t));
    rows.append(bytes() - text.size() * sizeof(char32_t), '\0');
  }
}

void NumpyValues::widen_texts(std::size_t characters) {
  longest_text_ = std::max(longest_text_, characters);
  if (kind_ != FieldKind::message) return;
  for (NumpyColumn& column : columns_) column.widen_texts(characters);
}

std::string NumpyValues::dtype() const {
  if (kind_ == FieldKind::text) return fmt::format("'<U{}'", longest_text_);
  if (kind_ != FieldKind::message) return fmt::format("'{}'", code_of(kind_));
  std::string entries;
  for (const NumpyColumn& column : columns_) {
    if (!entries.empty()) entries += ", ";
    entries += column.dtype_entry();
  }
  return "[" + entries + "]";
}

std::size_t NumpyValues::bytes() const {
  if (kind_ == FieldKind::text) return longest_text_ * sizeof(char32_t);
  if (kind_ != FieldKind::message) return stride_;
  std::size_t sum = 0;
  for (const NumpyColumn& column : columns_) sum += column.bytes();
  return sum;
}

std::size_t NumpyColumn::pack(const char* message, std::string& row) {
  const char* at = message + field_->offset;
  if (!is_sequence()) return values_.pack(at, field_->array_length, row);
  const std::size_t length = field_->length(at);
  append_number(row, static_cast<std::int64_t>(element_count_));
  append_number(row, static_cast<std::int64_t>(element_count_ + length));
  element_count_ += length;
  if (length == 0) return 0;
  const std::size_t before = elements_.size();
  const std::size_t elsewhere =
      values_.pack(static_cast<const char*>(field_->elements(at)), length, elements_);
  return elements_.size() - before + elsewhere;
}

void NumpyColumn::expand(const char*& from, std::string& row) const {
  if (!is_sequence()) {
    values_.expand(from, field_->array_length, row);
    return;
  }
  row.append(from, range_bytes);
  from += range_bytes;
}

std::string NumpyColumn::dtype_entry() const {
  if (is_sequence()) return fmt::format("('{}', {})", field_->name, range_dtype);
  if (field_->shape == FieldShape::single) return fmt::format("('{}', {})", field_->name, values_.dtype());
  return fmt::format("('{}', {}, ({},))", field_->name, values_.dtype(), field_->array_length);
}

std::size_t NumpyColumn::bytes() const {
  return is_sequence() ? range_bytes : field_->array_length * values_.bytes();
}

}  // namespace outrider
