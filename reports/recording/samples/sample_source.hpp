// A recording as a stream: the next samples, in a constant amount of memory.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace veritrack::reports {

struct RecordedSample {
  double in_phase = 0.0;    ///< signal units; of a recording with one channel, that channel
  double quadrature = 0.0;  ///< signal units; 0 with one channel
  bool is_present = true;   ///< otherwise it is missing from the recording, and a part of a gap
};

class SampleSource {
 public:
  SampleSource() = default;
  virtual ~SampleSource() = default;
  SampleSource(const SampleSource&) = delete;
  SampleSource& operator=(const SampleSource&) = delete;
  SampleSource(SampleSource&&) = delete;
  SampleSource& operator=(SampleSource&&) = delete;

  /// 1, or 2: in phase and quadrature.
  [[nodiscard]] virtual int channels() const = 0;
  /// Whether the quadrature channel is computed from the in-phase one.
  [[nodiscard]] virtual bool quadrature_is_derived() const { return false; }
  /// Hz; none when nothing says it.
  [[nodiscard]] virtual std::optional<double> sample_rate() const = 0;
  /// Fills the block from its front and returns how many samples there were: fewer than it has room for only
  /// at the end. Throws certificates::InputError for what cannot be understood.
  virtual std::size_t read(std::span<RecordedSample> block) = 0;
  /// The share of the recording that has been read, in [0, 1]; none when its length is unknown.
  [[nodiscard]] virtual std::optional<double> progress() const { return std::nullopt; }
  /// Sentences about how the recording was read; complete at its end.
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
};

}  // namespace veritrack::reports
