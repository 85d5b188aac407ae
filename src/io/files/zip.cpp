#include "files/zip.hpp"

#include <zlib.h>

#include <cstdint>
#include <limits>

namespace outrider {
namespace {

void append(std::string& bytes, std::uint16_t value) {
  bytes += static_cast<char>(value & 0xFFU);
  bytes += static_cast<char>(value >> 8U);
}

void append(std::string& bytes, std::uint32_t value) {
  append(bytes, static_cast<std::uint16_t>(value & 0xFFFFU));
  append(bytes, static_cast<std::uint16_t>(value >> 16U));
}

constexpr std::uint16_t version = 20;
constexpr std::uint16_t utf8_names = 1U << 11U;
constexpr std::uint16_t stored = 0;
constexpr std::uint16_t midnight = 0;
constexpr std::uint16_t first_of_january_1980 = 1U << 5U | 1U;
constexpr std::uint16_t none = 0;

/// Returns the fields that the head of a file and its entry in the directory have in common.
std::string common_fields(std::string_view name, std::string_view content) {
  const auto size = static_cast<std::uint32_t>(content.size());
  std::string bytes;
  for (const std::uint16_t field : {version, utf8_names, stored, midnight, first_of_january_1980})
    append(bytes, field);
  append(bytes, static_cast<std::uint32_t>(
                    crc32_z(0, reinterpret_cast<const unsigned char*>(content.data()), content.size())));
  append(bytes, size);  // compressed
  append(bytes, size);
  append(bytes, static_cast<std::uint16_t>(name.size()));
  append(bytes, none);  // length of extra fields
  return bytes;
}

}  // namespace

Status ZipFile::add(std::string_view name, std::string_view content) {
  constexpr std::size_t head_bytes = 128;  // more than the fields of a file without its name
  const std::size_t bytes =
      bytes_.size() + directory_.size() + content.size() + 2 * (name.size() + head_bytes);
  if (bytes > std::numeric_limits<std::uint32_t>::max())
    return bad_input("it would have more than 4 GiB; select fewer topics");
  constexpr std::size_t longest = std::numeric_limits<std::uint16_t>::max();
  if (count_ == longest || name.size() > longest)
    return bad_input("it would have more than 65,535 files, or one with a longer name; select fewer topics");
  const auto offset = static_cast<std::uint32_t>(bytes_.size());
  const std::string fields = common_fields(name, content);
  bytes_.append("PK\3\4").append(fields).append(name).append(content);
  directory_ += "PK\1\2";
  append(directory_, version);
  directory_ += fields;
  for (int i = 0; i < 3; ++i) append(directory_, none);  // length of a comment, disk, internal attributes
  append(directory_, std::uint32_t{0});                  // external attributes
  append(directory_, offset);
  directory_ += name;
  ++count_;
  return {};
}

std::string ZipFile::finish() && {
  const auto start = static_cast<std::uint32_t>(bytes_.size());
  const auto count = static_cast<std::uint16_t>(count_);
  bytes_ += directory_;
  bytes_ += "PK\5\6";
  for (const std::uint16_t field : {none, none, count, count}) append(bytes_, field);
  append(bytes_, static_cast<std::uint32_t>(directory_.size()));
  append(bytes_, start);
  append(bytes_, none);  // length of a comment
  return std::move(bytes_);
}

}  // namespace outrider
