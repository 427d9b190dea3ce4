// The design of a certificate for a tracker that is given as a recursion, and the words for it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"
#include "checker/model/model_recursion.hpp"

namespace veritrack::checker {

/// The number of a key of [require]: the decimal as written, and a ball with it and the double nearest to it.
struct RequiredNumber {
  std::string text;
  Ball value;
};

/// In rad/sample and signal units. Each number stands for the decimal and for the double nearest to it.
struct ModelDesign {
  Ball amplitude;                 ///< of each sample: all that it may have
  bool amplitude_varies = false;  ///< from sample to sample, in that range; otherwise it is constant
  /// The amplitude is constant, and some number from the least to the largest one.
  bool is_constant_in_range = false;
  Ball least_amplitude, largest_amplitude;
  Ball lowest, highest;  ///< of the frequency
  Ball band_unit;        ///< in which the design writes them: Hz, or 1
  Ball noise;            ///< bound on the length of the error of a sample, all channels together
  Ball turned;           ///< a program has the angle of its samples with an error of up to so many rad
  /// Gaussian noise in place of that bound: its deviation in each channel, signal units, and the number of
  /// samples for which a probability is asked.
  std::optional<Ball> deviation;
  Ball samples;
  Ball slew;                       ///< rad/sample per sample
  std::vector<Ball> start_within;  ///< of each state; empty: not given
  std::vector<Ball> start;         ///< the state at the start; empty: not given
  std::optional<RequiredNumber> frequency_error_below, settles_within, settled_below, largest_noise,
      largest_slew, radius, bias, ripple, losing_lock, captured_within;
  std::optional<RequiredNumber> damping, settles_like, noise_bandwidth, gain_margin;  ///< of the linear loop

  [[nodiscard]] bool is_noisy() const { return !certainly_equal(noise, zero); }
  [[nodiscard]] bool moves() const { return !certainly_equal(slew, zero); }
};

/// The deviation over the amplitude for this SNR in dB, 10 log10(amplitude^2/(2 deviation^2)).
Ball deviation_at(const Ball& decibels);

/// Reads the members "assume" and "require" of a design. Objects unless 0 <= lowest <= highest <= 3.142 (pi,
/// as one may write it), amplitudes are positive and those of a range go from low to high, and no number is
/// negative that must not be. `both_signs`: frequencies may be negative, down to -3.142.
ModelDesign read_model_design(const Tree& design, ModelRecursion& recursion, Objections& objections,
                              bool both_signs = false);

/// A part of the band: as a claim writes it, and in rad/sample.
struct BandPart {
  std::string from, to;
  Ball lowest, highest;
};

/// The hypotheses of sentences.
class ModelWords {
 public:
  /// `part`: the part of the band to which the sentences are limited; none for the whole band.
  /// `bounds_covariance`: the sets are those of a filter's estimate, with bounds of its covariance.
  explicit ModelWords(const Tree& design, std::optional<BandPart> part = std::nullopt,
                      bool bounds_covariance = false)
      : design_(&design), part_(std::move(part)), bounds_covariance_(bounds_covariance) {}

  /// The same words of a program whose operations are rounded.
  [[nodiscard]] ModelWords rounded() const {
    ModelWords words = *this;
    words.is_rounded_ = true;
    return words;
  }

  /// "In exact arithmetic, on a tone of amplitude 1 with any constant frequency in [0.2, 0.5] rad/sample".
  [[nodiscard]] std::string constant_tone() const { return tone("any constant frequency in " + band()); }
  /// With a frequency that may move at any rate.
  [[nodiscard]] std::string tone_in_band() const { return tone("a frequency that stays in " + band()); }
  /// With the assumed slew.
  [[nodiscard]] std::string assumed_tone(bool moves) const;
  [[nodiscard]] std::string assumed_noise(bool is_noisy) const;
  [[nodiscard]] std::string assumed_start(const std::string& set) const;
  /// For a start in the set of that name.
  [[nodiscard]] std::string started_in(const std::string& set) const;
  /// For a start in the steady state of a certificate by gains, or as far from it as is assumed.
  [[nodiscard]] static std::string started_in_steady_state();
  [[nodiscard]] std::string assumed_start_by_steady_state() const;
  /// The state that the tracker is started in.
  [[nodiscard]] std::string started_exactly() const;
  /// The same, for statements that depend on how deep inside the set a start is.
  [[nodiscard]] std::string start_inside(const std::string& set) const;
  /// ", with Gaussian measurement noise of mean zero, ...": the assumed noise, or with this SNR in dB.
  [[nodiscard]] std::string gaussian_noise(const std::string& decibels = {}) const;
  /// "within any 1e6 successive samples, however late".
  [[nodiscard]] std::string stretch_of_samples() const;

 private:
  [[nodiscard]] std::string start_within(const std::string& set) const;
  [[nodiscard]] const Tree& assume() const { return design_->at("assume"); }
  [[nodiscard]] std::string amplitude() const;
  [[nodiscard]] std::string tone(const std::string& frequency) const;
  [[nodiscard]] std::string band() const;
  [[nodiscard]] std::string covariance_of(const std::string& set) const {
    return bounds_covariance_ ? ", with a covariance between the bounds of the set \"" + set + "\"" : "";
  }

  const Tree* design_;
  std::optional<BandPart> part_;
  bool bounds_covariance_ = false;
  bool is_rounded_ = false;
};

}  // namespace veritrack::checker
