// A part of a recording with a look ahead.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reports/recording/samples/sample_source.hpp"

namespace veritrack::reports {

class SampleStream {
 public:
  /// The samples `from`, ..., `to` - 1. `source` must outlive the stream.
  SampleStream(SampleSource& source, std::int64_t from, std::int64_t to);

  /// Whether there is one more sample.
  [[nodiscard]] bool has_next();
  /// The next samples that are not missing, without a gap: at most `most`, fewer before a gap or the end.
  [[nodiscard]] std::span<const RecordedSample> present_ahead(std::size_t most);
  /// The next sample.
  [[nodiscard]] RecordedSample take();
  /// The number of the sample that take() returns next.
  [[nodiscard]] std::int64_t index() const { return index_; }

 private:
  /// Reads until `most` samples are ahead, or to the end.
  void fill(std::size_t most);

  SampleSource* source_;
  std::int64_t to_;
  std::int64_t index_ = 0;
  std::vector<RecordedSample> ahead_;
  std::size_t begin_ = 0;
  bool at_end_ = false;
};

}  // namespace veritrack::reports
