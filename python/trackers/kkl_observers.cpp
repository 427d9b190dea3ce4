// The KKL observer on samples, stepped along straight lines between them.
#include <string>

#include "python/trackers/recordings.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::python {

namespace {

template <int M>
struct KklTracker {
  static constexpr std::size_t kChannels = 1;
  static constexpr std::size_t kValues = 3;

  trackers::KklObserver<double, M> observer;
  double last = kNone;  ///< the sample before; none before the first

  /// (amplitude, phase, frequency in rad/s); NaN where the estimate is no frequency.
  Said<1, 3> step(const double* sample) {
    if (std::isnan(*sample)) {
      throw std::invalid_argument("the KKL observer cannot go on without a sample (NaN)");
    }
    if (!std::isnan(last)) {
      observer.step_interpolated(last, *sample);
    }
    last = *sample;
    const trackers::OscillatorEstimate<double> estimate = observer.estimate();
    return {{estimate.amplitude, estimate.phase, estimate.frequency}, kNone, {kNone}, kNone};
  }
};

/// `rates`: (size, M), 1/s; `design`: (size, 2), ell and the sampling interval in s.
template <int M>
std::vector<KklTracker<M>> kkl_trackers(const Array& rates, const Array& design) {
  require_shape(rates, M);
  require_shape(design, 2);
  std::vector<KklTracker<M>> trackers;
  for (std::size_t i = 0; i < static_cast<std::size_t>(design.shape(0)); ++i) {
    trackers::KklObserverDesign<double, M> chosen;
    chosen.lambda = Eigen::Map<const Eigen::Matrix<double, M, 1>>(row_of(rates, i));
    chosen.ell = row_of(design, i)[0];
    trackers.push_back({trackers::KklObserver<double, M>(chosen, row_of(design, i)[1])});
  }
  return trackers;
}

template <int M>
void bind(py::module_& module) {
  bind_batch(module, ("KklBatch" + std::to_string(M)).c_str(), kkl_trackers<M>);
}

}  // namespace

void bind_kkl_observers(py::module_& module) {
  bind<4>(module);
  bind<5>(module);
  bind<6>(module);
  bind<7>(module);
  bind<8>(module);
}

}  // namespace veritrack::python
