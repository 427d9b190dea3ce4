// The adaptive notch filters of designs/models against the code of trackers/notch: the same step.
#include "trackers/notch/adaptive_notch.hpp"

#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <string>

#include "analysis/model/step/point_tube.hpp"
#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_sets.hpp"
#include "tests/support/random.hpp"

namespace veritrack::certificates {
namespace {

constexpr int kNotchSamples = 400;

/// A design of designs/models, its step in doubles.
class DesignedStep {
 public:
  explicit DesignedStep(const std::string& name) {
    const rigor::UpwardRounding upward;
    design_ = read_design_file(std::string(VERITRACK_SOURCE_DIR "/designs/models/") + name);
    const ModelTables& tables = model_tables(design_);
    model_ = make_model(tables.model, tables.assume.signal);
    tracker_ = proved_model(model_, tables.assume);
  }
  [[nodiscard]] model::PointTracker points() const { return model::PointTracker(tracker_); }

 private:
  Design design_;
  Model model_;
  model::TrackerModel tracker_;
};

TEST_CASE("the quadrature notch as a model takes the step of its code") {
  const DesignedStep designed("quadrature-notch.toml");
  model::PointTracker points = designed.points();
  REQUIRE(points.states() == 7);
  REQUIRE(points.channels() == 2);
  trackers::QuadratureNotch<double> notch({.rho = 0.9, .mu = 0.0002, .p = 2.0}, 0.55);
  Eigen::VectorXd state = Eigen::VectorXd::Zero(7);
  state[6] = 0.55;
  test::Random random(4471);
  for (int k = 0; k < kNotchSamples; ++k) {
    const std::complex<double> sample =
        std::polar(1.0, 0.57 * k) +
        std::complex<double>(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2));
    state = points.next(state, Eigen::Vector2d(sample.real(), sample.imag()));
    notch.step(sample.real(), sample.imag());
    CAPTURE(k);
    REQUIRE(std::abs(std::complex<double>(state[2], state[3]) - notch.error()) < 1e-11);
    REQUIRE(std::abs(std::complex<double>(state[4], state[5]) - notch.gradient()) < 1e-10);
    REQUIRE(std::fabs(points.frequency(state) - notch.frequency()) < 1e-12);
  }
  CHECK(std::fabs(notch.frequency() - 0.57) < 0.01);  // it moved, and to the tone
}

TEST_CASE("the real notch as a model takes the step of its code") {
  const DesignedStep designed("pei-tseng-notch.toml");
  model::PointTracker points = designed.points();
  REQUIRE(points.states() == 7);
  // The model's mu has the factor p.
  trackers::RealNotch<double> notch({.rho = 0.95, .mu = 0.0005, .p = 2.0}, 0.55);
  Eigen::VectorXd state = Eigen::VectorXd::Zero(7);
  state[6] = -2.0 * std::cos(0.55);
  test::Random random(4472);
  for (int k = 0; k < kNotchSamples; ++k) {
    const double sample = std::cos(0.57 * k) + random.uniform(-0.2, 0.2);
    state = points.next(state, Eigen::Matrix<double, 1, 1>(sample));
    notch.step(sample);
    CAPTURE(k);
    REQUIRE(std::fabs(state[2] - notch.error()) < 1e-10);
    REQUIRE(std::fabs(state[4] - notch.gradient()) < 1e-9);
    REQUIRE(std::fabs(points.frequency(state) - notch.frequency()) < 1e-11);
  }
}

}  // namespace
}  // namespace veritrack::certificates
