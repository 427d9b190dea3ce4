// The bounds of a certified set from a level on: the largest errors after a number of samples.
#pragma once

#include "analysis/quadrature/contraction/certified_set.hpp"

namespace veritrack::quadrature {

/// An upper bound on |T e(k)|, sample by sample, of every start in the set with |T e(0)| <= level:
/// next_level of the one before, which tends to the ultimate level u. Every function needs the upward mode.
class CertifiedLevel {
 public:
  /// For noise |v| <= `noise` (relative to the amplitude) and slew |w| <= `slew` (rad/sample per sample),
  /// which must be within those of the set, which must have been certified. `level` is at most its radius.
  CertifiedLevel(const CertifiedSet& set, const rigor::Interval& level, const rigor::Interval& noise,
                 const rigor::Interval& slew);

  /// An upper bound on |frequency error| now, rad/sample; infinite when there is none.
  [[nodiscard]] double frequency_error() const { return frequency_error_at(level_); }
  /// The same from now on for ever: a level below u may rise to it.
  [[nodiscard]] double largest_frequency_error() const;
  /// The same in the long run: that of u.
  [[nodiscard]] double ultimate_frequency_error() const { return frequency_error_at(ultimate_); }
  /// One sample on.
  void step();
  /// True only when this level is certainly at least that of the other, which is of the same set.
  [[nodiscard]] bool above(const CertifiedLevel& other) const {
    return certainly_less_equal(other.level_, level_);
  }
  /// A certain bound on |frequency error| from now on, rad/sample.
  [[nodiscard]] bool settled(double frequency_error) const {
    return largest_frequency_error() <= frequency_error;
  }

 private:
  [[nodiscard]] double frequency_error_at(const rigor::Interval& level) const;
  CertifiedSet set_;
  rigor::Interval level_;
  rigor::Interval noise_, slew_;
  rigor::Interval ultimate_;
};

}  // namespace veritrack::quadrature
