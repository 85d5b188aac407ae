// StoredArray: an array of an index that was built, or that lies in the bytes of a stored one.
//
// Thread rule: read-only after construction.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace outrider::hub_labelling {

/// Owns its items, or refers to memory that lives longer. Moves keep the items where they are.
template <class T>
class StoredArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  StoredArray() = default;
  explicit StoredArray(std::vector<T> items) : own_(std::move(items)) {
    own_.shrink_to_fit();
    items_ = own_;
  }
  explicit StoredArray(std::span<const T> items) : items_(items) {}
  StoredArray(StoredArray&&) noexcept = default;
  StoredArray& operator=(StoredArray&&) noexcept = default;
  StoredArray(const StoredArray&) = delete;
  StoredArray& operator=(const StoredArray&) = delete;
  ~StoredArray() = default;

  [[nodiscard]] const T& operator[](std::size_t i) const { return items_[i]; }
  [[nodiscard]] const T* data() const { return items_.data(); }
  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] bool empty() const { return items_.empty(); }
  [[nodiscard]] std::span<const T> all() const { return items_; }
  [[nodiscard]] std::size_t memory() const { return items_.size_bytes(); }

 private:
  std::vector<T> own_;
  std::span<const T> items_;
};

}  // namespace outrider::hub_labelling
