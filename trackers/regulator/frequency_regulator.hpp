// The ideal minimum-variance controller of a known plant, at a frequency that any tracker estimates.
//
// B. F. La Scala, thesis (vibrating_plant.hpp), section 5.2.4, whose ideal law needs omega. Here cos omega is
// replaced by c_k = cos of an estimate, which may change with every sample. With d_k = A_1 v_k = A_1 y_k -
// B_1 u_{k-1}, known from the data, the law is
//     B_1 u_k = -(2 c_k d_k - d_{k-1}),   and then   A_1 y_{k+1} = 2 (cos omega - c_k) A_1 v_k
// exactly (once the memory is full, from k = p + 1 on), for any c_k: a proved bound on a tracker's frequency
// error gives a bound on the output. A test compares both with simulations. With noise n in y, at constant c,
// y = S n with S = 1 - 2 c q^-1 + q^-2: its variance is multiplied by 2 + 4 c^2.
//
//     FrequencyRegulator<double, 1> regulator(thesis_example_plant<double>());
//     u = regulator.step(y, [&](double v) { tracker.step(v); return tracker.filtered().frequency; });
//
// The tracker is fed with v_k = y_k - x_k, x the plant's own answer to u: exact when the model is, and the
// plant started from rest. A template over the scalar; a step does not allocate. Assumed, not checked: B_1 is
// stable, b_0 != 0.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>

#include "trackers/regulator/vibrating_plant.hpp"

namespace veritrack::trackers {

/// The controller with its memory, from rest.
template <typename Scalar, int Order>
class FrequencyRegulator {
 public:
  explicit FrequencyRegulator(const PlantModel<Scalar, Order>& model) : model_(model), plant_(model) {
    outputs_.fill(Scalar(0.0));
    inputs_.fill(Scalar(0.0));
  }

  /// u_k from y_k. `frequency_of` takes v_k, in units of the output, and returns the tracker's frequency in
  /// rad/sample.
  template <typename Tracker>
  Scalar step(const Scalar& output, Tracker&& frequency_of) {
    using std::cos;
    disturbance_ = output - plant_.step(inputs_(0));
    const Scalar frequency = std::forward<Tracker>(frequency_of)(disturbance_);
    return control(output, cos(frequency));
  }

  /// v_k that the last step found, in units of the output.
  [[nodiscard]] const Scalar& disturbance() const { return disturbance_; }

 private:
  Scalar control(const Scalar& output, const Scalar& cosine) {
    Scalar filtered = output;  // d_k
    for (int i = 0; i < Order; ++i) {
      filtered = filtered + (model_.a(i) * outputs_(i) - model_.b(i) * inputs_(i));
    }
    Scalar wanted = last_filtered_ - (cosine + cosine) * filtered;
    for (int i = 1; i < Order; ++i) {
      wanted = wanted - model_.b(i) * inputs_(i - 1);
    }
    const Scalar input = wanted / model_.b(0);
    last_filtered_ = filtered;
    detail::push_front(outputs_, output);
    detail::push_front(inputs_, input);
    return input;
  }

  PlantModel<Scalar, Order> model_;
  Plant<Scalar, Order> plant_;
  Eigen::Matrix<Scalar, Order, 1> outputs_;
  Eigen::Matrix<Scalar, Order, 1> inputs_;
  Scalar last_filtered_ = Scalar(0.0);
  Scalar disturbance_ = Scalar(0.0);
};

}  // namespace veritrack::trackers
