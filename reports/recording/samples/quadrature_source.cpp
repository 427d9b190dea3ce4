#include "reports/recording/samples/quadrature_source.hpp"

#include <algorithm>
#include <cstdint>

namespace veritrack::reports {

void QuadratureSource::refill() {
  constexpr std::size_t kBlock = 4096;
  constexpr RecordedSample kMissing{0.0, 0.0, false};
  const std::int64_t delay = filter_.delay();
  raw_.resize(kBlock);
  const std::size_t count = recording_->read(raw_);
  for (std::size_t i = 0; i < count; ++i) {
    bool is_known = false;
    if (raw_[i].is_present) {
      is_known = filter_.push(raw_[i].in_phase);
    } else {
      filter_.clear();
    }
    // The sample that is known now came `delay` ago.
    if (++pushed_ > delay) {
      ready_.push_back(is_known ? RecordedSample{filter_.in_phase(), filter_.quadrature(), true} : kMissing);
    }
  }
  if (count < kBlock) {
    at_end_ = true;
    ready_.insert(ready_.end(), static_cast<std::size_t>(std::min(delay, pushed_)), kMissing);
  }
}

std::size_t QuadratureSource::read(std::span<RecordedSample> block) {
  while (ready_.size() < block.size() && !at_end_) {
    refill();
  }
  const std::size_t count = std::min(block.size(), ready_.size());
  const auto end = ready_.begin() + static_cast<std::ptrdiff_t>(count);
  std::copy(ready_.begin(), end, block.begin());
  ready_.erase(ready_.begin(), end);
  return count;
}

}  // namespace veritrack::reports
