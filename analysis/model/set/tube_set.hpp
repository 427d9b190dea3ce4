// Tubes over a band of frequencies, with the levels that are proved for them.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/model/filter/long_run_entry.hpp"
#include "analysis/model/tube/frequency_cells.hpp"
#include "analysis/model/tube/tube_errors.hpp"
#include "analysis/model/tube/tube_verification.hpp"

namespace veritrack::model {

/// A tube, and its levels R_0 > R_1 > ... > R_m. With m = 0: |F| <= shrinking[0] R_0 for all |xi| <= R_0.
/// Otherwise |F| <= shrinking[j] r for all |xi| <= r and all r from R_{j+1} to R_j: levels shrink by that
/// factor a sample until R_m, and stay below.
struct ProvedTube {
  Tube tube;
  std::vector<double> levels;
  std::vector<double> shrinking;
  VerificationBudget grid;          ///< the first grid of the verification
  std::size_t cells = 0;            ///< that it needed
  ShapeParameters parameters = {};  ///< of the proposal; not evidence
  /// For sets for the largest disturbance, where it was searched for: the disturbance that this tube alone
  /// tolerates, proved like the set (a slew as long as the frequency stays in its cell); otherwise 0. Not
  /// evidence.
  double own_noise = 0.0, own_slew = 0.0;
  /// For a filter's tube in the long run: how it is entered.
  std::optional<LongRunEntry> entry = {};
};

/// The purpose of a set.
struct SetTask {
  std::string name;
  ShapeObjective objective = ShapeObjective::largest_starts;
  double noise = 0.0;          ///< V, signal units
  double slew = 0.0;           ///< W, rad/sample per sample
  bool largest_noise = false;  ///< search for the largest V, at a constant frequency
  bool largest_slew = false;   ///< search for the largest W, with the V that is given
  bool of_each_cell = false;   ///< also search for the largest that each cell alone tolerates, which takes
                               ///< longer
  bool with_curve = false;     ///< levels down to the accuracy of the curve, for the bias
  Eigen::VectorXd deviations;  ///< of starts, one for each state; or empty
  /// The requested frequency error, rad/sample, or 0: tubes of a filter whose covariance is bounded are no
  /// larger. (Others have levels that are as good.)
  double largest_error = 0.0;
  search::Deadline deadline = {};  ///< after which nothing more is proved
  /// In searches for the largest: the disturbance that another set tolerates, with which they begin where
  /// they find nothing else.
  double known_noise = 0.0, known_slew = 0.0;
};

/// Gaussian noise, and the inequality that is proved for every tube of a set (gaussian_drift.hpp), with
/// R = levels[0]: E[exp(exponent (l+/R)^2); |v| <= most_noise] <= factor exp(exponent (l/R)^2) + constant.
struct GaussianTerms {
  double deviation = 0.0;   ///< of each sample, at most, signal units
  double most_noise = 0.0;  ///< V, of all samples together, signal units
  double exponent = 0.0;    ///< L
  double factor = 1.0;      ///< kappa, below 1
  double constant = 0.0;    ///< c0
};

/// low < high, rad/sample.
struct FrequencyRange {
  double low = 0.0;
  double high = 0.0;
};

/// The tubes of a set that are for a part of a range of constant amplitudes (amplitude_parts.hpp).
struct AmplitudePart {
  double low = 0.0, high = 0.0;       ///< low < high, signal units
  std::size_t first = 0;              ///< of its tubes, which go from low frequencies to high ones
  std::size_t end = 0;                ///< and after the last one
  std::vector<double> crossing = {};  ///< with a slew: of borders between its tubes
  double covariance_margin = 0.0;     ///< likewise, of filters
};

/// A set of tubes that covers a band, or the widest part of it for which tubes without gaps were proved.
struct TubeSet {
  std::string name;
  double noise = 0.0;  ///< V, signal units
  double slew = 0.0;   ///< W, rad/sample per sample; 0: constant frequencies
  std::vector<ProvedTube> tubes;
  /// For Gaussian noise: one level in each tube, and no statement that no state leaves it; V is 0 here.
  std::optional<GaussianTerms> gaussian;
  /// With a slew, for each pair of levels: the factor of levels at borders of cells, after the step's
  /// shrinking (docs/model-proof.md, section 4).
  std::vector<double> crossing;
  /// For filters, with a slew: the share of themselves that their bounds of the covariance leave at every
  /// step, and may lose at a border.
  double covariance_margin = 0.0;
  bool is_complete = false;          ///< every frequency of the band has a tube
  std::vector<std::string> reasons;  ///< otherwise: which part has none, and why
  FrequencyRange part;               ///< with tubes: the part of the band that they cover, rounded inward
  /// For an amplitude that is constant and somewhere in a range: the parts of the range, without gaps, each
  /// with its own tubes and its own data for a slew. Otherwise empty.
  std::vector<AmplitudePart> amplitudes;
  /// All parts of the band for which tubes were proved, also those that were given up for a wider one.
  std::vector<FrequencyRange> parts;
};

/// Called with the share of the band that is done.
using SetProgress = std::function<void(double share)>;

/// For low <= omega <= high, rad/sample, all of them covered when complete. Deterministic up to the deadline,
/// whatever the number of threads. Throws std::invalid_argument unless 0 < low < high < pi.
[[nodiscard]] TubeSet prove_set(const TrackedTone& tone, const TrackerModel& model, double low, double high,
                                const SetTask& task, const SetProgress& progress = {});

/// Tubes of a filter in the long run, for the noise of `set`, inside the lowest levels of its tubes: one for
/// each of them, of the same frequencies (docs/model-proof.md, Theorem 6). Empty unless they are proved for
/// all.
[[nodiscard]] std::optional<TubeSet> prove_long_run_set(const TrackedTone& tone, const TrackerModel& model,
                                                        const TubeSet& set, const search::Deadline& deadline);

/// An upper bound on the number of samples after which a start of level R_0 is at level R_`level`.
/// `crossing`: of its set.
[[nodiscard]] double samples_until(const ProvedTube& proved, std::size_t level,
                                   const std::vector<double>& crossing = {});
/// An upper bound on the number of samples after which a start of level R_0 of `around` is at the level
/// `level` of a tube in the long run inside it.
[[nodiscard]] double samples_until_long_run(const ProvedTube& around, const ProvedTube& inner,
                                            std::size_t level);

}  // namespace veritrack::model
