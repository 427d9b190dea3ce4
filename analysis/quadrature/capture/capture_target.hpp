// The target that a set of starts must reach to count as captured.
#pragma once

#include <optional>

#include "analysis/quadrature/capture/capture_enclosure.hpp"
#include "analysis/quadrature/contraction/certified_set.hpp"

namespace veritrack::quadrature {

/// How states lie in a target.
struct Settled {
  int turns = 0;       ///< k when they do with 2 pi k subtracted from the frequency error; 0 is capture
  double level = 0.0;  ///< an upper bound on their |T e|, at most the radius of the set
};

/// A set of states, of amplitude 1 in the frame of the true phase
/// (trackers/quadrature/quadrature_rotating_frame.hpp), that the tracker is known never to leave.
class CaptureTarget {
 public:
  CaptureTarget() = default;
  virtual ~CaptureTarget() = default;
  CaptureTarget(const CaptureTarget&) = delete;
  CaptureTarget& operator=(const CaptureTarget&) = delete;
  CaptureTarget(CaptureTarget&&) = delete;
  CaptureTarget& operator=(CaptureTarget&&) = delete;

  /// When it is certain that every state of the enclosure, with 2 pi k subtracted from its frequency error,
  /// lies in the set: k = 0 is capture, another k is a lock at a wrong frequency. Nothing otherwise. Needs
  /// the upward mode. Called from several threads at once.
  [[nodiscard]] virtual std::optional<Settled> settled(const StateEnclosure& states) const = 0;
};

/// The certified set of the polar frame. A shift by 2 pi k is tried only when `periodic`, which is true for
/// epsilon = 0: the frequency error then acts through its sine and cosine alone.
class CertifiedSetTarget final : public CaptureTarget {
 public:
  CertifiedSetTarget(const CertifiedSet& set, bool periodic) : set_(set), periodic_(periodic) {}
  [[nodiscard]] std::optional<Settled> settled(const StateEnclosure& states) const override;

 private:
  CertifiedSet set_;
  bool periodic_;
};

}  // namespace veritrack::quadrature
