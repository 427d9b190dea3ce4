#include "analysis/quadrature/true_phase/ellipsoid_search.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/rigor/spectral_radius.hpp"

namespace veritrack::quadrature {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using rigor::Interval;

/// Coq takes a sixth of a second for a box: the second number is tried where nothing is found with the first.
constexpr std::array kMostBoxes{32, 200};

Matrix3d transition(double e1, double e2) {
  Matrix3d result = Matrix3d::Identity();
  result(0, 2) = -e2;
  result(1, 2) = 1.0 + e1;
  return result;
}

Matrix3d prediction(const trackers::ToneModel<double>& design, const Matrix3d& covariance, double e1,
                    double e2) {
  const Matrix3d f = transition(e1, e2);
  return f * covariance * f.transpose() + Matrix3d(Vector3d(design.q1, design.q1, design.q2).asDiagonal());
}

/// The sum of A^k Z A'^k / factor^k.
Matrix3d accumulated(const Matrix3d& a, const Matrix3d& z, double factor) {
  constexpr int kMostTerms = 100'000;
  constexpr double kNegligible = 1e-15;
  Matrix3d sum = z;
  Matrix3d term = z;
  for (int k = 0; k < kMostTerms && term.norm() > kNegligible * sum.norm(); ++k) {
    term = a * term * a.transpose() / factor;
    sum += term;
  }
  return sum;
}

/// The parameters of the search.
struct Shape {
  double decay = 0.5;                                  ///< where kappa2 is between its least value and 1
  std::array<double, 3> spread_of_start{1, 1, 1};      ///< how much of the start's size is added at each step
  std::array<double, 2> spread_of_covariance{.1, .1};  ///< below and above the steady state, relative

  /// All of them, by reference.
  [[nodiscard]] std::array<double*, 6> all() {
    return {&decay,
            spread_of_start.data(),
            spread_of_start.data() + 1,
            spread_of_start.data() + 2,
            spread_of_covariance.data(),
            spread_of_covariance.data() + 1};
  }
};

class Search {
 public:
  Search(const EllipsoidQuestion& question, EllipsoidAim aim, int most_boxes)
      : question_(question), aim_(aim), most_boxes_(most_boxes) {
    constexpr int kSteps = 20'000;
    steady_ = question.start_highest;
    for (int k = 0; k < kSteps; ++k) {
      steady_ = covariance_after(question.design, steady_, 0.0, 0.0);
    }
    gain_ = gain_at(question.design, steady_, 0.0, 0.0);
    closed_loop_ = transition(0.0, 0.0);
    closed_loop_ -= gain_ * closed_loop_.topRows<2>().eval();
    least_kappa2_ = std::pow(rigor::spectral_radius(closed_loop_), 2);
    wide_ = accumulated(closed_loop_, steady_, 1.0);
    wide_ *= steady_.norm() / wide_.norm();
    const double length = 1.0 + question.amplitude_error;
    const double half_square = 0.5 * length * question.phase_error * question.phase_error;
    corner_ = Vector3d(question.amplitude_error + half_square, length * question.phase_error,
                       question.frequency_error);
  }

  /// The ellipsoid of that shape around the starts, with e' M e = 1 above what noise and slew hold up; none
  /// when the start covariances are not inside.
  [[nodiscard]] std::optional<ErrorEllipsoid> ellipsoid(const Shape& shape) const {
    constexpr double kSlack = 1e-3;
    ErrorEllipsoid set;
    set.kappa2 = stored(least_kappa2_ + (1.0 - least_kappa2_) * shape.decay);
    const double rest = 1.0 - set.kappa2;
    const double parts = question_.slew > 0.0 && question_.noise > 0.0 ? 2.0 : 1.0;
    Matrix3d added = parts / rest * question_.noise * question_.noise * gain_ * gain_.transpose();
    added(2, 2) += parts / rest * question_.slew * question_.slew;
    for (Eigen::Index i = 0; i < 3; ++i) {
      constexpr double kLeast = 1e-14;
      added(i, i) += shape.spread_of_start.at(static_cast<std::size_t>(i)) * corner_(i) * corner_(i) + kLeast;
    }
    Matrix3d n = accumulated(closed_loop_, added, set.kappa2 * (1.0 - kSlack));
    n *= (1.0 + kSlack) * std::max(farthest_start(n.inverse()), 1.0);
    set.shape = stored(Matrix3d(n.inverse()));
    set.inverse = stored(Matrix3d(set.shape.inverse() * (1.0 - 1e-7)));
    set.lowest = stored(Matrix3d(steady_ - shape.spread_of_covariance[0] * wide_));
    set.highest = stored(Matrix3d(steady_ + shape.spread_of_covariance[1] * wide_));
    const auto gain_for = [&](double size, Eigen::Index i) {
      constexpr double kFree = 1e6;
      return stored((1.0 - kSlack) * (size > 0.0 ? rest / (parts * size * size) : kFree / set.inverse(i, i)));
    };
    set.noise_gain = gain_for(question_.noise, 0);
    set.slew_gain = gain_for(question_.slew, 2);
    const Interval phase = rigor::symmetric(question_.phase_error);
    const bool holds_start = set.lowest.llt().info() == Eigen::Success &&
                             is_inside_when_turned(question_.start_highest, set.highest, phase, false) &&
                             is_inside_when_turned(question_.start_lowest, set.lowest, phase, true);
    return holds_start ? std::optional(set) : std::nullopt;
  }

  /// Improves on the best so far, if a cover is found.
  bool attempt(const Shape& shape) {
    const auto set = ellipsoid(shape);
    const bool for_ever = aim_ == EllipsoidAim::for_ever;
    if (!set || (for_ever && !(set->inverse(2, 2) < best_))) {
      return false;
    }
    const ErrorBox middle{{Interval(0.0), Interval(0.0), Interval(0.0)}};
    if (!numbers_for(question_.design, *set, middle)) {
      return false;
    }
    auto cells = cover(question_.design, *set, most_boxes_);
    if (!cells) {
      return false;
    }
    CoveredEllipsoid found{*set, std::move(cells)};
    if (!for_ever) {
      reduce_noise_gain(found);
    }
    const double bound = found.set.inverse(2, 2) * (for_ever ? 1.0 : ultimate_level(question_, found.set));
    if (!(bound < best_)) {
      return false;
    }
    found_ = std::move(found);
    best_shape_ = shape;
    best_ = bound;
    return true;
  }

  void over_grid() {
    for (const double decay : {0.3, 0.5, 0.7}) {
      for (const double start : {0.01, 0.1, 1.0, 10.0}) {
        for (const double covariance : {0.05, 0.1, 0.2, 0.4}) {
          attempt({decay, {start, start, start}, {covariance, covariance}});
        }
      }
    }
  }

  /// From the best so far, one number at a time.
  void by_coordinates() {
    for (const double step : {2.0, 1.4, 1.15}) {
      bool better = found_.has_value();
      for (int round = 0; better && round < 4; ++round) {
        better = false;
        for (std::size_t i = 0; i < 6; ++i) {
          for (const double factor : {step, 1.0 / step}) {
            Shape shape = best_shape_;
            double& varied = *shape.all().at(i);
            varied *= factor;
            better = (shape.decay < 1.0 && attempt(shape)) || better;
          }
        }
      }
    }
  }

  [[nodiscard]] std::optional<CoveredEllipsoid> result() && {
    if (found_) {
      reduce_noise_gain(*found_);
    }
    return std::move(found_);
  }

 private:
  /// To the least with which a cover is still found.
  void reduce_noise_gain(CoveredEllipsoid& found) const {
    constexpr int kBisections = 8;
    if (!(question_.noise > 0.0)) {
      return;
    }
    double works = found.set.noise_gain;
    double fails = 1e-4 * works;
    for (int k = 0; k < kBisections; ++k) {
      ErrorEllipsoid set = found.set;
      set.noise_gain = stored(std::sqrt(works * fails));
      if (auto cells = cover(question_.design, set, most_boxes_)) {
        works = set.noise_gain;
        found = CoveredEllipsoid{set, std::move(cells)};
      } else {
        fails = set.noise_gain;
      }
    }
  }

  /// The largest e' M e of the starts.
  [[nodiscard]] double farthest_start(const Matrix3d& shape) const {
    const Matrix3d sizes = shape.cwiseAbs();
    return corner_.dot(sizes * corner_);
  }

  EllipsoidQuestion question_;
  Matrix3d steady_, wide_, closed_loop_;
  Eigen::Matrix<double, 3, 2> gain_;
  double least_kappa2_ = 1.0;
  Vector3d corner_;
  EllipsoidAim aim_;
  int most_boxes_;
  double best_ = std::numeric_limits<double>::infinity();  ///< the square of the bound
  Shape best_shape_;
  std::optional<CoveredEllipsoid> found_;
};

}  // namespace

double stored(double x) {
  constexpr int kBits = 40;
  constexpr double kZero = 1e-20;  // what is left of an entry that is zero by symmetry
  if (std::fabs(x) < kZero) {
    return 0.0;
  }
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return std::ldexp(std::rint(std::ldexp(fraction, kBits)), exponent - kBits);
}

Matrix3d covariance_after(const trackers::ToneModel<double>& design, const Matrix3d& covariance, double e1,
                          double e2) {
  const Matrix3d predicted = prediction(design, covariance, e1, e2);
  const Matrix3d after = predicted - gain_at(design, covariance, e1, e2) * predicted.topRows<2>();
  return 0.5 * (after + after.transpose());
}

Eigen::Matrix<double, 3, 2> gain_at(const trackers::ToneModel<double>& design, const Matrix3d& covariance,
                                    double e1, double e2) {
  const Matrix3d predicted = prediction(design, covariance, e1, e2);
  const Eigen::Matrix2d innovation = predicted.topLeftCorner<2, 2>() + design.r * Eigen::Matrix2d::Identity();
  return predicted.leftCols<2>() * innovation.inverse();
}

double ultimate_level(const EllipsoidQuestion& question, const ErrorEllipsoid& set) {
  return (set.noise_gain * question.noise * question.noise + set.slew_gain * question.slew * question.slew) /
         (1.0 - set.kappa2);
}

std::optional<CoveredEllipsoid> search_ellipsoid(const EllipsoidQuestion& question, EllipsoidAim aim) {
  for (const int most_boxes : kMostBoxes) {
    Search search(question, aim, most_boxes);
    search.over_grid();
    search.by_coordinates();
    if (auto found = std::move(search).result()) {
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace veritrack::quadrature
