// The single-channel tracker run on samples.
#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "certificates/sets/signal_assumptions.hpp"
#include "certificates/single_channel/single_channel.hpp"
#include "certificates/single_channel/single_channel_design.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"
#include "trackers/single_channel/single_channel_rotating_frame.hpp"

namespace veritrack::certificates {

namespace {

class SingleChannelRun : public TrackerRun {
 public:
  explicit SingleChannelRun(const SingleChannelEkfTables& tables)
      : tables_(tables), model_(model_of(tables.design)), tracker_(model_, {}) {}

  [[nodiscard]] int channels() const override { return 1; }
  [[nodiscard]] bool has_innovation() const override { return true; }

  void start(const ToneAtSample& first) override {
    const double phase = first.phase - first.frequency;  // of the sample before
    const auto covariance = trackers::FactoredCovariance<double>::from_matrix(
        run_start_covariance(tables_, first.frequency, phase));
    tracker_ = trackers::SingleChannelEkf<double>(
        model_, {first.amplitude * std::cos(phase), first.amplitude * std::sin(phase), first.frequency,
                 turned(covariance, std::sin(phase), std::cos(phase))});
  }

  [[nodiscard]] TrackerOutput step(std::span<const double> sample) override {
    tracker_.step(sample[0]);
    const trackers::SingleChannelEstimate<double>& predicted = tracker_.predicted();
    const trackers::FactoredCovariance<double>& p = predicted.covariance;
    const double variance =
        p.conditional_11 + p.frequency_variance * p.regression_1 * p.regression_1 + model_.r;
    const double innovation = sample[0] - predicted.in_phase;
    return {tracker_.filtered().frequency,
            std::sqrt(tracker_.filtered().covariance.frequency_variance),
            {innovation, NAN},
            innovation * innovation / variance};
  }

  [[nodiscard]] std::optional<TrackerOutput> predict() override {
    tracker_.time_update();
    tracker_ = trackers::SingleChannelEkf<double>(model_, tracker_.predicted());
    const trackers::SingleChannelEstimate<double>& estimate = tracker_.filtered();
    return TrackerOutput{
        estimate.frequency, std::sqrt(estimate.covariance.frequency_variance), {NAN, NAN}, NAN};
  }

 private:
  static trackers::SingleChannelEkfDesign<double> model_of(const SingleChannelDesignTable& table) {
    return trackers::single_channel_design(nearest_values(table));
  }

  SingleChannelEkfTables tables_;
  trackers::SingleChannelEkfDesign<double> model_;
  trackers::SingleChannelEkf<double> tracker_;
};

}  // namespace

TrackerOnSamples single_channel_on_samples(const Design& design) {
  const rigor::NearestRounding nearest;
  const SingleChannelEkfTables& tables = single_channel_tables(design);
  return {std::make_unique<SingleChannelRun>(tables), signal_assumptions(tables.assume)};
}

}  // namespace veritrack::certificates
