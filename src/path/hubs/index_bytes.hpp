// The format of a stored index: a header that says for what it was made, then arrays and numbers.
//
// Each array begins with the number and the size of its items and is padded to 8 bytes. Nothing is allocated
// for its items: they are used where they lie.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/path/grid/terrain/cell_costs.hpp"
#include "outrider/path/stored_index.hpp"
#include "stored_array.hpp"

namespace outrider::hub_labelling {

/// For what an index was made.
struct IndexKey {
  std::string_view planner;
  std::string options;  ///< as text
  const GridMap& ground;
  const CellCosts* costs = nullptr;  ///< null: a metre costs 1
};

/// Writes the content, and then the header before it.
class IndexWriter {
 public:
  IndexWriter();
  void number(std::uint64_t value) { append(&value, sizeof value); }
  template <class T>
  void array(const StoredArray<T>& items) {
    number(items.size());
    number(sizeof(T));
    append(items.data(), items.memory());
  }
  /// Returns all bytes.
  std::string finish(const IndexKey& key) &&;

 private:
  void append(const void* data, std::size_t bytes);

  std::string bytes_;
};

/// Reads the content; the arrays refer to it.
class IndexReader {
 public:
  explicit IndexReader(std::span<const std::byte> content) : rest_(content) {}

  bool number(std::uint64_t& value) {
    if (rest_.size() < sizeof value) return false;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_ = rest_.subspan(sizeof value);
    return true;
  }
  template <class T>
  bool array(StoredArray<T>& items) {
    static_assert(alignof(T) <= alignof(std::uint64_t));
    std::uint64_t count = 0, size = 0;
    if (!number(count) || !number(size) || size != sizeof(T) || count > rest_.size() / sizeof(T))
      return false;
    const std::size_t bytes = static_cast<std::size_t>(count) * sizeof(T);
    items = StoredArray<T>(
        std::span<const T>(reinterpret_cast<const T*>(rest_.data()), static_cast<std::size_t>(count)));
    rest_ = rest_.subspan(std::min(rest_.size(), (bytes + 7) / 8 * 8));
    return true;
  }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
};

/// Checks the header and the checksum and returns the content. Faults: bad_input, with the remedy. O(bytes +
/// cells).
Outcome<std::span<const std::byte>> content_of(const StoredIndex& stored, const IndexKey& key);

/// Returns true if the content says that no index fits.
bool holds_none(std::span<const std::byte> content);

/// The fault for content that contradicts itself or the map.
tl::unexpected<Fault> damaged_index();

}  // namespace outrider::hub_labelling
