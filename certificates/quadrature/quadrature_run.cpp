#include "certificates/quadrature/quadrature_run.hpp"

#include <cmath>

#include "analysis/rigor/rounding.hpp"
#include "certificates/quadrature/quadrature_design.hpp"
#include "certificates/quadrature/quadrature_simulation.hpp"
#include "certificates/sets/signal_assumptions.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"

namespace veritrack::certificates {

namespace {

class QuadratureRun : public TrackerRun {
 public:
  explicit QuadratureRun(const Design& design)
      : design_(design), model_(model_of(quadrature_tables(design).design)), tracker_(model_, {}) {}

  [[nodiscard]] int channels() const override { return 2; }
  [[nodiscard]] bool has_innovation() const override { return true; }

  void start(const ToneAtSample& first) override {
    const double phase = first.phase - first.frequency;  // of the sample before
    const Eigen::Matrix3d covariance =
        turned_covariance(run_start_covariance(design_, first.frequency).covariance, phase);
    tracker_ = trackers::QuadratureEkf<double>(
        model_, {first.amplitude * std::cos(phase), first.amplitude * std::sin(phase), first.frequency,
                 trackers::FactoredCovariance<double>::from_matrix(covariance)});
  }

  [[nodiscard]] TrackerOutput step(std::span<const double> sample) override {
    tracker_.step(sample[0], sample[1]);
    const trackers::QuadratureEstimate<double>& predicted = tracker_.predicted();
    const trackers::FactoredCovariance<double>& p = predicted.covariance;
    const double s11 = p.conditional_11 + p.frequency_variance * p.regression_1 * p.regression_1 + model_.r;
    const double s12 = p.conditional_12 + p.frequency_variance * p.regression_1 * p.regression_2;
    const double s22 = p.conditional_22 + p.frequency_variance * p.regression_2 * p.regression_2 + model_.r;
    const double v1 = sample[0] - predicted.in_phase;
    const double v2 = sample[1] - predicted.quadrature;
    const double nis = (s22 * v1 * v1 - 2.0 * s12 * v1 * v2 + s11 * v2 * v2) / (s11 * s22 - s12 * s12);
    return {tracker_.filtered().frequency,
            std::sqrt(tracker_.filtered().covariance.frequency_variance),
            {v1, v2},
            nis};
  }

  [[nodiscard]] std::optional<TrackerOutput> predict() override {
    tracker_.time_update();
    tracker_ = trackers::QuadratureEkf<double>(model_, tracker_.predicted());
    const trackers::QuadratureEstimate<double>& estimate = tracker_.filtered();
    return TrackerOutput{
        estimate.frequency, std::sqrt(estimate.covariance.frequency_variance), {NAN, NAN}, NAN};
  }

 private:
  static trackers::ToneModel<double> model_of(const QuadratureDesignTable& table) {
    return {table.q1.nearest, table.q2.nearest, table.r.nearest, table.epsilon.nearest};
  }

  Design design_;
  trackers::ToneModel<double> model_;
  trackers::QuadratureEkf<double> tracker_;
};

}  // namespace

TrackerOnSamples quadrature_on_samples(const Design& design) {
  const rigor::NearestRounding nearest;
  return {std::make_unique<QuadratureRun>(design), signal_assumptions(quadrature_tables(design).assume)};
}

}  // namespace veritrack::certificates
