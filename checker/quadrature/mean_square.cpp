#include "checker/quadrature/mean_square.hpp"

#include <algorithm>
#include <utility>

#include "checker/document/evidence.hpp"
#include "checker/quadrature/lock_cover.hpp"
#include "checker/quadrature/lock_set.hpp"

namespace veritrack::checker {

namespace {

/// The function, and whether its metric has the form of T. With a leak it has an offset, and only then.
std::pair<LockMeanSquare, bool> read_mean_square(const Tree& tree, bool leaks) {
  LockMeanSquare form;
  const Matrix3 metric = exact_matrix(tree.at("metric"));
  form.metric = {metric[0][0], metric[1][1], metric[1][2], metric[2][2]};
  form.weight = exact_number(tree.at("weight"));
  form.share = exact_number(tree.at("share"));
  form.rate = exact_number(tree.at("rate"));
  form.bound = exact_number(tree.at("bound"));
  bool has_form = has_form_of_metric(metric);
  if (leaks) {
    const Tree* offset = tree.find("offset");
    has_form = has_form && offset != nullptr && offset->elements().size() == form.offset.size();
    if (has_form) {
      std::transform(offset->elements().begin(), offset->elements().end(), form.offset.begin(), exact_number);
    }
  }
  return {form, has_form};
}

}  // namespace

LockMeanSquare check_lock_mean_square(const Tree& tree, const Design& design, const LockSet& set,
                                      std::int64_t& cells, Objections& objections) {
  const auto [form, has_form] = read_mean_square(tree, !design.without_leak());
  if (!has_form || !certainly_positive(form.metric.amplitude) || !certainly_positive(form.metric.phase) ||
      !certainly_positive(form.metric.frequency)) {
    objections.emplace_back(
        "the metric of the mean square is not one with positive numbers on its diagonal, or its offset is "
        "missing");
  } else if (!certainly_positive(form.weight) || !certainly_not_negative(form.share) ||
             !certainly_positive(form.rate) || !certainly_positive(form.bound) ||
             !certainly_at_most(form.rate, square(form.metric.frequency))) {
    objections.emplace_back("weight, share, rate or bound of the mean square are out of range");
  } else if (!holds_in_set({design.q1, design.q2, design.r, design.epsilon}, set,
                           left_of_mean_square(set, form), cells)) {
    objections.emplace_back("the mean square is not proved to be bounded");
  }
  return form;
}

Ball root_mean_square(const LockSet& set, const LockMeanSquare& mean_square, const Ball& start,
                      const Ball& samples) {
  // E[W; lock] is at most w at every sample. log W is the level, and concave. The root of the mean square of
  // R (e - f) is at most that of R e and |R f|.
  const Ball w = max(exp(start) + set.drift / (one - set.decay), exp(one));
  const Ball twice_level = two * log(w);
  const Ball length = root_of_non_negative(relative_norm_squared(mean_square, set) * twice_level);
  const Ball before = mean_square.share * w + square(length + offset_length(mean_square)) +
                      mean_square.weight / set.weight * twice_level;
  return sqrt(mean_square.bound + before / (mean_square.rate * samples)).upper();
}

void check_mean_square(const Tree& derivation, const GaussianNoise& noise, const std::vector<LockSet>& sets,
                       const std::vector<LockMeanSquare>& mean_squares, Promises& promises,
                       Objections& objections) {
  const bool in_lock = !sets.empty() && promises.losing_lock && promises.start_level;
  const bool bounded = in_lock && mean_squares.size() == sets.size();
  Derivation found;
  found.title = "Gaussian noise: the mean square of the frequency error in lock";
  found.conditions = {
      {"in-lock", R"(E[W(k+1) \mid k] \le \kappa W(k) + c_0 \text{ in the set})", proved_if(in_lock)},
      {"mean-square", R"(E[U(k+1) \mid k] \le U(k) + h\,(c - \nu(k)^2) \text{ in the set})",
       proved_if(bounded)}};
  if (bounded) {
    Ball worst;
    Ball without_start;
    for (std::size_t k = 0; k < sets.size(); ++k) {
      worst = max(worst, root_mean_square(sets[k], mean_squares[k], *promises.start_level, noise.samples))
                  .upper();
      without_start = max(without_start, sqrt(mean_squares[k].bound)).upper();
    }
    promises.rms = worst;
    found.quantities = {{"rms_frequency_error", worst, Sense::bounds_above},
                        {"rms_frequency_error_without_start", without_start, Sense::bounds_above}};
  }
  check_derivation(derivation, found, objections);
}

}  // namespace veritrack::checker
