#include "analysis/model/point_tube.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <span>

namespace veritrack::model {

Eigen::VectorXd PointFrame::coordinates(const Eigen::VectorXd& state) const {
  return shape.triangularView<Eigen::Lower>().solve(state - curve);
}

PointTube::PointTube(const Tube& tube, double frequency) : turns_(tube.turns) {
  const double z = (frequency - tube.frequency) / tube.half_width;
  series_.reserve(tube.curve.size() + tube.shape.size());
  const auto add = [&](const PhaseSeries& series) {
    std::vector<std::complex<double>>& harmonics = series_.emplace_back();
    harmonics.reserve(series.coefficients.size());
    for (const std::vector<std::complex<double>>& powers : series.coefficients) {
      std::complex<double> sum = 0.0;
      for (std::size_t d = powers.size(); d-- > 0;) {
        sum = sum * z + powers[d];
      }
      harmonics.push_back(sum);
    }
    harmonics_ = std::max(harmonics_, harmonics.size());
  };
  std::for_each(tube.curve.begin(), tube.curve.end(), add);
  std::for_each(tube.shape.begin(), tube.shape.end(), add);
}

void PointTube::at(double phase, PointFrame& frame) const {
  const auto states = static_cast<Eigen::Index>(turns_.size());
  std::vector<std::complex<double>> turned(harmonics_, 1.0);
  const std::complex<double> turn = std::polar(1.0, phase);
  for (std::size_t h = 1; h < harmonics_; ++h) {
    turned[h] = turned[h - 1] * turn;
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
    frame.curve[i] = turns_[static_cast<std::size_t>(i)] * phase + value();
  }
  frame.shape.setZero(states, states);
  for (Eigen::Index i = 0; i < states; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      frame.shape(i, j) = value();
    }
  }
}

PointTracker::PointTracker(const TrackerModel& model) : model_(&model) {
  for (const rigor::Interval& constant : model.constants) {
    step_inputs_.push_back(0.5 * (constant.lower() + constant.upper()));
  }
  signal_inputs_ = step_inputs_;
  signal_inputs_.push_back(0.5 * (model.amplitude.lower() + model.amplitude.upper()));
  signal_inputs_.push_back(0.0);
  frequency_inputs_ = step_inputs_;
  frequency_inputs_.resize(frequency_inputs_.size() + static_cast<std::size_t>(states()));
  step_inputs_.resize(frequency_inputs_.size() + static_cast<std::size_t>(channels()));
}

Eigen::VectorXd PointTracker::samples(double phase) {
  signal_inputs_.back() = phase;
  Eigen::VectorXd values(channels());
  model_->signal->run(std::span<const double>(signal_inputs_), registers_,
                      std::span(values.data(), static_cast<std::size_t>(values.size())));
  return values;
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
