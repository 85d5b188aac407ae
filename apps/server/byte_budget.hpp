// Memory shared by all connections: each user takes what it needs first, and is refused if too little is
// left.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>

namespace outrider::server {

/// Counts the bytes that are left. Thread rule: any thread may take and give back. A lease must not outlive
/// its budget.
class ByteBudget {
 public:
  explicit ByteBudget(std::size_t bytes) : all_(bytes), left_(bytes) {}

  /// Returns how many bytes the budget has in total.
  [[nodiscard]] std::size_t all() const { return all_; }

  /// Holds a number of bytes; the destructor gives them back.
  class Lease {
   public:
    Lease() = default;
    Lease(Lease&& other) noexcept
        : budget_(std::exchange(other.budget_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
    Lease& operator=(Lease&& other) noexcept {
      std::swap(budget_, other.budget_);
      std::swap(bytes_, other.bytes_);
      return *this;
    }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    ~Lease() {
      if (budget_ != nullptr) budget_->give_back(bytes_);
    }

   private:
    friend class ByteBudget;
    Lease(ByteBudget* budget, std::size_t bytes) : budget_(budget), bytes_(bytes) {}
    ByteBudget* budget_ = nullptr;
    std::size_t bytes_ = 0;
  };

  /// Takes bytes from the budget; returns nothing if fewer are left. Never waits.
  std::optional<Lease> take(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    if (bytes > left_) return std::nullopt;
    left_ -= bytes;
    return Lease(this, bytes);
  }
  /// Adds bytes to a lease of this budget; returns false if fewer are left.
  bool grow(Lease& lease, std::size_t bytes) {
    auto more = take(bytes);
    if (!more) return false;
    lease.budget_ = this;
    lease.bytes_ += std::exchange(more->bytes_, 0);
    return true;
  }

 private:
  void give_back(std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    left_ += bytes;
  }

  const std::size_t all_;
  std::mutex mutex_;
  std::size_t left_;
};

}  // namespace outrider::server
