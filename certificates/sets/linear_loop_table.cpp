#include "certificates/sets/linear_loop_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/linear/loop_margins.hpp"
#include "certificates/document/markdown_text.hpp"
#include "certificates/sets/frequency_units.hpp"

namespace veritrack::certificates {

namespace {

/// The first sample from which on the share stays within 2 % of 1.
std::size_t settled_from(const std::vector<double>& share) {
  constexpr double kNear = 0.02;
  std::size_t from = share.size();
  while (from > 0 && std::fabs(share[from - 1] - 1.0) <= kNear) {
    --from;
  }
  return from;
}

class Rows {
 public:
  explicit Rows(const std::optional<Number>& sample_rate) : rate_(&sample_rate), units_(sample_rate) {}

  void add_modes(const linear::LinearLoop& loop) {
    for (const linear::LoopMode& mode : linear::modes_of(loop)) {
      if (mode.time_constant == 0.0) {
        continue;
      }
      const bool is_pair = mode.multiplier.imag() != 0.0;
      add(is_pair ? fmt::format("pair of modes at {}, damping {:.3g}: time constant",
                                in_units(mode.frequency), mode.damping)
                  : fmt::format("mode {:.6g}: time constant", mode.multiplier.real()),
          duration(mode.time_constant));
    }
  }

  void add_response(const linear::LinearLoop& loop, std::size_t samples) {
    const std::vector<double> share = linear::followed_share(loop, samples);
    const double most = *std::max_element(share.begin(), share.end());
    add("step of the frequency: overshoot", fmt::format("{:.3g} %", std::max(0.0, 100.0 * (most - 1.0))));
    add("step of the frequency: within 2 % from sample", duration(static_cast<double>(settled_from(share))));
    add("white noise of deviation 1 in each channel: deviation of the frequency",
        in_units(linear::noise_deviation(loop, samples)));
  }

  /// The margins of the detector's gain, of the phase and of a delay.
  void add_margins(const linear::DetectorLoop& loop) {
    const linear::GainMargin margin = linear::gain_margin(loop);
    const std::string low = margin.low > 0.0 ? fmt::format("from {:.3g}", margin.low) : std::string();
    const std::string high =
        std::isfinite(margin.high) ? fmt::format("up to {:.3g}", margin.high) : std::string();
    add("the detector's gain times this factor is stable",
        low + (low.empty() || high.empty() ? "" : " ") + high +
            (low.empty() && high.empty() ? "any from 0.001 to 1000" : ""));
    if (const auto delay = linear::delay_margin(loop)) {
      add("phase margin, where the open loop has the gain 1: at " + in_units(delay->crossover),
          fmt::format("{:.3g}°", delay->phase * 180.0 / std::numbers::pi));
      add("a further delay in the loop is stable below", duration(delay->samples));
    }
  }

  [[nodiscard]] std::string table() const { return markdown::table({"Property", "Value"}, rows_); }

 private:
  void add(std::string property, std::string value) {
    rows_.push_back({std::move(property), std::move(value)});
  }
  [[nodiscard]] std::string in_units(double radians) const {
    return fmt::format("{:.4g} rad/sample{}", radians,
                       units_.has_hertz() ? fmt::format(" ({:.4g} Hz)", units_.drawn(radians)) : "");
  }
  /// "82.6 samples (6.6 ms)".
  [[nodiscard]] std::string duration(double samples) const {
    std::string text = fmt::format("{:.4g} samples", samples);
    if (!*rate_) {
      return text;
    }
    const double seconds = samples / (*rate_)->nearest;
    return text +
           (seconds < 1.0 ? fmt::format(" ({:.3g} ms)", 1e3 * seconds) : fmt::format(" ({:.3g} s)", seconds));
  }

  const std::optional<Number>* rate_;
  FrequencyUnits units_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace

std::string linear_loop_table(const linear::LinearLoop& loop, std::size_t samples,
                              const std::optional<linear::DetectorLoop>& detector,
                              const std::optional<Number>& sample_rate) {
  Rows rows(sample_rate);
  rows.add_modes(loop);
  rows.add_response(loop, samples);
  if (detector) {
    rows.add_margins(*detector);
  }
  return "*Computed, not proved:* the linear loop.\n\n" + rows.table() + "\n";
}

}  // namespace veritrack::certificates
