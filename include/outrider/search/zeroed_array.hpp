// ZeroedArray: an array whose bytes are zero until they are written. The system gives memory to a large one
// only page by page, when it is touched, so an array for all cells of a large map takes as little as a search
// needs of it.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>

namespace outrider {

/// For types of which zero bytes are a value.
template <class T>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  /// Makes room for so many items and keeps those there are. Throws std::bad_alloc.
  void grow(std::size_t size) {
    if (size <= size_) return;
    void* const memory = std::calloc(size, sizeof(T));  // NOLINT: new touches the pages that it zeroes
    std::unique_ptr<T[], Free> larger(static_cast<T*>(memory));
    if (larger == nullptr) throw std::bad_alloc();
    if (size_ > 0) std::memcpy(static_cast<void*>(larger.get()), items_.get(), size_ * sizeof(T));
    items_ = std::move(larger);
    size_ = size;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return items_.get()[i]; }
  const T& operator[](std::size_t i) const { return items_.get()[i]; }

 private:
  struct Free {
    void operator()(T* items) const { std::free(items); }  // NOLINT: from calloc
  };
  std::unique_ptr<T[], Free> items_;
  std::size_t size_ = 0;
};

}  // namespace outrider
