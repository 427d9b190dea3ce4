#include "analysis/kkl_observer/kkl_ell.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "analysis/kkl_observer/kkl_excitation_ratio.hpp"
#include "analysis/rigor/decimal.hpp"
#include "analysis/search/constrained.hpp"
#include "analysis/search/maximize.hpp"
#include "trackers/kkl_observer/kkl_observer.hpp"

namespace veritrack::kkl_observer {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Sense;

constexpr double kRelativeWidth = 1e-9;

/// The range in double, for the solvers.
template <int M>
struct Midpoints {
  Eigen::Matrix<double, M, 1> lambda;
  double frequency_low, frequency_high;
};

template <int M>
Midpoints<M> midpoints(const KklRangeOf<M>& range) {
  return {rigor::midpoint(range.lambda), range.frequency.lower(), range.frequency.upper()};
}

/// |M T(x)|^2 / |T(x)|^2 at a state that a solver proposes: the value of (10) at that state scaled to |T|
/// = 1.
template <int M>
double ratio_at(const Eigen::Vector3d& x, const Eigen::Matrix<double, M, 1>& lambda) {
  const Eigen::Matrix<double, M, 1> transformed = trackers::kkl_transform<double, M>(x, lambda);
  return trackers::kkl_excitation<double, M>(transformed, lambda) / transformed.squaredNorm();
}

/// Problem (10) as the paper states it: minimize |M T(x)|^2 subject to |T(x)|^2 = 1 and x3 in its range.
template <int M>
double solve_as_stated(const Midpoints<M>& at) {
  using Dual = rigor::Dual<double, 3>;
  using DualVector = Eigen::Matrix<Dual, M, 1>;
  const DualVector lambda = at.lambda.unaryExpr([](double rate) { return Dual(rate); });
  const auto differentiated = [&lambda](const Eigen::VectorXd& x, auto function) {
    const Dual value =
        function(trackers::kkl_transform<Dual, M>(rigor::variables(Eigen::Vector3d(x)), lambda));
    search::Differentiated result{Eigen::VectorXd(1), Eigen::MatrixXd(1, 3)};
    result.value(0) = value.value();
    for (int i = 0; i < 3; ++i) {
      result.jacobian(0, i) = value.derivative(i);
    }
    return result;
  };
  search::ConstrainedProblem problem;
  constexpr double kUnbounded = 1e20;  // infinite for Ipopt
  problem.lower = Eigen::Vector3d(-kUnbounded, -kUnbounded, at.frequency_low * at.frequency_low);
  problem.upper = Eigen::Vector3d(kUnbounded, kUnbounded, at.frequency_high * at.frequency_high);
  double scale = 1.0;
  problem.objective = [&](const Eigen::VectorXd& x) {
    return differentiated(x, [&](const DualVector& transformed) {
      return trackers::kkl_excitation<Dual, M>(transformed, lambda) / scale;
    });
  };
  problem.constraints = [&](const Eigen::VectorXd& x) {
    return differentiated(x, [](const DualVector& transformed) {
      Dual sum(0.0);
      for (int i = 0; i < M; ++i) {
        sum += square(transformed(i));
      }
      return sum;
    });
  };
  problem.constraints_lower = Eigen::VectorXd::Constant(1, 1.0);
  problem.constraints_upper = Eigen::VectorXd::Constant(1, 1.0);
  // A local method: from the middle of the range and from near its ends.
  double best = std::numeric_limits<double>::infinity();
  for (const double place : {0.5, 0.02, 0.98}) {
    const double frequency = at.frequency_low * std::pow(at.frequency_high / at.frequency_low, place);
    Eigen::Vector3d start(1.0, frequency, frequency * frequency);
    start.head<2>() /= trackers::kkl_transform<double, M>(start, at.lambda).norm();
    problem.start = start;
    scale = ratio_at(start, at.lambda);  // the solver's tolerances are absolute
    const double value = ratio_at(search::minimize_constrained(problem).point, at.lambda);
    best = value < best ? value : best;
  }
  return best;
}

/// The reduced problem, one variable, by NLopt.
template <int M>
double solve_reduced(const Midpoints<M>& at, search::SearchMethod method) {
  const ExcitationRatio<double, M> ratio(at.lambda);
  search::SearchSpace space;
  space.lower = Eigen::VectorXd::Constant(1, std::log(at.frequency_low));
  space.upper = Eigen::VectorXd::Constant(1, std::log(at.frequency_high));
  space.start = 0.5 * (space.lower + space.upper);
  space.step = (space.upper - space.lower).cwiseMax(1e-12) / 4.0;
  space.evaluations = 500;
  space.method = method;
  space.tolerance = 1e-14;
  const auto frequency_at = [&](const Eigen::VectorXd& x) {
    return std::min(std::max(std::exp(x(0)), at.frequency_low), at.frequency_high);
  };
  const search::BestPoint best =
      search::maximize([&](const Eigen::VectorXd& x) { return -ratio.at(frequency_at(x)); }, space);
  return ratio.at(frequency_at(best.point));
}

theorems::Quantity ell_quantity(std::string name, std::string symbol, std::string formula,
                                const Interval& value, Sense sense, std::string words) {
  theorems::Quantity result{
      std::move(name), std::move(symbol), std::move(formula), "paper, (10)", value, std::nullopt,
      sense,           std::move(words)};
  if (rigor::is_empty(value)) {
    result.not_applicable = result.is_proved() ? "It could not be enclosed." : "The solver found no number.";
  }
  return result;
}

/// A sentence that compares a solver's value with the enclosure: a solver proves nothing and can be off by
/// its tolerance without being wrong.
std::string comparison(const std::string& solver, double value, const Interval& enclosure) {
  const Interval point(value);
  // cannot bind (enclosure): it chooses the words about a solver's value, which decides nothing.
  if (!rigor::is_finite(enclosure) || !certainly_positive(enclosure)) {
    return "Without a verified enclosure nothing can be said about " + solver + "'s value.";
  }
  if (!rigor::is_finite(point)) {
    return solver + " found no number.";
  }
  // cannot bind (point): the same.
  if (rigor::is_subset(point, enclosure)) {
    return solver + "'s value lies in the verified enclosure.";
  }
  const Interval off = abs(point - enclosure) / enclosure;
  return solver + "'s value differs from the verified minimum by a relative " +
         rigor::to_decimal(off.upper(), 2, rigor::Direction::up) + " at most.";
}

}  // namespace

template <int M>
search::VerifiedMinimum<1> enclose_ell(const KklRangeOf<M>& range) {
  const rigor::UpwardRounding upward;
  const ExcitationRatio<Interval, M> ratio(range.lambda);
  rigor::IntervalVector<1> box;
  box(0) = range.frequency;
  search::BranchAndBoundSettings<1> settings;
  settings.relative_tolerance = 0.5 * kRelativeWidth;
  settings.cells = 20'000;
  return search::minimize_globally<1>([&ratio](const auto& frequency) { return ratio.at(frequency(0)); }, box,
                                      settings);
}

template <int M>
theorems::Derivation derive_kkl_ell(const KklRangeOf<M>& range, const search::VerifiedMinimum<1>& minimum) {
  std::array<double, 3> proposals{};
  {
    const rigor::NearestRounding nearest;
    const Midpoints<M> at = midpoints(range);
    proposals = {solve_as_stated(at), solve_reduced(at, search::SearchMethod::subplex),
                 solve_reduced(at, search::SearchMethod::direct)};
  }
  const rigor::UpwardRounding upward;
  // Wider than the enclosure by the rounding errors of double, because values computed in double are compared
  // with it.
  constexpr double kComparison = 4e-10;
  const Interval ell = minimum.value() * (Interval(1.0) + rigor::symmetric(kComparison));
  theorems::Derivation derivation;
  derivation.id = "kkl-ell";
  derivation.title = "The constant of (10): the distance of T(x) from the singular set of the inverse";
  const std::string reduced = "\\min_\\omega \\lambda_{min}(A^T M^T M A, A^T A)";
  derivation.quantities = {
      ell_quantity("ell", "\\ell", "\\inf_{|T(x)| = 1} |M T(x)|^2", ell, Sense::enclosure,
                   "the constant of (10)"),
      ell_quantity("ell_ipopt", "\\ell_{Ipopt}", "\\inf_{|T(x)| = 1} |M T(x)|^2", Interval(proposals[0]),
                   Sense::sampled, "value found by Ipopt for (10)"),
      ell_quantity("ell_nlopt", "\\ell_{NLopt}", reduced, Interval(proposals[1]), Sense::sampled,
                   "value found by NLopt, local search"),
      ell_quantity("ell_nlopt_global", "\\ell_{DIRECT}", reduced, Interval(proposals[2]), Sense::sampled,
                   "value found by NLopt, global search"),
      ell_quantity("argmin_omega", "\\omega_\\ell", "\\arg" + reduced, minimum.where(0), Sense::enclosure,
                   "the frequencies that can attain it, rad/s")};

  theorems::Condition tight;
  tight.id = "enclosed";
  tight.statement = "(\\ell_{hi} - \\ell_{lo}) / \\ell_{lo} \\le 10^{-9}";
  const Interval relative_width = Interval(rigor::width(ell)) / Interval(ell.lower());
  tight.lhs = relative_width;
  tight.rhs = Interval(kRelativeWidth);
  tight.verdict = rigor::is_finite(ell) && rigor::certainly_positive(ell)
                      ? rigor::decide_less_equal(relative_width, tight.rhs)
                      : Verdict::undecided;
  tight.reason = tight.verdict == Verdict::proved
                     ? "branch and bound over the frequency, " + std::to_string(minimum.cells) + " cells."
                     : "branch and bound over the frequency ended after " + std::to_string(minimum.cells) +
                           " cells without a sufficiently narrow enclosure.";
  theorems::Condition positive;
  positive.id = "positive";
  positive.statement = "\\ell > 0";
  positive.lhs = ell;
  positive.rhs = Interval(0.0);
  positive.verdict = rigor::decide_less(Interval(0.0), ell);
  positive.reason = positive.verdict == Verdict::proved
                        ? "the enclosure lies above zero: an ell that the inverse can use exists."
                        : "the enclosure does not lie above zero.";
  derivation.conditions = {tight, positive};
  derivation.verdict = rigor::conjunction({tight.verdict, positive.verdict});
  derivation.notes = {
      "The values of Ipopt (on (10) as the paper states it) and of NLopt (on the reduced problem, locally "
      "and globally) are proposals: they are compared with the enclosure, and no proof uses them.",
      comparison("Ipopt", proposals[0], ell), comparison("NLopt", proposals[1], ell),
      comparison("DIRECT", proposals[2], ell)};
  return derivation;
}

template search::VerifiedMinimum<1> enclose_ell(const KklRangeOf<4>&);
template search::VerifiedMinimum<1> enclose_ell(const KklRangeOf<5>&);
template search::VerifiedMinimum<1> enclose_ell(const KklRangeOf<6>&);
template search::VerifiedMinimum<1> enclose_ell(const KklRangeOf<7>&);
template search::VerifiedMinimum<1> enclose_ell(const KklRangeOf<8>&);
template theorems::Derivation derive_kkl_ell(const KklRangeOf<4>&, const search::VerifiedMinimum<1>&);
template theorems::Derivation derive_kkl_ell(const KklRangeOf<5>&, const search::VerifiedMinimum<1>&);
template theorems::Derivation derive_kkl_ell(const KklRangeOf<6>&, const search::VerifiedMinimum<1>&);
template theorems::Derivation derive_kkl_ell(const KklRangeOf<7>&, const search::VerifiedMinimum<1>&);
template theorems::Derivation derive_kkl_ell(const KklRangeOf<8>&, const search::VerifiedMinimum<1>&);

}  // namespace veritrack::kkl_observer
