// The adaptive notch filters.
#include "python/trackers/recordings.hpp"
#include "trackers/notch/adaptive_notch.hpp"

namespace veritrack::python {

namespace {

struct RealNotchTracker {
  static constexpr std::size_t kChannels = 1;
  static constexpr std::size_t kValues = 2;

  trackers::RealNotch<double> notch;

  /// (frequency in rad/sample, what the notch left).
  Said<1, 2> step(const double* sample) {
    if (std::isnan(*sample)) {
      throw std::invalid_argument("a notch filter cannot go on without a sample (NaN)");
    }
    notch.step(*sample);
    return {{notch.frequency(), notch.error()}, kNone, {notch.error()}, kNone};
  }
};

struct QuadratureNotchTracker {
  static constexpr std::size_t kChannels = 2;
  static constexpr std::size_t kValues = 3;

  trackers::QuadratureNotch<double> notch;

  /// (frequency in rad/sample, what the notch left in phase and in quadrature).
  Said<2, 3> step(const double* sample) {
    if (std::isnan(sample[0]) || std::isnan(sample[1])) {
      throw std::invalid_argument("a notch filter cannot go on without a sample (NaN)");
    }
    notch.step(sample[0], sample[1]);
    const auto error = notch.error();
    return {{notch.frequency(), error.real(), error.imag()}, kNone, {error.real(), error.imag()}, kNone};
  }
};

/// `design`: (size, 4), rho, mu, p and the first estimate of the frequency in rad/sample.
template <typename Tracker, typename Notch>
std::vector<Tracker> notch_trackers(const Array& design) {
  require_shape(design, 4);
  std::vector<Tracker> trackers;
  for (std::size_t i = 0; i < static_cast<std::size_t>(design.shape(0)); ++i) {
    const double* chosen = row_of(design, i);
    trackers.push_back({Notch({chosen[0], chosen[1], chosen[2]}, chosen[3])});
  }
  return trackers;
}

}  // namespace

void bind_notches(py::module_& module) {
  bind_batch(module, "RealNotchBatch", notch_trackers<RealNotchTracker, trackers::RealNotch<double>>);
  bind_batch(module, "QuadratureNotchBatch",
             notch_trackers<QuadratureNotchTracker, trackers::QuadratureNotch<double>>);
}

}  // namespace veritrack::python
