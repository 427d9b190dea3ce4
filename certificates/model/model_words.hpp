// The hypotheses of sentences about a model.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certificates/model/band_part.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_design.hpp"
#include "certificates/sets/guarantee_sentence.hpp"

namespace veritrack::certificates {

/// The kind of starts: in a set of the certificate, in one of a filter's estimate with bounds of its
/// covariance, or, in a proof by gains, in the steady state.
enum class StartsIn { set, set_with_covariance, steady_state };

/// "single precision (IEEE 754 binary32)".
[[nodiscard]] inline std::string words_of_format(trackers::code::Format format) {
  return format.bits == 32 ? "single precision (IEEE 754 binary32)" : "double precision (IEEE 754 binary64)";
}

/// "In exact arithmetic", and of what where the recursion is that of code; or in that of the program or
/// of the formulas, rounded.
[[nodiscard]] std::string arithmetic_of(const ModelTable& model, bool is_rounded);

/// The words of the hypotheses.
class ModelWords {
 public:
  /// `part`: the part of the band to which statements are limited; none for the whole band.
  explicit ModelWords(const ModelTables& tables, std::optional<BandPart> part = std::nullopt,
                      StartsIn starts = StartsIn::set)
      : assume_(&tables.assume),
        tables_(&tables),
        arithmetic_(arithmetic_of(tables.model, false)),
        is_tone_(is_pure_tone(tables)),
        part_(std::move(part)),
        starts_(starts) {}

  /// The same words of a program whose operations are rounded.
  [[nodiscard]] ModelWords rounded() const {
    ModelWords words = *this;
    words.arithmetic_ = arithmetic_of(tables_->model, true);
    return words;
  }
  [[nodiscard]] std::string unit() const { return assume_->frequency_in_hertz ? "Hz" : "rad/sample"; }
  [[nodiscard]] std::string tone_with(const std::string& frequency) const {
    const std::string signal = is_tone_ ? "a tone" : "the signal of the design file";
    const auto& [least, largest] = assume_->amplitude;
    if (is_constant_in_range(*assume_)) {
      return fmt::format("{}, on {} of any constant amplitude in [{}, {}] with {}", arithmetic_, signal,
                         least.text, largest.text, frequency);
    }
    return assume_->one_amplitude
               ? fmt::format("{}, on {} of amplitude {} with {}", arithmetic_, signal, least.text, frequency)
               : fmt::format(
                     "{}, on {} with an amplitude in [{}, {}], which may differ from sample to sample, "
                     "with {}",
                     arithmetic_, signal, least.text, largest.text, frequency);
  }
  [[nodiscard]] std::string band() const {
    if (part_) {
      return fmt::format("[{}, {}] {}{} (a part of the assumed band)", part_->from, part_->to, unit(),
                         rate());
    }
    return fmt::format("[{}, {}] {}{}", assume_->frequency[0].text, assume_->frequency[1].text, unit(),
                       rate());
  }
  [[nodiscard]] std::string constant_tone() const { return tone_with("any constant frequency in " + band()); }
  [[nodiscard]] bool moves() const { return assume_->slew.value.upper() > 0.0; }
  /// With the assumed slew.
  [[nodiscard]] std::string assumed_tone() const {
    return !moves()
               ? constant_tone()
               : tone_with(fmt::format(
                     "a frequency that stays in {} and changes by at most {} {}", band(), assume_->slew.text,
                     assume_->slew_in_hertz_per_second ? "Hz per second" : "rad/sample per sample"));
  }
  [[nodiscard]] std::string noise() const {
    return assume_->noise.value.upper() > 0.0 ? ", with noise below " + assume_->noise.text
                                              : ", without noise";
  }
  /// The assumed start, in the set of that name.
  [[nodiscard]] std::string start(const std::string& set) const {
    if (assume_->start_within.empty()) {
      return ", " + started_in(set);
    }
    return start_within(set) + covariance_of(set);
  }
  /// For a start in the set of that name.
  [[nodiscard]] std::string started_in(const std::string& set) const {
    return starts_ == StartsIn::steady_state
               ? std::string("started in the steady state of the certificate")
               : "started in the set \"" + set + "\" of the certificate" + covariance_of(set);
  }
  /// The state that the tracker is started in.
  [[nodiscard]] std::string started_exactly() const {
    return ", started exactly in {" + listed(assume_->start_exactly) + "} at any phase of the signal";
  }
  /// The same, for statements that depend on how deep inside the set a start is.
  [[nodiscard]] std::string start_inside(const std::string& set) const {
    return assume_->start_within.empty() ? ", started at a level of at most half of that of the set \"" +
                                               set + "\" of the certificate" + covariance_of(set)
                                         : start_within(set) + covariance_of(set);
  }

 private:
  [[nodiscard]] std::string covariance_of(const std::string& set) const {
    return starts_ == StartsIn::set_with_covariance
               ? ", with a covariance between the bounds of the set \"" + set + "\""
               : "";
  }
  [[nodiscard]] std::string rate() const {
    return assume_->sample_rate ? fmt::format(" at {} samples per second", assume_->sample_rate->text) : "";
  }
  /// "alpha: 0, w: 0.3".
  static std::string listed(const std::vector<NamedText>& entries) {
    std::string states;
    for (const NamedText& entry : entries) {
      states += (states.empty() ? "" : ", ") + entry.name.text + ": " + entry.formula.text;
    }
    return states;
  }
  [[nodiscard]] std::string start_within(const std::string& set) const {
    return ", started within {" + listed(assume_->start_within) +
           (starts_ == StartsIn::steady_state
                ? std::string("} of the steady state of the certificate, the other states in it")
                : "} of the curve of the set \"" + set + "\" of the certificate, the other states on it");
  }

  const ModelAssumptions* assume_;
  const ModelTables* tables_;
  std::string arithmetic_;
  bool is_tone_ = false;
  std::optional<BandPart> part_;
  StartsIn starts_;
};

}  // namespace veritrack::certificates
