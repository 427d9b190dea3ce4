#include "papers/experiments/vibration_runs.hpp"

#include <cmath>
#include <complex>

#include "analysis/rigor/rounding.hpp"
#include "trackers/regulator/self_tuning_regulator.hpp"
#include "trackers/regulator/vibrating_plant.hpp"
#include "trackers/signals/random.hpp"

namespace veritrack::experiments {

namespace {

/// `visit` receives y_k and the regulator after every sample.
template <int N, typename EstimatorType, typename Visit>
void run_regulator(const EstimatorType& estimator, const VibrationStart& start, int samples,
                   const Visit& visit) {
  trackers::VibratingPlant<double, 1> plant(trackers::thesis_example_plant<double>(), kVibration, start.first,
                                            start.second);
  trackers::SelfTuningRegulator<double, N, EstimatorType> regulator(estimator);
  double input = 0.0;
  for (int k = 0; k < samples; ++k) {
    const double output = plant.step(input);
    input = regulator.step(output);
    visit(output, regulator.estimator().theta());
  }
}

template <int N, typename Visit>
void run_order(Estimator estimator, const VibrationStart& start, int samples, double limit,
               const Visit& visit) {
  using Efra = trackers::EfraLeastSquares<double, N>;
  using Monitored = trackers::MonitoredLeastSquares<double, N>;
  const trackers::RegulatorVector<double, N> theta = start.parameters;
  const typename Efra::Matrix p = start.covariance * Efra::Matrix::Identity();
  if (estimator == Estimator::efra) {
    run_regulator<N>(Efra(trackers::thesis_efra_design<double>(), theta, p), start, samples, visit);
  } else {
    run_regulator<N>(Monitored(theta, p, 1.0, limit), start, samples, visit);
  }
}

template <typename Visit>
void run_any(VibrationOrder order, Estimator estimator, const VibrationStart& start, int samples,
             double limit, const Visit& visit) {
  const rigor::NearestRounding nearest;
  if (order == VibrationOrder::three) {
    run_order<3>(estimator, start, samples, limit, visit);
  } else {
    run_order<5>(estimator, start, samples, limit, visit);
  }
}

}  // namespace

Eigen::VectorXd ideal_parameters(VibrationOrder order) {
  const rigor::NearestRounding nearest;
  const Eigen::Index size = order == VibrationOrder::three ? 3 : 5;
  const double cosine = std::cos(kVibration);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(2 * size);
  result.head(3) << 2.0 * cosine, -(1.0 + cosine), 0.5;
  result.segment(size, 3) << 3.0, -6.0 * cosine, 3.0;
  return result;
}

VibrationStart drawn_start(VibrationOrder order, FirstGuess guess, std::uint64_t seed) {
  const rigor::NearestRounding nearest;
  constexpr double kGuessDeviation = 0.5;
  trackers::RandomStream random(seed);
  VibrationStart start;
  start.first = random.normal();
  start.second = random.normal();
  start.covariance = 0.1 * std::pow(100.0, random.uniform());
  start.parameters = ideal_parameters(order);
  if (guess == FirstGuess::nothing) {
    start.parameters.setZero();
    start.parameters(start.parameters.size() / 2) = 1.0 + 3.0 * random.uniform();
  } else {
    for (double& parameter : start.parameters) {
      parameter += kGuessDeviation * random.normal();
    }
  }
  return start;
}

VibrationRun vibration_run(VibrationOrder order, Estimator estimator, const VibrationStart& start,
                           int samples, double limit) {
  VibrationRun run;
  run_any(order, estimator, start, samples, limit, [&](double output, const auto& theta) {
    run.output.push_back(output);
    run.parameters.emplace_back(theta);
  });
  return run;
}

Eigen::VectorXd limiting_parameters(VibrationOrder order, Estimator estimator, const VibrationStart& start,
                                    int samples, double limit) {
  Eigen::VectorXd last;
  int left = samples;
  run_any(order, estimator, start, samples, limit, [&](double /*output*/, const auto& theta) {
    if (--left == 0) {
      last = theta;
    }
  });
  return last;
}

double pole_error(const Eigen::VectorXd& parameters) {
  const rigor::NearestRounding nearest;
  const Eigen::Index order = parameters.size() / 2;
  const std::complex<double> back = std::polar(1.0, -kVibration);
  std::complex<double> power = 1.0;
  std::complex<double> sum = 0.0;
  for (Eigen::Index i = 0; i < order; ++i) {
    sum += parameters(order + i) * power;
    power *= back;
  }
  return std::abs(sum) / parameters.tail(order).cwiseAbs().sum();
}

}  // namespace veritrack::experiments
