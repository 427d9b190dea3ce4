// A design file, read: what the engineer chose, what is known, what is required; every number with the
// interval it stands for and the place it came from.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analysis/rigor/interval.hpp"

namespace veritrack::certificates {

/// A place in a design file, both from 1; line 0 where there is none (a default).
struct Position {
  int line = 0;
  int column = 0;
};

/// A number of a design file.
struct Number {
  rigor::Interval value;  ///< the tightest interval that holds the decimal and the double nearest to it
  double nearest = 0.0;   ///< the double nearest to the decimal: what the filter runs with
  std::string text;       ///< as written in the file
  Position position;
};

/// True only when both are certainly the same real number: the same decimal, or the same double exactly.
[[nodiscard]] inline bool same_number(const Number& a, const Number& b) {
  return a.text == b.text || a.value == b.value;
}

/// [design] of the quadrature tracker: Q = diag(q1, q1, q2), R = r I (signal units squared, q2 in
/// (rad/sample)^2).
struct QuadratureEkfDesign {
  Number q1, q2, r, epsilon;
};

/// [design] of the single-channel tracker: Q = diag(q1, q1, q2) in one of three readings.
struct SingleChannelEkfDesign {
  enum class ProcessNoise { frequency_only, identity, diagonal };
  ProcessNoise process_noise = ProcessNoise::identity;
  std::optional<std::array<Number, 2>> variances;  ///< {q1, q2}, with ProcessNoise::diagonal only
  std::optional<Number> q;                         ///< with the other two, unless lambda is given
  std::optional<Number> r;                         ///< signal units squared, unless lambda is given
  std::optional<Number> lambda;                    ///< r/q: then q = 1 and r = lambda
  Number epsilon;
};

/// What P(0|0) is, in the frame of the estimated phase: the filter's steady state, or a symmetric positive
/// definite matrix, row by row.
using CovarianceArray = std::array<std::array<Number, 3>, 3>;

/// [assume].
struct Assumptions {
  Number amplitude;                 ///< signal units
  std::array<Number, 2> frequency;  ///< [lowest, highest], rad/sample
  Number noise;                     ///< |v(k)| <= noise for every k, signal units
  Number slew;                      ///< |omega(k+1) - omega(k)| <= slew, rad/sample per sample
  Number initial_frequency_error;   ///< rad/sample
  Number initial_phase_error;       ///< rad
  Number initial_amplitude_error;   ///< signal units
  std::optional<CovarianceArray> initial_covariance;  ///< none: "steady-state"
};

/// [require]: what CI must find PROVED.
struct Requirements {
  std::optional<Number> frequency_error_below;            ///< rad/sample, for ever
  std::optional<Number> settles_within;                   ///< samples to come within twice the ultimate bound
  std::optional<Number> largest_noise_at_least;           ///< signal units, at a constant frequency
  std::optional<Number> largest_slew_at_least;            ///< rad/sample per sample, without noise
  std::optional<Number> frequency_error_radius_at_least;  ///< rad/sample, of a set that is never left
};

/// [simulate]: the run that the audit and the figures use.
struct SimulationSettings {
  std::int64_t samples = 1000;
  std::uint64_t seed = 1;
  std::string signal = "constant";
};

/// [theorem_2_9]: the free parameters of the published theorem.
struct Theorem29Parameters {
  Number state_bound;     ///< R_x, signal units and rad/sample mixed, as in the thesis
  Number sigma;           ///< the thesis's "arbitrarily small" number
  Number gamma_fraction;  ///< gamma = gamma_fraction / (s p^2), in (0, 1)
  Number c1;              ///< |w| <= c1 sqrt(q2)
  Number c2;              ///< |v| <= c2 sqrt(r)
};

/// The tables of a design file for the tracker "quadrature-ekf".
struct QuadratureEkfTables {
  QuadratureEkfDesign design;
  Assumptions assume;
  Requirements require;
  SimulationSettings simulate;
  Theorem29Parameters theorem_2_9;
};

/// [design] of the KKL observer.
struct KklObserverDesign {
  std::vector<Number> lambda;  ///< filter rates, 1/s: four or more, positive and distinct
  std::optional<Number> ell;   ///< of (9) of the paper; none: the proved one
};

/// What may be added to the signal: nothing is known but a bound, or a sinusoid of at least that frequency.
struct KklDisturbance {
  std::optional<Number> bound;      ///< signal units
  std::optional<Number> amplitude;  ///< signal units, of the sinusoid
  std::optional<Number> frequency;  ///< rad/s, of the sinusoid
};

/// [assume] of the KKL observer.
struct KklAssumptions {
  std::array<Number, 2> frequency;  ///< [lowest, highest], rad/s
  std::array<Number, 2> amplitude;  ///< [lowest, highest], signal units
  std::optional<KklDisturbance> disturbance;
};

/// [require] of the KKL observer, from the settling time on.
struct KklRequirements {
  std::optional<Number> frequency_error_below;  ///< rad/s
  std::optional<Number> amplitude_error_below;  ///< signal units
  std::optional<Number> settles_within;         ///< s
};

/// The tables of a design file for the tracker "kkl-observer".
struct KklObserverTables {
  KklObserverDesign design;
  KklAssumptions assume;
  KklRequirements require;
};

/// The tables of a design file for the tracker "single-channel-ekf".
struct SingleChannelEkfTables {
  SingleChannelEkfDesign design;
  Assumptions assume;
  Requirements require;
  SimulationSettings simulate;
};

/// A design file: what every tracker's has, and the tables that go with the tracker. Another tracker brings
/// a struct of its tables, an alternative of the variant, its keys (design_keys.hpp) and a certify function.
struct Design {
  std::string name;
  std::string tracker;
  std::string source;
  std::variant<QuadratureEkfTables, KklObserverTables, SingleChannelEkfTables> tables;
  /// Where the value of each key that the file gives stands, by its path, e.g. "design.q1"; defaults are not
  /// in it.
  std::map<std::string, Position> positions;

  /// The tables of that tracker. Throws std::bad_variant_access for a design of another tracker.
  [[nodiscard]] const QuadratureEkfTables& quadrature_ekf() const {
    return std::get<QuadratureEkfTables>(tables);
  }
  [[nodiscard]] const KklObserverTables& kkl_observer() const { return std::get<KklObserverTables>(tables); }
  [[nodiscard]] const SingleChannelEkfTables& single_channel_ekf() const {
    return std::get<SingleChannelEkfTables>(tables);
  }
};

}  // namespace veritrack::certificates
