#include "index_bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "hub_index.hpp"
#include "outrider/core/sha256.hpp"
#include "outrider/core/text.hpp"

namespace outrider::hub_labelling {
namespace {

constexpr std::uint32_t version = 2;
constexpr std::uint32_t byte_order = 0x01020304;
constexpr std::string_view remedy = "; delete it, and it is made anew, or name another file";

struct Header {
  std::array<char, 16> magic = {'o', 'u', 't', 'r', 'i', 'd', 'e',  'r',
                                ' ', 'i', 'n', 'd', 'e', 'x', '\r', '\n'};
  std::uint32_t order = byte_order;
  std::uint32_t format = version;
  std::uint64_t bytes = 0;                            ///< of all
  std::array<char, 32> planner{};                     ///< filled up with zeros
  std::array<char, 64> ground{}, costs{}, options{};  ///< SHA-256; zeros without costs
  std::uint64_t checksum = 0;                         ///< of all else
};
static_assert(sizeof(Header) == 264 && std::is_trivially_copyable_v<Header>);

template <std::size_t N>
std::array<char, N> letters(std::string_view text) {
  std::array<char, N> all{};
  std::copy_n(text.begin(), std::min(N, text.size()), all.begin());
  return all;
}

/// Mixes words into a sum. Each step is a bijection of the sum and of the word, so a change within one word
/// always changes the result.
std::uint64_t mixed(std::uint64_t sum, const std::byte* data, std::size_t bytes) {
  constexpr std::uint64_t odd = 0x9E3779B97F4A7C15;
  std::uint64_t word = 0;
  for (; bytes >= sizeof word; bytes -= sizeof word, data += sizeof word) {
    std::memcpy(&word, data, sizeof word);
    sum = std::rotl((sum ^ word) * odd, 29);
  }
  word = 0;
  std::memcpy(&word, data, bytes);
  return std::rotl((sum ^ word) * odd, 29);
}

std::uint64_t checksum_of(Header header, std::span<const std::byte> content) {
  header.checksum = 0;
  const std::uint64_t sum = mixed(0, reinterpret_cast<const std::byte*>(&header), sizeof header);
  return mixed(sum, content.data(), content.size());
}

std::array<char, 64> hash_of(const GridMap& ground) {
  Sha256 hash;
  hash.add(fmt::format("{} {} {} ", to_string(ground.model), ground.frame.width, ground.frame.height));
  hash.add({reinterpret_cast<const char*>(ground.marks.data()), ground.marks.size()});
  return letters<64>(hash.hex());
}

std::array<char, 64> hash_of(const CellCosts* costs) {
  if (costs == nullptr) return {};
  const auto& cells = costs->per_m.cells;
  return letters<64>(sha256({reinterpret_cast<const char*>(cells.data()), cells.size() * sizeof(float)}));
}

Header header_for(const IndexKey& key) {
  Header header;
  header.planner = letters<32>(key.planner);
  header.ground = hash_of(key.ground);
  header.costs = hash_of(key.costs);
  header.options = letters<64>(sha256(key.options));
  return header;
}

tl::unexpected<Fault> refuse(std::string_view why) { return bad_input(fmt::format("{}{}", why, remedy)); }

/// Checks that the bytes are those of an index of this version, whole and undamaged.
Outcome<Header> whole_header(std::span<const std::byte> bytes) {
  const Header known;
  Header header;
  if (bytes.size() < sizeof header) return refuse("it is no index file, or it is cut");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != known.magic) return refuse("it is no index file");
  if (header.order != known.order) return refuse("it comes from a machine with another byte order");
  if (header.format != known.format)
    return refuse(fmt::format("it has the format {} of index files, not {}", header.format, known.format));
  if (header.bytes != bytes.size())
    return refuse(
        fmt::format("it has {} bytes, not {}, so it is cut or damaged", bytes.size(), header.bytes));
  if (header.checksum != checksum_of(header, bytes.subspan(sizeof header)))
    return refuse("it is damaged: its checksum is wrong");
  return header;
}

}  // namespace

IndexWriter::IndexWriter() : bytes_(sizeof(Header), '\0') {}

void IndexWriter::append(const void* data, std::size_t bytes) {
  if (bytes > 0) bytes_.append(static_cast<const char*>(data), bytes);
  bytes_.append((8 - bytes % 8) % 8, '\0');
}

std::string IndexWriter::finish(const IndexKey& key) && {
  Header header = header_for(key);
  header.bytes = bytes_.size();
  header.checksum = checksum_of(header, std::as_bytes(std::span(bytes_)).subspan(sizeof header));
  std::memcpy(bytes_.data(), &header, sizeof header);
  return std::move(bytes_);
}

Outcome<std::span<const std::byte>> content_of(const StoredIndex& stored, const IndexKey& key) {
  if (reinterpret_cast<std::uintptr_t>(stored.bytes.data()) % alignof(std::uint64_t) != 0)
    return bad_input("the bytes of a stored index begin at an address that is no multiple of 8; move them");
  auto header = whole_header(stored.bytes);
  if (!header) return pass_on(header);
  const Header wanted = header_for(key);
  if (header->planner != wanted.planner) {
    const std::string_view name(header->planner.data(), header->planner.size());
    return refuse(fmt::format("it holds the index of {}, not of {}", excerpt(name.substr(0, name.find('\0'))),
                              key.planner));
  }
  if (header->ground != wanted.ground) return refuse("it was made for another map");
  if (header->costs != wanted.costs) return refuse("it was made for other costs of the cells");
  if (header->options != wanted.options)
    return refuse(fmt::format("it was made with other options of {}", key.planner));
  return stored.bytes.subspan(sizeof(Header));
}

bool holds_none(std::span<const std::byte> content) {
  IndexReader reader(content);
  std::uint64_t kind = 1;
  return reader.number(kind) && kind == static_cast<std::uint64_t>(IndexKind::none) && reader.at_end();
}

tl::unexpected<Fault> damaged_index() { return refuse("it is damaged: its content contradicts itself"); }

}  // namespace outrider::hub_labelling
