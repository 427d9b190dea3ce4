#include "papers/claims/sine_filter_horizon.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "analysis/rigor/decimal.hpp"
#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/linear_solve.hpp"
#include "analysis/rigor/rounding.hpp"
#include "trackers/zarchan/zarchan_ekf.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
/// Phase, frequency, and the entries 11, 12, 22 of the covariance.
constexpr int kFilterStates = 5;
using FilterDerivative = rigor::Dual<Interval, kFilterStates + 1>;  // by the states and the noise
using FilterVector = rigor::IntervalVector<kFilterStates>;
using FilterMatrix = rigor::IntervalMatrix<kFilterStates>;

template <typename Number>
Eigen::Matrix<Number, kFilterStates, 1> filter_step(const Eigen::Matrix<Number, kFilterStates, 1>& x,
                                                    const Number& sample, const Interval& variance) {
  trackers::ZarchanEstimate<Number, 2> estimate;
  estimate.state << x(0), x(1);
  estimate.covariance << x(2), x(3), x(3), x(4);
  const trackers::ZarchanDesign<Number> design{Number(rigor::parse_decimal("0.1")), Number(variance),
                                               Number(0.0), Number(0.0), 1};
  trackers::SineKnownAmplitudeEkf<Number> filter(design, Number(1.0), estimate);
  filter.step(sample);
  const trackers::ZarchanEstimate<Number, 2> next = filter.filtered();
  Eigen::Matrix<Number, kFilterStates, 1> result;
  result << next.state(0), next.state(1), next.covariance(0, 0), next.covariance(0, 1), next.covariance(1, 1);
  return result;
}

/// m + A r.
struct FilterSet {
  FilterVector middle;
  FilterMatrix frame;
  FilterVector deviation;
  [[nodiscard]] FilterVector box() const { return middle + frame * deviation; }
};

/// A frame for what these columns span: orthogonal once the rows are scaled. Any would do.
FilterMatrix proposed_frame(const Eigen::Matrix<Interval, kFilterStates, kFilterStates + 1>& columns) {
  const rigor::NearestRounding nearest;
  Eigen::Matrix<double, kFilterStates, kFilterStates + 1> sizes =
      columns.unaryExpr([](const Interval& entry) { return rigor::midpoint(entry); });
  rigor::Vector<kFilterStates> scale;
  for (int i = 0; i < kFilterStates; ++i) {
    scale(i) = std::max(1e-300, sizes.row(i).cwiseAbs().maxCoeff());
    sizes.row(i) /= scale(i);
  }
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, kFilterStates, kFilterStates + 1>> factored(sizes);
  const rigor::Matrix<kFilterStates> rotation =
      factored.householderQ() * rigor::Matrix<kFilterStates>::Identity();
  return rigor::to_interval(rigor::Matrix<kFilterStates>(scale.asDiagonal() * rotation));
}

/// The set after a sample signal + v, v in `noise`; nothing where no frame could be inverted.
std::optional<FilterSet> next_set(const FilterSet& set, const Interval& signal, const Interval& noise,
                                  const Interval& variance) {
  const FilterVector box = set.box();
  Eigen::Matrix<FilterDerivative, kFilterStates, 1> states;
  const auto variable = [](const Interval& value, int index) {
    std::array<Interval, kFilterStates + 1> derivatives;
    derivatives.fill(Interval(0.0));
    derivatives.at(static_cast<std::size_t>(index)) = Interval(1.0);
    return FilterDerivative(value, derivatives);
  };
  for (int i = 0; i < kFilterStates; ++i) {
    states(i) = variable(box(i), i);
  }
  const auto over = filter_step(states, variable(signal + noise, kFilterStates), variance);
  FilterMatrix slope;
  FilterVector noise_slope;
  for (int i = 0; i < kFilterStates; ++i) {
    for (int j = 0; j < kFilterStates; ++j) {
      slope(i, j) = over(i).derivative(j);
    }
    noise_slope(i) = over(i).derivative(kFilterStates);
  }
  const FilterVector image = filter_step(set.middle, signal, variance);
  const FilterMatrix moved = slope * set.frame;
  Eigen::Matrix<Interval, kFilterStates, kFilterStates + 1> columns;
  for (int i = 0; i < kFilterStates; ++i) {
    for (int j = 0; j < kFilterStates; ++j) {
      columns(i, j) = moved(i, j) * Interval(rigor::magnitude(set.deviation(j)));
    }
    columns(i, kFilterStates) = noise_slope(i) * Interval(rigor::magnitude(noise));
  }
  FilterSet next;
  next.frame = proposed_frame(columns);
  for (int i = 0; i < kFilterStates; ++i) {
    next.middle(i) = Interval(rigor::midpoint(image(i)));
  }
  const auto inverse = rigor::inverse(next.frame);
  if (!inverse) {
    return std::nullopt;
  }
  const FilterMatrix turned = *inverse * moved;
  const FilterVector pushed = *inverse * noise_slope;
  const FilterVector rounded = *inverse * (image - next.middle);
  next.deviation = turned * set.deviation + pushed * noise + rounded;
  return next;
}

}  // namespace

Interval frequency_after(const HorizonQuestion& question) {
  const Interval frequency = rigor::parse_decimal(question.frequency);
  const Interval first = rigor::parse_decimal(question.first_frequency);
  const Interval bound = rigor::parse_decimal(question.noise);
  const Interval noise = hull(-bound, bound);
  const Interval variance = rigor::parse_decimal(question.variance);
  const Interval interval = rigor::parse_decimal("0.1");
  FilterSet set;
  set.middle << Interval(0.0), first, Interval(0.0), Interval(0.0), square(frequency - first);
  set.frame = FilterMatrix::Identity();
  set.deviation.fill(Interval(0.0));
  for (int k = 1; k <= question.samples; ++k) {
    const std::optional<FilterSet> next =
        next_set(set, rigor::sin(frequency * (interval * Interval(k))), noise, variance);
    if (!next || !rigor::is_finite(next->box()(1))) {
      return Interval::empty();
    }
    set = *next;
  }
  return set.box()(1);
}

}  // namespace veritrack::theorems
