// The four filters of Zarchan's slides, and the subset averaged median filter that goes before a tracker.
#include <cstdint>
#include <vector>

#include "python/trackers/recordings.hpp"
#include "trackers/sam/sam_filter.hpp"
#include "trackers/zarchan/zarchan_ekf.hpp"

namespace veritrack::python {

namespace {

/// `Frequency`: which state is the frequency, or its square.
template <typename Filter, std::size_t Size, int Frequency>
struct ZarchanTracker {
  static constexpr std::size_t kChannels = 1;
  static constexpr std::size_t kValues = Size;

  Filter filter;

  Said<1, Size> step(const double* sample) {
    if (std::isnan(*sample)) {
      throw std::invalid_argument("this filter cannot go on without a sample (NaN)");
    }
    filter.step(*sample);
    const auto& estimate = filter.filtered();
    Said<1, Size> said{{}, std::sqrt(estimate.covariance(Frequency, Frequency)), {kNone}, kNone};
    for (std::size_t i = 0; i < Size; ++i) {
      said.state[i] = estimate.state(static_cast<Eigen::Index>(i));
    }
    return said;
  }
};

using SinePhase = ZarchanTracker<trackers::SinePhaseEkf<double>, 3, 1>;
using SineKnownAmplitude = ZarchanTracker<trackers::SineKnownAmplitudeEkf<double>, 2, 1>;
using Oscillator = ZarchanTracker<trackers::OscillatorEkf<double>, 3, 2>;
using SquaredFrequency = ZarchanTracker<trackers::SquaredFrequencyEkf<double>, 3, 2>;

/// `design`: (size, 6), interval, measurement variance, frequency noise, amplitude noise, Euler steps, and
/// the amplitude where it is known; `state`: (size, states); `covariance`: (size, states^2).
template <typename Tracker>
std::vector<Tracker> zarchan_trackers(const Array& design, const Array& state, const Array& covariance) {
  constexpr auto kSize = static_cast<int>(Tracker::kValues);
  require_shape(design, 6);
  require_shape(state, Tracker::kValues);
  require_shape(covariance, Tracker::kValues * Tracker::kValues);
  std::vector<Tracker> trackers;
  for (std::size_t i = 0; i < static_cast<std::size_t>(design.shape(0)); ++i) {
    const double* chosen = row_of(design, i);
    const trackers::ZarchanDesign<double> made{chosen[0], chosen[1], chosen[2], chosen[3],
                                               static_cast<int>(chosen[4])};
    const trackers::ZarchanEstimate<double, kSize> start{
        Eigen::Map<const Eigen::Matrix<double, kSize, 1>>(row_of(state, i)),
        Eigen::Map<const Eigen::Matrix<double, kSize, kSize>>(row_of(covariance, i))};
    if constexpr (kSize == 2) {
      trackers.push_back({trackers::SineKnownAmplitudeEkf<double>(made, chosen[5], start)});
    } else {
      trackers.push_back({decltype(Tracker::filter)(made, start)});
    }
  }
  return trackers;
}

struct SamTracker {
  static constexpr std::size_t kChannels = 1;
  static constexpr std::size_t kValues = 1;

  trackers::SamFilter<double> filter;

  Said<1, 1> step(const double* sample) {
    if (std::isnan(*sample)) {
      throw std::invalid_argument("a median of what is no number (NaN) does not exist");
    }
    return {{filter.step(*sample)}, kNone, {kNone}, kNone};
  }
};

/// `subsets` and `weights`: (1, count); bit j - 1 of a subset stands for the j-th input from the oldest.
std::vector<SamTracker> sam_trackers(std::size_t size, std::size_t window, const Array& subsets,
                                     const Array& weights) {
  std::vector<trackers::MedianSubfilter<double>> subfilters;
  for (py::ssize_t i = 0; i < subsets.size(); ++i) {
    subfilters.push_back({static_cast<std::uint32_t>(subsets.data()[i]), weights.data()[i]});
  }
  return std::vector<SamTracker>(size, SamTracker{trackers::SamFilter<double>(window, subfilters)});
}

}  // namespace

void bind_zarchan_filters(py::module_& module) {
  bind_batch(module, "SinePhaseBatch", zarchan_trackers<SinePhase>);
  bind_batch(module, "SineKnownAmplitudeBatch", zarchan_trackers<SineKnownAmplitude>);
  bind_batch(module, "OscillatorBatch", zarchan_trackers<Oscillator>);
  bind_batch(module, "SquaredFrequencyBatch", zarchan_trackers<SquaredFrequency>);
  bind_batch(module, "SamBatch", sam_trackers);
}

}  // namespace veritrack::python
