// Tubes around the curve of a tracker, as a certificate writes them. Any numbers are valid: they are
// evidence.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// The most powers of z in a series, z^0 included: what is read has no more.
inline constexpr std::size_t kMostPowers = 32;

/// Re sum_h sum_d c[h][d] z^d exp(i h phi). Nothing: 0.
using PhaseSeries = std::vector<std::vector<std::complex<double>>>;

/// The room that bounds of a covariance leave at each sample, as a share of themselves, and how many times as
/// wide the bounds are from which they are reached.
struct LongRunEntry {
  double margin = 0.0;  ///< in (0, 1)
  double ratio = 0.0;   ///< at least 1
};

/// C(phi, omega) + U(phi, omega) xi, |xi| <= R, over the frequencies |omega - frequency| <= half_width,
/// where C(phi, omega) = turns phi + curve and U is lower triangular; rad/sample.
struct PhaseTube {
  double frequency = 0.0;
  double half_width = 0.0;        ///< z = (omega - frequency)/half_width
  std::vector<double> levels;     ///< R_0 > R_1 > ... > R_m > 0
  std::vector<double> shrinking;  ///< of the levels between neighbours, in (0, 1]; for m = 0 of R_0
  std::vector<long> turns;
  std::vector<PhaseSeries> curve;
  std::vector<PhaseSeries> shape;  ///< the lower triangle, row by row
  /// For a filter: bounds, in the order of symmetric matrices, of the covariance that is predicted for the
  /// sample at the phase; lower triangles, row by row. Curve and shape are then those of the estimate.
  /// Otherwise empty.
  std::vector<PhaseSeries> covariance_low, covariance_high;
  /// For a tube in the long run: how its bounds of the covariance are reached (long_run.hpp). Otherwise none.
  std::optional<LongRunEntry> entry;
  std::size_t phases = 1;  ///< parts of a turn, and of the frequencies, to begin with
  std::size_t frequencies = 1;
};

/// The ends of its frequencies.
Ball low_end(const PhaseTube& tube);
Ball high_end(const PhaseTube& tube);

/// Gaussian noise of a deviation in each sample (signal units), and the statement on tubes in it
/// (gaussian_drift.hpp).
struct GaussianTerms {
  double deviation = 0.0;
  double most_noise = 0.0;  ///< V, signal units: longer errors of a sample count as a loss
  double exponent = 0.0;    ///< L
  double factor = 0.0;      ///< kappa
  double constant = 0.0;    ///< c_0
};

/// Amplitudes from low to high, in signal units, of which every sample may have another one.
struct AmplitudePart {
  double low = 0.0;
  double high = 0.0;
};

/// Tubes for the frequencies of a band, for noise up to `noise` (signal units) and slew up to `slew`
/// (rad/sample per sample).
struct TubeSet {
  std::string name;
  /// For a constant amplitude that is known to be in a range: the part of that range for which the tubes are.
  std::optional<AmplitudePart> amplitudes;
  double slew = 0.0;
  double noise = 0.0;
  std::optional<GaussianTerms> gaussian;  ///< then there is no noise and no slew besides, and one level
  std::vector<double> crossing;           ///< of relative levels at the borders of cells; with slew only
  /// For filters, with a slew: the share of themselves that bounds of the covariance leave at every step, and
  /// may lose at a border.
  double margin = 0.0;
  std::vector<PhaseTube> tubes;
};

/// Whether the tubes are those of a filter's estimate, with bounds of its covariance. Either all are or none.
inline bool bounds_covariance(const TubeSet& set) {
  return !set.tubes.empty() && !set.tubes.front().covariance_high.empty();
}

/// The set of the long run, inside another one (long_run.hpp).
inline constexpr const char* kLongRun = "long-run";

/// The number of pairs of neighbouring levels of a tube; one if there is one level.
inline std::size_t pairs_of(const PhaseTube& tube) {
  return tube.levels.size() > 1 ? tube.levels.size() - 1 : 1;
}

/// Reads a set for a tracker with `states` states, of which `estimated` are a filter's estimate (0: not a
/// filter). Objects to what cannot be a set: levels or rates out of order, widths that are not positive,
/// wrong numbers of states. Throws Malformed or std::invalid_argument for what cannot be read.
TubeSet read_tube_set(const Tree& set, std::size_t states, Objections& objections, std::size_t estimated = 0);

/// Objects unless the tubes go from low frequencies to high ones, without gaps.
void check_order(const TubeSet& set, Objections& objections);

/// Whether tubes in this order cover [lowest, highest].
bool covers(const TubeSet& set, const Ball& lowest, const Ball& highest CHECKER_PLACE);

}  // namespace veritrack::checker
