// Storage of ball models: a row of doubles, few of them without an allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>

namespace veritrack::rigor {

/// So many doubles, zero at first. Models of s and z alone have 30, coefficients and norms, and there are
/// very many of them.
class BallNumbers {
 public:
  explicit BallNumbers(std::size_t size)
      : size_(size), many_(size > kFew ? std::make_unique<double[]>(size) : nullptr) {}
  BallNumbers(const BallNumbers& other)
      : size_(other.size_), few_(other.few_), many_(other.many_ ? copy_of(other) : nullptr) {}
  /// The other one has none afterwards.
  BallNumbers(BallNumbers&& other) noexcept
      : size_(other.size_), few_(other.few_), many_(std::move(other.many_)) {
    other.size_ = 0;
  }
  BallNumbers& operator=(const BallNumbers& other) {
    if (this != &other) {
      if (many_ && size_ == other.size_) {
        std::copy_n(other.data(), size_, data());
        return *this;
      }
      *this = BallNumbers(other);
    }
    return *this;
  }
  BallNumbers& operator=(BallNumbers&& other) noexcept {
    size_ = other.size_;
    few_ = other.few_;
    many_ = std::move(other.many_);
    other.size_ = 0;
    return *this;
  }
  ~BallNumbers() = default;

  [[nodiscard]] double* data() { return many_ ? many_.get() : few_.data(); }
  [[nodiscard]] const double* data() const { return many_ ? many_.get() : few_.data(); }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  static constexpr std::size_t kFew = 30;
  // NOLINTNEXTLINE(modernize-avoid-c-arrays): a size that is known when the program runs
  using Many = std::unique_ptr<double[]>;

  [[nodiscard]] static Many copy_of(const BallNumbers& other) {
    // Not set to zero before.
    Many copy(new double[other.size_]);  // NOLINT(cppcoreguidelines-owning-memory)
    std::copy_n(other.many_.get(), other.size_, copy.get());
    return copy;
  }

  std::size_t size_;
  std::array<double, kFew> few_{};
  Many many_;
};

}  // namespace veritrack::rigor
