#include "analysis/model/step/point_tube.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <span>
#include <stdexcept>

#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::model {

Eigen::VectorXd PointFrame::coordinates(const Eigen::VectorXd& state) const {
  return shape.triangularView<Eigen::Lower>().solve(state.head(curve.size()) - curve);
}

PointTube::PointTube(const Tube& tube, double frequency)
    : tube_(&tube),
      series_(tube.curve.size() + tube.shape.size() + tube.covariance_low.size() +
              tube.covariance_high.size()) {
  move_to(frequency);
}

void PointTube::move_to(double frequency) {
  if (frequency == frequency_) {
    return;
  }
  frequency_ = frequency;
  const double z = (frequency - tube_->frequency) / tube_->half_width;
  for (std::size_t i = 0; i < series_.size(); ++i) {
    const PhaseSeries& series = series_of(i);
    series_[i].resize(series.coefficients.size());
    for (std::size_t h = 0; h < series_[i].size(); ++h) {
      double real = 0.0;
      double imaginary = 0.0;
      for (std::size_t d = series.coefficients[h].size(); d-- > 0;) {
        real = real * z + series.coefficients[h][d].real();
        imaginary = imaginary * z + series.coefficients[h][d].imag();
      }
      series_[i][h] = {real, imaginary};
    }
    harmonics_ = std::max(harmonics_, series_[i].size());
  }
}

const PhaseSeries& PointTube::series_of(std::size_t number) const {
  for (const std::vector<PhaseSeries>* part :
       {&tube_->curve, &tube_->shape, &tube_->covariance_low, &tube_->covariance_high}) {
    if (number < part->size()) {
      return (*part)[number];
    }
    number -= part->size();
  }
  throw std::logic_error("no such series of a tube");
}

void PointTube::at(double phase, PointFrame& frame) const {
  const auto states = static_cast<Eigen::Index>(tube_->turns.size());
  std::vector<std::complex<double>> turned(harmonics_, 1.0);
  const std::complex<double> turn = std::polar(1.0, phase);
  for (std::size_t h = 1; h < harmonics_; ++h) {
    turned[h] = {turned[h - 1].real() * turn.real() - turned[h - 1].imag() * turn.imag(),
                 turned[h - 1].real() * turn.imag() + turned[h - 1].imag() * turn.real()};
  }
  std::size_t place = 0;
  const auto value = [&] {
    const std::vector<std::complex<double>>& harmonics = series_[place++];
    double sum = 0.0;
    for (std::size_t h = 0; h < harmonics.size(); ++h) {
      sum += harmonics[h].real() * turned[h].real() - harmonics[h].imag() * turned[h].imag();
    }
    return sum;
  };
  frame.curve.resize(states);
  for (Eigen::Index i = 0; i < states; ++i) {
    frame.curve[i] = tube_->turns[static_cast<std::size_t>(i)] * phase + value();
  }
  frame.shape.setZero(states, states);
  for (Eigen::Index i = 0; i < states; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      frame.shape(i, j) = value();
    }
  }
  if (!tube_->bounds_covariance()) {
    return;
  }
  frame.covariance.setZero(states, states);
  frame.spread.setZero(states, states);
  for (int bound = 0; bound < 2; ++bound) {
    for (Eigen::Index i = 0; i < states; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) {
        const double half = 0.5 * value();
        frame.covariance(i, j) += half;
        frame.covariance(j, i) += i == j ? 0.0 : half;
        frame.spread(i, j) += bound == 0 ? -half : half;
        frame.spread(j, i) += i == j ? 0.0 : bound == 0 ? -half : half;
      }
    }
  }
}

PointTracker::PointTracker(const TrackerModel& model) : model_(&model) {
  for (const rigor::Interval& constant : model.constants) {
    step_inputs_.push_back(0.5 * (constant.lower() + constant.upper()));
  }
  signal_inputs_ = step_inputs_;
  signal_inputs_.resize(signal_inputs_.size() + 2);  // amplitude, phase
  frequency_inputs_ = step_inputs_;
  frequency_inputs_.resize(frequency_inputs_.size() + static_cast<std::size_t>(states()));
  step_inputs_.resize(frequency_inputs_.size() + static_cast<std::size_t>(channels()));
}

Eigen::VectorXd PointTracker::samples(double phase) {
  return samples(phase, 0.5);
}

Eigen::VectorXd PointTracker::samples(double phase, double place) {
  const double low = model_->amplitude.lower();
  signal_inputs_[signal_inputs_.size() - 2] = low + place * (model_->amplitude.upper() - low);
  signal_inputs_.back() = phase;
  Eigen::VectorXd values(channels());
  model_->signal->run(std::span<const double>(signal_inputs_), registers_,
                      std::span(values.data(), static_cast<std::size_t>(values.size())));
  return values;
}

Eigen::VectorXd PointTracker::state(const PointFrame& frame, const Eigen::VectorXd& coordinates,
                                    const Eigen::MatrixXd& between) {
  if (frame.covariance.size() == 0) {
    return frame.state(coordinates);
  }
  const Eigen::VectorXd estimate = frame.state(coordinates);
  const Eigen::Index n = estimate.size();
  std::vector<double> inputs(step_inputs_.begin(),
                             step_inputs_.begin() + static_cast<std::ptrdiff_t>(model_->constants.size()));
  inputs.resize(inputs.size() + static_cast<std::size_t>(n + channels()), 1.0);
  const auto values = trackers::filter_values(*model_->filter, inputs);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::MatrixXd measured = Eigen::Map<const RowMajor>(values.measured.data(), channels(), n);
  const Eigen::MatrixXd noise = Eigen::Map<const RowMajor>(values.noise.data(), channels(), channels());
  Eigen::MatrixXd predicted = frame.covariance;
  if (between.size() > 0) {
    const auto root = rigor::cholesky(frame.spread);
    if (root) {
      predicted += rigor::congruence(*root, between);
    }
  }
  const rigor::SmallMatrix cross = rigor::product(measured, predicted);
  const rigor::SmallMatrix innovation =
      rigor::combination(1.0, rigor::product_with_transpose(cross, measured), 1.0, noise);
  const rigor::SmallMatrix updated = rigor::combination(
      1.0, predicted, -1.0,
      rigor::product(rigor::transposed(cross), rigor::symmetric_solution(innovation, cross)));
  Eigen::VectorXd result(states());
  result.head(n) = estimate;
  Eigen::Index place = n;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i; j < n; ++j) {
      result[place++] = updated(i, j);
    }
  }
  return result;
}

Eigen::VectorXd PointTracker::next(const Eigen::VectorXd& state, const Eigen::VectorXd& samples) {
  std::copy(samples.begin(), samples.end(), step_inputs_.end() - channels());
  std::copy(state.begin(), state.end(), step_inputs_.end() - channels() - states());
  Eigen::VectorXd result(states());
  model_->recursion->step.run(std::span<const double>(step_inputs_), registers_,
                              std::span(result.data(), static_cast<std::size_t>(result.size())));
  return result;
}

double PointTracker::frequency(const Eigen::VectorXd& state) {
  std::copy(state.begin(), state.end(), frequency_inputs_.end() - states());
  double result = 0.0;
  model_->recursion->frequency.run(std::span<const double>(frequency_inputs_), registers_,
                                   std::span(&result, 1));
  return result;
}

}  // namespace veritrack::model
