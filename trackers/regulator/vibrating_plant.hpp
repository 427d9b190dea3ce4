// A linear plant whose output a sinusoid disturbs, for the regulators of this folder.
//
// B. F. La Scala, "Approaches to Frequency Tracking and Vibration Control", PhD thesis, Australian National
// University, 1994, section 5.2. Equation numbers are the thesis's. In samples back,
//     x_k = -a_1 x_{k-1} - ... - a_p x_{k-p} + b_0 u_{k-1} + ... + b_{p-1} u_{k-p},   y_k = x_k + v_k,
//     v_k = 2 cos(omega) v_{k-1} - v_{k-2} + e_k,   e_k = 0 but for k = -2, -1.
// So v_k = e_{-1} sin((k+2) omega) / sin(omega) + e_{-2} sin((k+3) omega) / sin(omega). The thesis prints
// these factors two samples late, as sin(k omega) and sin((k+1) omega), and assumes v_k = 0 for all k <= 0,
// which would leave no disturbance. In the expansion of B = A_2 B_1 it prints -b'_2 in the third coefficient,
// which is +b'_2.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace veritrack::trackers {

/// A_1 = 1 + a_1 q^-1 + ... and B_1 = b_0 + b_1 q^-1 + ... of a plant of order Order >= 1 with unit delay.
template <typename Scalar, int Order>
struct PlantModel {
  Eigen::Matrix<Scalar, Order, 1> a;  ///< a_1 ... a_p
  Eigen::Matrix<Scalar, Order, 1> b;  ///< b_0 ... b_{p-1}, output per input; b_0 != 0
};

/// x_k = 0.5 x_{k-1} + 3 u_{k-1}, the plant of section 5.4.
template <typename Scalar>
[[nodiscard]] inline PlantModel<Scalar, 1> thesis_example_plant() {
  PlantModel<Scalar, 1> plant;
  plant.a(0) = Scalar(-0.5);
  plant.b(0) = Scalar(3.0);
  return plant;
}

namespace detail {

/// The newest first: `value` goes in front, the oldest is forgotten.
template <typename Scalar, int Size>
inline void push_front(Eigen::Matrix<Scalar, Size, 1>& values, const Scalar& value) {
  for (int i = Size - 1; i > 0; --i) {
    values(i) = values(i - 1);
  }
  values(0) = value;
}

}  // namespace detail

/// The plant alone, from rest.
template <typename Scalar, int Order>
class Plant {
 public:
  explicit Plant(const PlantModel<Scalar, Order>& model) : model_(model) {
    outputs_.fill(Scalar(0.0));
    inputs_.fill(Scalar(0.0));
  }

  /// x_k from u_{k-1}.
  Scalar step(const Scalar& input) {
    detail::push_front(inputs_, input);
    Scalar output(0.0);
    for (int i = 0; i < Order; ++i) {
      output = output + (model_.b(i) * inputs_(i) - model_.a(i) * outputs_(i));
    }
    detail::push_front(outputs_, output);
    return output;
  }

  [[nodiscard]] const PlantModel<Scalar, Order>& model() const { return model_; }

 private:
  PlantModel<Scalar, Order> model_;
  Eigen::Matrix<Scalar, Order, 1> outputs_;
  Eigen::Matrix<Scalar, Order, 1> inputs_;
};

/// The plant with its disturbance. The samples are k = 0, 1, ...; before them all but v is zero.
template <typename Scalar, int Order>
class VibratingPlant {
 public:
  /// `frequency` omega in rad/sample; `first` = e_{-1}, `second` = e_{-2}, in units of the output.
  VibratingPlant(const PlantModel<Scalar, Order>& model, const Scalar& frequency, const Scalar& first,
                 const Scalar& second)
      : plant_(model),
        twice_cosine_(twice_cosine(frequency)),
        last_(twice_cosine_ * second + first),
        before_(second) {}

  /// y_k from u_{k-1}, with what measures it erring by `noise`.
  Scalar step(const Scalar& input, const Scalar& noise = Scalar(0.0)) {
    const Scalar next = twice_cosine_ * last_ - before_;
    before_ = last_;
    last_ = next;
    return plant_.step(input) + last_ + noise;
  }

  /// Lets the disturbance go on at another frequency, rad/sample.
  void set_frequency(const Scalar& frequency) { twice_cosine_ = twice_cosine(frequency); }

  /// v_k of the last step, in units of the output.
  [[nodiscard]] const Scalar& disturbance() const { return last_; }

 private:
  static Scalar twice_cosine(const Scalar& frequency) {
    using std::cos;
    const Scalar cosine = cos(frequency);
    return cosine + cosine;
  }

  Plant<Scalar, Order> plant_;
  Scalar twice_cosine_;
  Scalar last_;    // v_k; v_{-1} = 2 cos(omega) e_{-2} + e_{-1} before the first step
  Scalar before_;  // v_{k-1}; v_{-2} = e_{-2}
};

}  // namespace veritrack::trackers
