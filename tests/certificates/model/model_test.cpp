#include "certificates/model/model.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/design_reader.hpp"
#include "tests/support/random.hpp"
#include "trackers/quadrature/quadrature_ekf.hpp"
#include "trackers/single_channel/single_channel_ekf.hpp"

namespace veritrack::certificates {
namespace {

Model read(const std::string& text) {
  const rigor::UpwardRounding upward;
  const Design design = read_design("name = 'a'\ntracker = 'model'\n" + text, "design.toml");
  const ModelTables& tables = model_tables(design);
  return make_model(tables.model, tables.assume.signal);
}

std::string message(const std::string& text) {
  try {
    (void)read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<double> nearest(const Model& model) {
  std::vector<double> values;
  values.reserve(model.constants.size());
  for (const language::Constant& constant : model.constants) {
    values.push_back(constant.nearest);
  }
  return values;
}

std::string filter(const std::string& samples, const std::string& measure, const std::string& noise) {
  return "[model]\nsamples = " + samples +
         "\nparameters = { q = 0.004, r = 0.03 }\nfrequency = 'w'\nstart = { x1 = 'A', x2 = 0, w = 'omega' "
         "}\n"
         "[model.ekf]\nstates = ['x1', 'x2', 'w']\npredict = '''\nx1' = cos(w)*x1 - sin(w)*x2\n"
         "x2' = sin(w)*x1 + cos(w)*x2\nw' = w\n'''\nmeasure = " +
         measure + "\nQ = [['q', 0, 0], [0, 'q', 0], [0, 0, 'q']]\nR = " + noise +
         "\n[assume]\nfrequency = [1, 2]\nnoise = 0\n";
}

/// The state of the written-out filter that begins as the given estimate and covariance.
std::vector<double> state_of(double in_phase, double quadrature, double frequency, const Eigen::Matrix3d& p) {
  return {in_phase, quadrature, frequency, p(0, 0), p(0, 1), p(0, 2), p(1, 1), p(1, 2), p(2, 2)};
}

const Eigen::Matrix3d kStartCovariance =
    (Eigen::Matrix3d() << 0.05, 0.01, 0.0, 0.01, 0.04, 0.005, 0.0, 0.005, 0.02).finished();

TEST_CASE("the filter written out from its model is the single-channel tracker") {
  const Model model = read(filter("'y'", "'x1'", "'r'"));
  using trackers::FactoredCovariance;
  trackers::SingleChannelEkf<double> tracker(
      {.process_noise = trackers::identity_process_noise(0.004), .r = 0.03, .epsilon = 0.0},
      {.in_phase = 1.0,
       .quadrature = 0.1,
       .frequency = 0.5,
       .covariance = FactoredCovariance<double>::from_matrix(kStartCovariance)});
  trackers::ModelTracker<double> written(model.recursion, nearest(model),
                                         state_of(1.0, 0.1, 0.5, kStartCovariance));
  test::Random random(31);
  double largest = 0.0;
  for (int k = 1; k <= 300; ++k) {
    const double sample = std::cos(0.6 * k) + random.uniform(-0.1, 0.1);
    tracker.step(sample);
    written.step(std::span<const double>(&sample, 1));
    const Eigen::Matrix3d covariance = tracker.filtered().covariance.matrix();
    const std::vector<double> expected = state_of(tracker.filtered().in_phase, tracker.filtered().quadrature,
                                                  tracker.filtered().frequency, covariance);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      largest = std::max(largest, std::abs(written.state()[i] - expected[i]));
    }
  }
  CHECK(largest < 1e-12);
}

TEST_CASE("the filter written out from its model is the quadrature tracker") {
  const Model model = read(filter("['y1', 'y2']", "['x1', 'x2']", "[['r', 0], [0, 'r']]"));
  using trackers::FactoredCovariance;
  trackers::QuadratureEkf<double> tracker(
      {.q1 = 0.004, .q2 = 0.004, .r = 0.03, .epsilon = 0.0},
      {.in_phase = 1.0,
       .quadrature = 0.1,
       .frequency = 0.5,
       .covariance = FactoredCovariance<double>::from_matrix(kStartCovariance)});
  trackers::ModelTracker<double> written(model.recursion, nearest(model),
                                         state_of(1.0, 0.1, 0.5, kStartCovariance));
  test::Random random(32);
  double largest = 0.0;
  for (int k = 1; k <= 300; ++k) {
    const std::vector<double> samples{std::cos(0.6 * k) + random.uniform(-0.1, 0.1),
                                      std::sin(0.6 * k) + random.uniform(-0.1, 0.1)};
    tracker.step(samples[0], samples[1]);
    written.step(std::span<const double>(samples));
    const Eigen::Matrix3d covariance = tracker.filtered().covariance.matrix();
    const std::vector<double> expected = state_of(tracker.filtered().in_phase, tracker.filtered().quadrature,
                                                  tracker.filtered().frequency, covariance);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      largest = std::max(largest, std::abs(written.state()[i] - expected[i]));
    }
  }
  CHECK(largest < 1e-12);
}

/// A filter of one state with this formula to predict, run once: the covariance is F^2 P + Q, then halved by
/// R.
double predicted_variance(const std::string& formula, double x) {
  const Model model = read(
      "[model]\nsamples = 'y'\nfrequency = 'x'\nstart = { x = 'omega' }\nparameters = { c = 0.3 "
      "}\n[model.ekf]\n"
      "states = ['x']\npredict = '''\nx' = " +
      formula + "\n'''\nmeasure = '0*x + x'\nQ = [[0]]\nR = 1\n[assume]\nfrequency = [1, 2]\nnoise = 0\n");
  trackers::ModelTracker<double> tracker(model.recursion, nearest(model), {x, 1.0});
  const double sample = 0.0;
  tracker.step(std::span<const double>(&sample, 1));
  const double filtered = tracker.state()[1];  // p / (1 + p)
  return filtered / (1.0 - filtered);
}

TEST_CASE("derivatives are those of each function") {
  const double x = 0.37;
  const auto is = [&](const char* formula, double derivative) {
    CAPTURE(formula);
    CHECK(predicted_variance(formula, x) == doctest::Approx(derivative * derivative).epsilon(1e-12));
  };
  is("x", 1.0);
  is("-2.5*x", 2.5);
  is("c*x + x*x", 0.3 + 2 * x);
  is("x^2", 2 * x);
  is("x^5 + x^1", 5 * std::pow(x, 4) + 1);
  is("1/x", -1 / (x * x));
  is("x/(1 + x)", 1 / ((1 + x) * (1 + x)));
  is("sqrt(x)", 0.5 / std::sqrt(x));
  is("exp(2*x)", 2 * std::exp(2 * x));
  is("log(x)", 1 / x);
  is("sin(3*x)", 3 * std::cos(3 * x));
  is("cos(x)", -std::sin(x));
  is("tan(x)", 1 + std::tan(x) * std::tan(x));
  is("asin(x)", 1 / std::sqrt(1 - x * x));
  is("acos(x)", -1 / std::sqrt(1 - x * x));
  is("atan(2*x)", 2 / (1 + 4 * x * x));
  is("atan2(x, 2 + x)", 2 / ((2 + x) * (2 + x) + x * x));
  is("stays_within(x, -1, 1) - x/2", 0.5);
}

const std::string kRest = "\n[assume]\nfrequency = [0.2, 0.5]\nnoise = 0\n";

TEST_CASE("covariances of the noise whose entries do not mirror each other are refused") {
  const auto with = [](const std::string& q12, const std::string& q21, const std::string& r12) {
    std::string text = filter("['y', 'z']", "['x1', 'x2']", "[['r', " + r12 + "], [0, 'r']]");
    const std::string q = "Q = [['q', 0, 0], [0,";
    return text.replace(text.find(q), q.size(), "Q = [['q', " + q12 + ", 0], [" + q21 + ",");
  };
  CHECK(message(with("0", "0", "0")) == "no error");
  CHECK(message(with("'q/10'", "'0.1*q'", "0")) == "no error");
  CHECK(message(with("0.001", "'0.002 - q/4'", "0.0")) == "no error");
  CHECK(message(with("'q/10'", "'0.2*q'", "0")) ==
        "design.toml:16:26: Q is not symmetric: row 2, column 1 is 0.2*q, and row 1, column 2 is q/10; "
        "allowed: "
        "a covariance, whose entries mirror each other");
  CHECK(message(with("0", "0", "0.01"))
            .find("R is not symmetric: row 2, column 1 is 0, and row 1, column 2 "
                  "is 0.01; allowed:") != std::string::npos);
}

TEST_CASE("what is wrong with a model is told with its place in the file") {
  const std::string before = "[model]\nsamples = 'y'\nfrequency = 'w'\n";
  const std::string step = "states = ['w']\nstep = '''\nw' = w + y\n'''\n";
  CHECK(message(before + step + "start = { w = 'omega' }" + kRest) == "no error");
  CHECK(message(before + step + "start = { }" + kRest) ==
        "design.toml:8:1: the state w has no start; allowed: one for each of w");
  CHECK(message(before + step + "start = { w = 'omega', v = 1 }" + kRest) ==
        "design.toml:10:24: v is no state; nearest: w; allowed: w");
  CHECK(message(before + step + "start = { w = 'omega + y' }" + kRest) ==
        "design.toml:10:24: unknown name y; nearest known name: A; allowed: A, omega");
  CHECK(message(before + "states = ['w', 'w']\nstep = 'w = 1'\nstart = { }" + kRest) ==
        "design.toml:6:17: w is given twice; allowed: each name once");
  CHECK(message(before + "states = ['w']\nstart = { w = 1 }" + kRest) ==
        "design.toml:3:1: allowed: either states and step, or the table [model.ekf]");
  CHECK(message(before + step + "angles = ['v']\nstart = { w = 1 }" + kRest) ==
        "design.toml:10:12: v is no state; nearest: w; allowed: w");
  CHECK(message(before + step + "start = { w = \"om\\u0065ga\" }" + kRest)
            .starts_with("design.toml:10:15: model.start.w is with escapes"));
  CHECK(message(before + step + "start = { w = 1 }\n[assume]\nfrequency = { hz = [45, 55] }\nnoise = 0\n")
            .find("sample_rate") != std::string::npos);
  CHECK(message(before + step + "start = { w = 1 }" + kRest + "signal = ['A*cos(phi)', 'A*sin(phi)']\n")
            .find("2 formulas for the signal; allowed: as many as there are samples, 1") !=
        std::string::npos);
}

}  // namespace
}  // namespace veritrack::certificates
