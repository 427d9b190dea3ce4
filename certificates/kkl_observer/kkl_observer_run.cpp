// The KKL observer run on samples.
#include "certificates/kkl_observer/kkl_observer_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/kkl_observer/kkl_ell.hpp"
#include "analysis/kkl_observer/number_of_filters.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/kkl_observer/kkl_observer.hpp"
#include "certificates/kkl_observer/kkl_observer_design.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::certificates {

namespace {

using trackers::KklObserver;
using trackers::KklObserverDesign;

template <int M>
class KklRun : public TrackerRun {
 public:
  KklRun(const KklObserverDesign<double, M>& design, double interval)
      : design_(design), interval_(interval), observer_(design, interval) {}

  [[nodiscard]] int channels() const override { return 1; }
  [[nodiscard]] bool has_innovation() const override { return false; }

  /// From rest, along the tone that reaches the first sample, until its slowest filter has settled.
  void start(const ToneAtSample& first) override {
    constexpr double kTimeConstants = 30.0;
    constexpr double kMost = 1e6;
    const double settling = kTimeConstants / (design_.lambda.minCoeff() * interval_);
    const int length = static_cast<int>(std::clamp(std::ceil(settling), 1.0, kMost));
    observer_ = KklObserver<double, M>(design_, interval_);
    const auto tone = [&](int k) { return first.amplitude * std::cos(first.phase + k * first.frequency); };
    last_ = tone(-length - 1);
    for (int k = -length; k < 0; ++k) {
      const double sample = tone(k);
      observer_.step_interpolated(last_, sample);
      last_ = sample;
    }
  }

  [[nodiscard]] TrackerOutput step(std::span<const double> sample) override {
    observer_.step_interpolated(last_, sample[0]);
    last_ = sample[0];
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    // Where the estimate of the squared frequency is negative, there is no frequency: 0, which is not a lock.
    const double squared = observer_.state()(2);
    const double frequency = std::isnan(squared) ? kNone : std::sqrt(std::max(0.0, squared)) * interval_;
    return {frequency, kNone, {kNone, kNone}, kNone};
  }

  [[nodiscard]] std::optional<TrackerOutput> predict() override { return std::nullopt; }

 private:
  KklObserverDesign<double, M> design_;
  double interval_;
  KklObserver<double, M> observer_;
  double last_ = 0.0;
};

/// The one of the design, or the lower end of the proved one.
double ell_of(const KklObserverTables& tables) {
  if (tables.design.ell) {
    return tables.design.ell->nearest;
  }
  const double ell = [&] {
    const rigor::UpwardRounding upward;
    return kkl_observer::with_number_of_filters(tables.design.lambda.size(), [&](auto filters) {
      return kkl_observer::enclose_ell(kkl_range<decltype(filters)::value>(tables)).value().lower();
    });
  }();
  if (!(ell > 0.0)) {
    throw NotTrackable("no ell above 0 was proved for this design; allowed: ell under [design]");
  }
  return ell;
}

std::unique_ptr<TrackerRun> run_of(const KklObserverTables& tables, double ell) {
  return kkl_observer::with_number_of_filters(
      tables.design.lambda.size(), [&](auto filters) -> std::unique_ptr<TrackerRun> {
        constexpr int kSize = decltype(filters)::value;
        KklObserverDesign<double, kSize> design;
        for (int i = 0; i < kSize; ++i) {
          design.lambda(i) = tables.design.lambda[static_cast<std::size_t>(i)].nearest;
        }
        design.ell = ell;
        return std::make_unique<KklRun<kSize>>(design, tables.design.sampling_interval->nearest);
      });
}

}  // namespace

TrackerOnSamples kkl_observer_on_samples(const Design& design) {
  const KklObserverTables& tables = kkl_observer_tables(design);
  if (!tables.design.sampling_interval) {
    throw NotTrackable(
        "an observer in continuous time; allowed with samples: sampling_interval under [design], in s");
  }
  const double ell = ell_of(tables);
  const rigor::NearestRounding nearest;
  const double interval = tables.design.sampling_interval->nearest;
  SignalAssumptions assume;
  assume.amplitude = {tables.assume.amplitude[0].nearest, tables.assume.amplitude[1].nearest};
  assume.frequency = {tables.assume.frequency[0].nearest * interval,
                      tables.assume.frequency[1].nearest * interval};
  assume.noise = 0.0;
  if (tables.assume.disturbance) {
    const KklDisturbance& disturbance = *tables.assume.disturbance;
    assume.noise = disturbance.bound ? disturbance.bound->nearest : disturbance.amplitude->nearest;
  }
  assume.slew = 0.0;
  assume.sample_rate = 1.0 / interval;
  assume.start = {"the filters have settled"};
  return {run_of(tables, ell), assume};
}

}  // namespace veritrack::certificates
