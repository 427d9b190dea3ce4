#include "checker/quadrature/lock_cover.hpp"

#include <flint/flint.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace veritrack::checker {

namespace {

constexpr std::int64_t kMostCellsInPart = 200'000;
constexpr int kCoverDepth = 48;
constexpr unsigned kMostThreads = 64;
constexpr std::array<int, 4> kParts{4, 4, 4, 4};

/// One part of the cover.
struct CoverPart {
  LockCell cell;
  std::int64_t cells = 0;
  bool proved = false;
};

bool is_proved(const LockInequality& inequality, const LockCell& cell, int depth, std::int64_t& cells) {
  if (inequality.outside(cell)) {
    return true;
  }
  if (++cells > kMostCellsInPart) {
    return false;
  }
  const LockLook found = inequality.look(cell);
  if (found.proved) {
    return true;
  }
  if (found.hopeless || depth == 0) {
    return false;
  }
  LockCell first = cell;
  LockCell second = cell;
  first.high[found.side] = second.low[found.side] = 0.5 * (cell.low[found.side] + cell.high[found.side]);
  return is_proved(inequality, first, depth - 1, cells) && is_proved(inequality, second, depth - 1, cells);
}

/// The mirror image under (e2, nu, P12, P13, v2, w) -> -(...) commutes with the step and leaves the set as it
/// is.
bool has_mirror_image(const LockFilter& filter, const LockSet& set) {
  for (const LockCovariance* p : {&set.centre, &set.above, &set.below}) {
    if (!certainly_equal(p->p12, zero) || !certainly_equal(p->p13, zero)) {
      return false;
    }
  }
  return certainly_equal(filter.epsilon, zero) && certainly_equal(set.bias[1], zero) &&
         certainly_equal(set.bias[2], zero);
}

/// A grid over |u1|, |u2|, |u3| <= R, 0 <= s <= R/sqrt(gamma), R^2 = 2 L, which covers the set; with u3 >= 0
/// where the mirror image covers the rest. Nothing where the numbers are no doubles.
std::vector<CoverPart> cover_of(const LockSet& set, bool halved) {
  const double radius = sqrt(two * set.level).upper_double();
  const double most = sqrt(two * set.level / set.weight).upper_double();
  const std::array<double, 4> low{-radius, -radius, halved ? 0.0 : -radius, 0.0};
  const std::array<double, 4> high{radius, radius, radius, most};
  if (!std::isfinite(radius) || !std::isfinite(most) ||
      !certainly_at_most(two * set.level, square(Ball(radius))) ||
      !certainly_at_most(two * set.level, set.weight * square(Ball(most)))) {
    return {};
  }
  std::vector<CoverPart> parts{{{low, high}}};
  for (std::size_t i = 0; i < low.size(); ++i) {
    const auto node = [&](int k) {
      return k == kParts[i] ? high[i] : low[i] + (high[i] - low[i]) * k / kParts[i];
    };
    std::vector<CoverPart> next;
    for (const CoverPart& part : parts) {
      for (int k = 0; k < kParts[i]; ++k) {
        next.push_back(part);
        next.back().cell.low[i] = node(k);
        next.back().cell.high[i] = node(k + 1);
      }
    }
    parts = std::move(next);
  }
  return parts;
}

/// Examines free parts one after the other. Returns what was thrown, if anything.
class Workers {
 public:
  Workers(const LockInequality& inequality, std::vector<CoverPart>& parts)
      : inequality_(inequality), parts_(parts) {}

  void run() {
    const std::int64_t before = operations_spent();
    const unsigned others = std::clamp(std::thread::hardware_concurrency(), 1U, kMostThreads) - 1;
    std::vector<std::int64_t> spent(others, 0);
    std::vector<std::thread> threads;
    threads.reserve(others);
    try {
      for (std::int64_t& operations : spent) {
        threads.emplace_back([this, before, &operations] {
          // No thread may exceed the budget by itself.
          go_on_from(before);
          work();
          operations = operations_spent() - before;
          flint_cleanup();
        });
      }
    } catch (const std::system_error&) {
      // Then there are fewer.
    }
    work();
    for (std::thread& thread : threads) {
      thread.join();
    }
    if (thrown_) {
      std::rethrow_exception(thrown_);
    }
    for (const std::int64_t operations : spent) {
      spend(operations);
    }
  }

 private:
  void work() {
    for (std::size_t k = next_++; k < parts_.size() && !stopped_; k = next_++) {
      try {
        parts_[k].proved = is_proved(inequality_, parts_[k].cell, kCoverDepth, parts_[k].cells);
        stopped_ = stopped_ || !parts_[k].proved;
      } catch (...) {
        if (!stopped_.exchange(true)) {
          thrown_ = std::current_exception();
        }
      }
    }
  }

  const LockInequality& inequality_;
  std::vector<CoverPart>& parts_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> stopped_ = false;
  std::exception_ptr thrown_;
};

}  // namespace

bool holds_in_set(const LockFilter& filter, const LockSet& set, const LockLeft& left, std::int64_t& cells) {
  const bool mirrors = has_mirror_image(filter, set) && certainly_equal(left.offset[1], zero) &&
                       certainly_equal(left.offset[2], zero);
  std::vector<CoverPart> parts = cover_of(set, mirrors);
  const LockInequality inequality(filter, set, left);
  Workers(inequality, parts).run();
  for (const CoverPart& part : parts) {
    cells += part.cells;
    if (!part.proved) {
      return false;
    }
  }
  return !parts.empty();
}

bool drifts_slowly(const LockFilter& filter, const LockSet& set, std::int64_t& cells) {
  return holds_in_set(filter, set, left_of_drift(set), cells);
}

}  // namespace veritrack::checker
