#include "reports/recording/sample_stream.hpp"

#include <algorithm>

namespace veritrack::reports {

namespace {

constexpr std::size_t kBlock = 4096;

}  // namespace

SampleStream::SampleStream(SampleSource& source, std::int64_t from, std::int64_t to)
    : source_(&source), to_(to) {
  while (index_ < from && has_next()) {
    (void)take();
  }
}

void SampleStream::fill(std::size_t most) {
  if (at_end_ || ahead_.size() - begin_ >= most) {
    return;
  }
  ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  while (ahead_.size() < most && !at_end_) {
    const std::size_t known = ahead_.size();
    ahead_.resize(known + kBlock);
    const std::size_t count = source_->read(std::span(ahead_).subspan(known));
    ahead_.resize(known + count);
    at_end_ = count < kBlock;
  }
}

bool SampleStream::has_next() {
  fill(1);
  return index_ < to_ && begin_ < ahead_.size();
}

std::span<const RecordedSample> SampleStream::present_ahead(std::size_t most) {
  fill(most);
  const std::size_t allowed = static_cast<std::size_t>(std::max<std::int64_t>(0, to_ - index_));
  const std::span all = std::span<const RecordedSample>(ahead_).subspan(begin_);
  const std::span some = all.first(std::min({most, allowed, all.size()}));
  const auto end =
      std::find_if(some.begin(), some.end(), [](const RecordedSample& each) { return !each.is_present; });
  return some.first(static_cast<std::size_t>(end - some.begin()));
}

RecordedSample SampleStream::take() {
  ++index_;
  return ahead_[begin_++];
}

}  // namespace veritrack::reports
