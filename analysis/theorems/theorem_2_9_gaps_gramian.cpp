#include "analysis/rigor/eigenvalues.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/statements/comparison.hpp"
#include "analysis/theorems/signal_model.hpp"
#include "analysis/theorems/theorem_2_9_gaps_parts.hpp"

namespace veritrack::theorems::gaps {

namespace {

using rigor::Interval;

/// The smallest eigenvalue of r O(k,1), from the matrix H'H + (H F^-1)'(H F^-1), F at the estimate (m, 0, 0).
Interval smallest_of_matrix(const Interval& m, const Interval& epsilon) {
  const Interval slope = m / (Interval(1.0) - epsilon);
  const Interval zero(0.0);
  rigor::IntervalMatrix<3> gramian;
  gramian << Interval(2.0), zero, zero,  //
      zero, Interval(2.0), -slope,       //
      zero, -slope, square(slope);
  const auto eigenvalues = rigor::symmetric_eigenvalues(gramian);
  return eigenvalues ? (*eigenvalues)(0) : Interval::empty();
}

/// (2 + w_3 - sqrt(w_3^2 + 4))/2, without cancellation.
Interval formula(const Interval& w3) {
  return Interval(2.0) * w3 / (Interval(2.0) + w3 + sqrt(square(w3) + Interval(4.0)));
}

/// Do they agree to nine digits?
rigor::Verdict agree(const Interval& a, const Interval& b) {
  return decide_less_equal(abs(a - b), Interval(1e-9) * abs(a));
}

Statement eigenvalue_statement(const std::string& reading, const Readings& readings, const Interval& w3,
                               const std::string& w3_text) {
  const Interval exact = smallest_of_matrix(Interval(1.0), readings.input.epsilon);
  const Interval claimed = formula(w3);
  return make_statement(
      gap_id("gramian-eigenvalue", reading),
      "The smallest eigenvalue of r O(k,1) is (2 + w3 - sqrt(w3^2 + 4))/2 with w3 = " + w3_text +
          ", to nine digits, at the estimate (1, 0, 0).",
      agree(exact, claimed),
      "At the estimate (1, 0, 0) the matrix has the smallest eigenvalue " + enclosed(exact) +
          "; the formula gives " + enclosed(claimed) + ".",
      {evidence("smallest_eigenvalue", R"(r\lambda_{\min})", R"(\lambda_{\min}(r\,\mathcal{O}(k,1)))", exact),
       evidence("formula_value", R"(\frac{1}{2}(2 + w_3 - \sqrt{w_3^2 + 4}))", "", claimed)});
}

/// O(k,1) contains F(k-1), so |z| of the estimate before last; the thesis writes x(k|k).
Statement time_index_statement(const Readings& readings) {
  const Interval now = smallest_of_matrix(Interval(1.0), readings.input.epsilon);
  const Interval before = smallest_of_matrix(Interval(0.75), readings.input.epsilon);
  return make_statement(
      gap_id("gramian-time-index"),
      "The eigenvalues of O(k,1) depend on the trajectory through the estimate (k|k) alone, to nine digits.",
      agree(now, before),
      "Estimate (1, 0, 0) at (k|k) and |z| = 1 or 0.75 at (k-1|k-1): the smallest eigenvalue of r O(k,1) "
      "is " +
          enclosed(now) + " or " + enclosed(before) + ".",
      {evidence("eigenvalue_at_1", "", "", now), evidence("eigenvalue_at_three_quarters", "", "", before)});
}

/// The signal is on the unit circle and |e| <= epsilon_r. Empty unless epsilon_r is certain to be positive.
EstimateRange estimate_range(const Theorem29Constants& c) {
  if (!certainly_positive(c.epsilon_r)) {
    return {};
  }
  const Interval one(1.0);
  return {max(one - c.epsilon_r, Interval(0.0)), one + c.epsilon_r};
}

bool is_printed(const Reading& reading) {
  return reading.name == "printed";
}

/// The estimates of which a reading speaks.
EstimateRange estimates_of(const Reading& reading, const Readings& readings) {
  return is_printed(reading) ? estimate_range(reading.constants) : admitted_estimates(readings.input);
}

/// The errata sheet's claims are shown at the largest eps_r that is admitted.
std::string at_largest(bool printed) {
  return printed ? "" : " for eps_r = 1 - sqrt(2 sigma)";
}

Statement range_statement(const Reading& reading, const Readings& readings) {
  const Theorem29Constants& c = reading.constants;
  const EstimateRange range = estimates_of(reading, readings);
  const Interval smallest = square(range.smallest);
  const Interval largest = square(range.largest);
  const bool printed = is_printed(reading);
  const Interval ball = sqrt(Interval(2.0)) * c.epsilon_r;
  const Interval low = printed ? square(Interval(1.0) - ball) : readings.input.sigma;
  const Interval high =
      printed ? square(Interval(1.0) + ball) : Interval(3.0) + Interval(4.0) * c.state_bound;
  // A weak inequality in print, strict in the errata sheet.
  const rigor::Verdict verdict =
      printed ? rigor::conjunction({decide_less_equal(low, smallest), decide_less_equal(largest, high)})
              : rigor::conjunction({decide_less(low, smallest), decide_less(largest, high)});
  return make_statement(gap_id("w_3-range", reading.name),
                        printed
                            ? "For every error with |e| <= eps_r, (1 - sqrt(2) eps_r)^2 <= w3 <= (1 + "
                              "sqrt(2) eps_r)^2."
                            : "For every eps_r in (0, 1 - sqrt(2 sigma)] and every error with |e| <= eps_r, "
                              "sigma < w3 < 3 + 4 R_x.",
                        verdict,
                        "The estimates (1 - eps_r, 0) and (1 + eps_r, 0)" + at_largest(printed) +
                            " have w3 = " + enclosed(smallest) + " and " + enclosed(largest) +
                            "; the ends of the range are " + enclosed(low) + " and " + enclosed(high) + ".",
                        {evidence("w_3_smallest", R"((1 - \epsilon_r)^2)", "", smallest),
                         evidence("w_3_largest", R"((1 + \epsilon_r)^2)", "", largest),
                         evidence("range_low", "", "", low), evidence("range_high", "", "", high)});
}

Statement lower_bound_statement(const Reading& reading, const Readings& readings) {
  const bool printed = is_printed(reading);
  const Interval m = estimates_of(reading, readings).smallest;
  const Interval exact = observability_eigenvalues(m, readings.input.r, readings.input.epsilon).smallest;
  const Interval& bound = reading.constants.b_1;
  return make_statement(
      gap_id("b_1", reading.name),
      printed
          ? "b_1 I <= O(k,1) for every estimate that |e| <= eps_r allows."
          : "b_1 I <= O(k,1) for every eps_r in (0, 1 - sqrt(2 sigma)] and every estimate that |e| <= eps_r "
            "allows.",
      decide_less_equal(bound, exact),
      "At the estimate (1 - eps_r, 0)" + at_largest(printed) + ", 1 - eps_r = " + enclosed(m) +
          ", the smallest eigenvalue is " + enclosed(exact) + "; b_1 is " + enclosed(bound) +
          ". It grows with |z|.",
      {evidence("smallest_eigenvalue", R"(\lambda_{\min})", R"(\lambda_{\min}(\mathcal{O}(k,1)))", exact),
       evidence("b_1", "b_1", "", bound)});
}

Statement upper_bound_statement(const Reading& reading, const Readings& readings) {
  // The errata sheet admits every eps_r below 1, and its b_2 does not depend on sigma: the supremum is the
  // value at |z| = 2, which is not attained, but approached.
  const bool printed = is_printed(reading);
  const Interval m = printed ? estimate_range(reading.constants).largest : Interval(2.0);
  const Interval exact = observability_eigenvalues(m, readings.input.r, readings.input.epsilon).largest;
  const Interval& bound = reading.constants.b_2;
  return make_statement(
      gap_id("b_2", reading.name),
      printed ? "O(k,1) <= b_2 I for every estimate that |e| <= eps_r allows."
              : "O(k,1) <= b_2 I for every eps_r in (0, 1) and every estimate that |e| <= eps_r allows.",
      decide_less_equal(exact, bound),
      (printed ? "At the estimate (1 + eps_r, 0), 1 + eps_r = " + enclosed(m) + ", the largest eigenvalue is "
               : "At the estimate (1 + eps_r, 0), as eps_r tends to 1, the largest eigenvalue tends to ") +
          enclosed(exact) + "; b_2 is " + enclosed(bound) + ". It grows with |z|.",
      {evidence("largest_eigenvalue", R"(\lambda_{\max})", R"(\lambda_{\max}(\mathcal{O}(k,1)))", exact),
       evidence("b_2", "b_2", "", bound)});
}

Statement state_bound_statement(const Readings& readings) {
  const Interval largest = sqrt(Interval(1.0) + square(Interval(2.0) * rigor::pi()));
  const Interval printed = Interval(64.0) / Interval(10.0);
  const Interval& bound = readings.input.state_bound;
  return make_statement(
      gap_id("R_x"),
      "With |x1 + i x2| = 1 and 0 < x3 < 2 pi rad/sample the state has |x(k)| < 6.4, and that is at most "
      "R_x.",
      rigor::conjunction({decide_less(largest, printed), decide_less_equal(printed, bound)}),
      "sqrt(1 + 4 pi^2) is " + enclosed(largest) + "; R_x is " + enclosed(bound) + ".",
      {evidence("largest_state", R"(\sqrt{1 + 4\pi^2})", "", largest), evidence("R_x", "R_x", "", bound)});
}

}  // namespace

EstimateRange admitted_estimates(const Theorem29Input& input) {
  const Interval two_sigma = Interval(2.0) * input.sigma;
  if (!certainly_positive(two_sigma) || !certainly_less(two_sigma, Interval(1.0))) {
    return {};
  }
  const Interval smallest = sqrt(two_sigma);
  return {smallest, Interval(2.0) - smallest};
}

std::vector<Statement> gramian_gaps(const Readings& readings) {
  const Interval one(1.0);
  std::vector<Statement> statements;
  statements.push_back(eigenvalue_statement("printed", readings, one, "|x1 + i x2|^2"));
  statements.push_back(eigenvalue_statement(
      "repaired", readings, square(one / (one - readings.input.epsilon)), "|x1 + i x2|^2 / (1 - epsilon)^2"));
  statements.push_back(time_index_statement(readings));
  for (const Reading& reading : readings.each) {
    statements.push_back(range_statement(reading, readings));
  }
  for (const Reading& reading : readings.each) {
    statements.push_back(lower_bound_statement(reading, readings));
  }
  for (const Reading& reading : readings.each) {
    statements.push_back(upper_bound_statement(reading, readings));
  }
  statements.push_back(state_bound_statement(readings));
  return statements;
}

}  // namespace veritrack::theorems::gaps
