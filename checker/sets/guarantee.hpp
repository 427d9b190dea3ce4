// The bounds that a tracker's sets prove for the assumed starts; the claims in a design's [require], and the
// guarantee in one sentence.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checker/document/parts.hpp"
#include "checker/sets/frequency_words.hpp"

namespace veritrack::checker {

/// From sample `samples` on |frequency error| stays at or below `frequency_error`, rad/sample.
struct Settled {
  Ball samples, frequency_error;
};

/// The statements on the assumed starts that are proved by the verified sets that tolerate the assumed noise
/// and slew.
struct Promises {
  bool starts_inside = false;
  std::optional<Ball> ultimate;    ///< limsup of |frequency error|, rad/sample: an upper bound
  std::optional<Ball> bound;       ///< of |frequency error| at every sample, rad/sample
  std::optional<Settled> settled;  ///< both numbers are the certificate's
  std::optional<Ball> wrong_lock;  ///< from some start |frequency error| ends above this: a lower bound
  // From invariant sets, whatever the start: tolerated noise without slew (relative to the amplitude),
  // tolerated slew without noise, and the frequency errors that the set for the assumed noise and slew
  // contains, rad/sample. Lower bounds.
  std::optional<Ball> noise, slew, reach;
  /// |frequency error| in the set of each of these, rad/sample: upper bounds.
  std::optional<Ball> noise_error, slew_error, reach_error;
  std::optional<Ball> rate;     ///< the factor of errors in that set a sample: an upper bound
  std::size_t rate_window = 1;  ///< samples over which that is a mean
  /// With Gaussian noise: the probability of losing lock within the assumed samples, and |frequency error|
  /// until then. Upper bounds.
  std::optional<Ball> losing_lock, lock_reach;
  /// The root mean square of the frequency error in lock over those samples, rad/sample: an upper bound.
  std::optional<Ball> rms;
  /// The level of the starts in the set (docs/gaussian.md, section 7): an upper bound.
  std::optional<Ball> start_level;
  /// The same at the lowest SNR for which there is a set, and that SNR, dB. Upper bounds. For which P(0|0).
  std::optional<Ball> lowest_snr, losing_lock_at_lowest_snr, reach_at_lowest_snr;
  std::string covariance_at_lowest_snr;
  bool about_steady_state = false;  ///< the reach is measured from a biased steady state
  /// The P(0|0) for which all this is true, in the words of the sentences: "and with P(0|0) = ...".
  std::string covariance;
};

/// The bounds on the frequency error, and on the noise and slew that are tolerated, as a derivation states
/// them.
void add_bounds(const Promises& promises, Derivation& found);

/// A derivation's statement on settling, which is to be proved; empty when it makes no sensible one.
std::optional<Settled> settling_claim(const Tree& quantities);

/// The subject of a statement: the recursion over the reals, or the program, whose rounding is bounded.
inline constexpr const char* kExactArithmetic = "In exact arithmetic";
inline constexpr const char* kDoublePrecision =
    "In double precision (IEEE 754, rounding to nearest, sine and cosine within one unit in the last place)";

/// The words of a kind of tracker for its hypotheses.
struct Wording {
  bool in_band = true;       ///< true for the assumed frequencies; otherwise for every frequency
  bool two_channels = true;  ///< the noise is a vector in the plane
  const char* arithmetic = kExactArithmetic;
  std::optional<Ball> deviation = std::nullopt;  ///< of Gaussian noise in each channel, relative
};

/// The claims of [require] and the guarantee of a design whose [assume] and [require] this reads.
class Guarantee {
 public:
  /// Objects to a key of [require] that is not known, and to numbers that are not in it.
  Guarantee(const Tree& design, Wording wording, Objections& objections);

  static bool is_guarantee(const std::string& id);
  /// All hypotheses of a sentence, "In ..., started within ... and with P(0|0) ..., ", with the given words
  /// on noise and slew.
  [[nodiscard]] std::string hypotheses(const std::string& disturbance, const std::string& covariance) const;
  /// The words on noise and slew: the assumed ones, or others, relative to the amplitude and in rad/sample
  /// per sample.
  [[nodiscard]] std::string assumed_disturbance() const;
  static std::string disturbance_of(const Ball& noise, const Ball& slew);
  /// The limit that separates the lock from every other one that the formulas show, "3.14 rad/sample": less
  /// than half of the distance to the next one. The frequency acts through its sine and cosine, so that there
  /// is one 2 pi off; with one channel there are also those at the frequencies -w and 2 pi - w, which the
  /// channel sees as w.
  [[nodiscard]] std::string lock_words() const { return words_.at_most(lock_limit_); }
  /// Whether frequency errors up to that bound are certainly below it.
  [[nodiscard]] bool is_lock(const std::optional<Ball>& frequency_error) const;
  /// The requirements of [require].
  [[nodiscard]] const std::vector<Requirement>& required() const { return required_; }
  /// Returns the claim with its sentence. Objects to a claim of this kind that the promises do not prove.
  [[nodiscard]] Claim check(const Tree& claim, const Promises& promises, Objections& objections) const;

 private:
  struct Number {
    std::string text;  ///< with its unit
    Ball value;
  };
  static Number required_number(const std::string& name, const Tree& value, const Tree& assume,
                                Objections& objections);
  [[nodiscard]] std::string tone(bool disturbed) const;
  [[nodiscard]] std::string hypotheses(const Promises& promises) const;
  [[nodiscard]] std::string short_text(const std::string& id) const;
  [[nodiscard]] Claim frequency_error(const Promises& promises) const;
  [[nodiscard]] Claim settling(const Promises& promises) const;
  [[nodiscard]] Claim size(const std::string& id, const Promises& promises) const;
  [[nodiscard]] Claim sentence(const Tree& claim, const Promises& promises) const;
  [[nodiscard]] Claim invariant_set(const Tree& claim, const Promises& promises) const;
  [[nodiscard]] Claim limits(const Tree& claim, const Promises& promises) const;
  [[nodiscard]] bool frequency_walks() const;
  [[nodiscard]] std::string stretch_of_samples() const;
  [[nodiscard]] std::string gaussian_disturbance() const;
  [[nodiscard]] Claim losing_lock(const Promises& promises) const;
  [[nodiscard]] Claim mean_square(const Promises& promises) const;
  [[nodiscard]] Claim lock_sentence(const Tree& claim, const Promises& promises) const;
  [[nodiscard]] Claim lowest_snr(const Tree& claim, const Promises& promises) const;

  const Tree& design_;
  Wording wording_;
  std::vector<Requirement> required_;
  std::optional<Number> frequency_error_below_, settles_within_, settled_below_, noise_, slew_, reach_,
      losing_lock_, rms_;
  Ball amplitude_, assumed_noise_, start_error_;
  FrequencyWords words_;
  std::string lock_limit_;  ///< rad/sample, a decimal
  std::string other_snr_;   ///< dB, the subject of sentences in place of the assumed noise; or empty
};

}  // namespace veritrack::checker
