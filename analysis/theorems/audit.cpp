#include "analysis/theorems/audit.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "analysis/rigor/eigenvalues.hpp"
#include "analysis/theorems/audit_record.hpp"
#include "analysis/theorems/homogeneous_trajectory.hpp"
#include "analysis/theorems/signal_model.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;
using rigor::IntervalVector;
using rigor::Verdict;

struct Row {
  std::string_view id, statement, source;
  AuditKind kind;
  std::size_t first_step;
  std::string_view quantity;  // the name of the bound in the derivation; empty: it always exists
};

constexpr auto kAssumption = AuditKind::assumption;
constexpr auto kClaim = AuditKind::claim;
constexpr std::string_view kErrorBound = "error_bound";

constexpr auto kRows = std::to_array<Row>({
    {"R_x", R"(\lvert x(k) \rvert \le R_x)", "thesis, (2.26)", kAssumption, 0, "R_x"},
    {"unit_circle", R"(\lvert x_1(k)^2 + x_2(k)^2 - 1 \rvert \le 10^{-9})",
     "thesis, section 3.5 (the signal is on the unit circle; the tolerance is for rounding)", kAssumption, 0,
     ""},
    {"epsilon_r", R"(\lvert e(k \mid k) \rvert \le \epsilon_r)", "thesis, section 2.4.1", kAssumption, 0,
     "epsilon_r"},
    {"process_noise", R"(\lvert w(k) \rvert \le c_1 \sqrt{q_2})", "thesis, (2.28) and section 3.5",
     kAssumption, 0, ""},
    {"measurement_noise", R"(\lvert v(k) \rvert \le c_2 \sqrt{r})", "thesis, (2.29) and section 3.5",
     kAssumption, 1, ""},
    {"estimate_bound", R"(\lvert \hat{x}(k \mid k) \rvert \le R_x + \epsilon_r)", "thesis, section 2.4.3",
     kClaim, 0, "epsilon_r"},
    {"rho_1", R"(\lVert \partial f / \partial x (\hat{x}(k \mid k)) \rVert \le \rho_1)", "thesis, (2.30)",
     kClaim, 0, "rho_1"},
    {"rho_2", R"(\lVert \partial^2 f / \partial x^2 (\hat{x}(k \mid k)) \rVert \le \rho_2)", "thesis, (2.31)",
     kClaim, 0, "rho_2"},
    {"rho_3", R"(\lVert \partial^3 f / \partial x^3 (\hat{x}(k \mid k)) \rVert \le \rho_3)", "thesis, (2.32)",
     kClaim, 0, "rho_3"},
    {"rho_4",
     R"(\lVert \partial f / \partial x (x(k)) - )"
     R"(\partial f / \partial x (\hat{x}(k \mid k)) \rVert \le \rho_4 \lvert e(k \mid k) \rvert)",
     "thesis, section 2.4.3, above (2.33)", kClaim, 0, "rho_4"},
    {"a_1", R"(\mathcal{C}(k, 1) \le a_1 I)", "thesis, (2.24)", kClaim, 1, "a_1"},
    {"a_2", R"(\mathcal{C}(k, 1) \ge a_2 I)", "thesis, (2.24)", kClaim, 1, "a_2"},
    {"b_1", R"(\mathcal{O}(k, 1) \ge b_1 I)", "thesis, (2.25)", kClaim, 1, "b_1"},
    {"b_2", R"(\mathcal{O}(k, 1) \le b_2 I)", "thesis, (2.25)", kClaim, 1, "b_2"},
    {"p", R"(P(k \mid k) \le p I)", "thesis, section 2.4.3", kClaim, 1, "p"},
    {"q_filtered", R"(P(k \mid k) \ge q^{-1} I)", "thesis, section 2.4.3", kClaim, 1, "q"},
    {"s", R"(P(k+1 \mid k) \le s I)", "thesis, section 2.4.3", kClaim, 1, "s"},
    {"q_predicted", R"(P(k+1 \mid k) \ge q^{-1} I)", "thesis, section 2.4.3", kClaim, 1, "q"},
    {"gamma", R"(V(k, z(k)) - V(k+1, z(k+1)) \ge \gamma \lvert z(k) \rvert^2)",
     "thesis, proof of Theorem 2.8", kClaim, 0, "initial_error_bound"},
    {"epsilon_z", R"(\lvert z(k) \rvert \le \epsilon_z)", "thesis, Theorem 2.8", kClaim, 0,
     "initial_error_bound"},
    {"alpha_beta", R"(\lvert z(k) \rvert \le \beta \alpha^k \lvert z(0) \rvert)", "thesis, (2.36)", kClaim, 0,
     "initial_error_bound"},
    {kErrorBound, R"(\lvert e(k \mid k) \rvert \le \text{the bound of Theorem 2.9})", "thesis, Theorem 2.9",
     kClaim, 0, ""},
});

/// The records of all rows, by id.
class Records {
 public:
  explicit Records(const Theorem29& theorem) {
    records_.reserve(kRows.size());
    for (const Row& row : kRows) {
      AuditedInequality inequality;
      inequality.id = row.id;
      inequality.statement = row.statement;
      inequality.source = row.source;
      inequality.kind = row.kind;
      inequality.first_step = row.first_step;
      std::optional<std::string> reason;
      if (row.id == kErrorBound && !theorem.error_bound) {
        reason = "The conditions of the theorem are not all proved, so it gives no error bound.";
      } else if (!row.quantity.empty()) {
        reason = find_quantity(theorem.derivation, std::string(row.quantity)).not_applicable;
      }
      records_.emplace_back(std::move(inequality), std::move(reason));
    }
  }

  AuditRecord& operator[](std::string_view id) {
    return *std::find_if(records_.begin(), records_.end(),
                         [id](const AuditRecord& record) { return record.inequality().id == id; });
  }
  [[nodiscard]] std::vector<AuditedInequality> inequalities() const {
    std::vector<AuditedInequality> result;
    for (const AuditRecord& record : records_) {
      result.push_back(record.inequality());
    }
    return result;
  }

 private:
  std::vector<AuditRecord> records_;
};

/// Least and largest eigenvalue of the symmetric part, on which alone z'Pz depends.
struct Extremes {
  Interval smallest, largest;
};
Extremes eigenvalue_range(const Eigen::Matrix3d& matrix) {
  const auto entries = rigor::to_interval(matrix);
  const rigor::IntervalMatrix<3> doubled = entries + entries.transpose();
  const auto eigenvalues = rigor::symmetric_eigenvalues(doubled);
  if (!eigenvalues) {
    return {};
  }
  const Interval two(2.0);
  return {(*eigenvalues)(0) / two, (*eigenvalues)(2) / two};
}

/// The data that the audit needs at every step.
struct Context {
  const Theorem29& theorem;
  const Theorem29Input& input;
  const Trajectory& trajectory;
  Records& records;
};

/// The assumptions at step k; true when all of them are certainly satisfied.
bool audit_assumptions(const Context& context, std::size_t k) {
  const TrajectoryRecord& record = context.trajectory[k];
  const Theorem29Constants& c = context.theorem.constants;
  const IntervalVector<3> x = rigor::to_interval(record.true_state);
  const IntervalVector<3> error = x - rigor::to_interval(record.filtered_state);
  const Interval off_circle = abs(square(x(0)) + square(x(1)) - Interval(1.0));
  std::vector<Verdict> verdicts = {
      context.records["R_x"].at_most(k, euclidean_norm<3>(x), c.state_bound),
      context.records["unit_circle"].at_most(k, off_circle, Interval(1e-9)),
      context.records["epsilon_r"].at_most(k, euclidean_norm<3>(error), c.epsilon_r)};
  if (k > 0) {
    const IntervalVector<2> noise = rigor::to_interval(record.measurement) - x.head<2>();
    verdicts.push_back(
        context.records["measurement_noise"].at_most(k, euclidean_norm<2>(noise), c.measurement_noise_bound));
  }
  if (k + 1 < context.trajectory.size()) {
    const IntervalVector<3> noise =
        rigor::to_interval(context.trajectory[k + 1].true_state) - transition(x, context.input.epsilon);
    verdicts.push_back(
        context.records["process_noise"].at_most(k, euclidean_norm<3>(noise), c.process_noise_bound));
  }
  return rigor::conjunction(verdicts) == Verdict::proved;
}

/// The signal model's bounds, section 2.4.3, and the Gramians, section 2.4.1.
void audit_signal_model(const Context& context, std::size_t k) {
  const TrajectoryRecord& record = context.trajectory[k];
  const Theorem29Constants& c = context.theorem.constants;
  const Theorem29Input& input = context.input;
  Records& records = context.records;
  const IntervalVector<3> x = rigor::to_interval(record.true_state);
  const IntervalVector<3> estimate = rigor::to_interval(record.filtered_state);
  const IntervalVector<3> error = x - estimate;
  const Interval m = signal_magnitude(estimate);
  records["estimate_bound"].at_most(k, euclidean_norm<3>(estimate), c.state_bound + c.epsilon_r);
  records["rho_1"].at_most(k, first_derivative_norm(m, input.epsilon), c.rho_1);
  records["rho_2"].at_most(k, second_derivative_norm(m), c.rho_2);
  records["rho_3"].at_most(k, third_derivative_norm(m), c.rho_3);
  records["rho_4"].at_most(k, first_derivative_distance(x, estimate), c.rho_4 * euclidean_norm<3>(error));
  if (k == 0) {
    return;
  }
  // C(k, 1) is Q for every trajectory, with eigenvalues q1 and q2: both margins are min(q2 - q1, 0),
  // exactly zero where these are the same number.
  const Interval margin = input.q1_equals_q2 ? Interval(0.0) : min(input.q2 - input.q1, Interval(0.0));
  records["a_1"].add(k, margin, c.a_1);
  records["a_2"].add(k, margin, c.a_2);
  const Interval before = signal_magnitude(rigor::to_interval(context.trajectory[k - 1].filtered_state));
  const GramianEigenvalues observability = observability_eigenvalues(before, input.r, input.epsilon);
  records["b_1"].at_least(k, observability.smallest, c.b_1);
  records["b_2"].at_most(k, observability.largest, c.b_2);
}

/// The Riccati bounds of section 2.4.3 and the error bound.
void audit_estimator(const Context& context, std::size_t k) {
  const TrajectoryRecord& record = context.trajectory[k];
  const Theorem29Constants& c = context.theorem.constants;
  Records& records = context.records;
  const Interval inverse_q = Interval(1.0) / c.q;
  const Extremes filtered = eigenvalue_range(record.filtered_covariance);
  const Extremes predicted = eigenvalue_range(record.predicted_covariance);
  records["p"].at_most(k, filtered.largest, c.p);
  records["q_filtered"].at_least(k, filtered.smallest, inverse_q);
  records["s"].at_most(k, predicted.largest, c.s);
  records["q_predicted"].at_least(k, predicted.smallest, inverse_q);
  if (context.theorem.error_bound) {
    const IntervalVector<3> error =
        rigor::to_interval(record.true_state) - rigor::to_interval(record.filtered_state);
    records[kErrorBound].at_most(k, euclidean_norm<3>(error),
                                 context.theorem.error_bound->at(static_cast<int>(k)));
  }
}

/// Theorem 2.8 along (2.34), started at half of the allowed length in the direction of the initial error.
void audit_homogeneous(const Context& context) {
  const Theorem29Constants& c = context.theorem.constants;
  const Trajectory& trajectory = context.trajectory;
  // cannot bind (c.initial_error_bound): from a start of length 0 no relative size is a number, and one of
  // negative length is the start in the opposite direction; an audit samples, and proves nothing.
  if (trajectory.empty() || !is_finite(c.initial_error_bound) || !certainly_positive(c.initial_error_bound)) {
    return;
  }
  const trackers::ToneModel<Interval> design{context.input.q1, context.input.q2, context.input.r,
                                             context.input.epsilon};
  const TrajectoryRecord& start = trajectory.front();
  HomogeneousState z = start_homogeneous(start.true_state - start.filtered_state,
                                         0.5 * c.initial_error_bound.lower(), start.filtered_covariance);
  const Interval alpha = Interval(1.0) - c.one_minus_alpha;
  const Interval initial = magnitude_of(z);
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const Interval size = magnitude_of(z);
    context.records["epsilon_z"].at_most(k, size, c.epsilon_z);
    // Divided by |z(0)|, so that neither side underflows.
    context.records["alpha_beta"].at_most(k, size / initial, c.beta * pow(alpha, static_cast<int>(k)));
    if (k + 1 < trajectory.size()) {
      const HomogeneousStep step = step_homogeneous(z, trajectory[k].true_state, design);
      context.records["gamma"].at_least(k, step.relative_decrease, c.gamma);
      z = step.next;
    }
  }
}

}  // namespace

Audit audit_theorem_2_9(const Theorem29& theorem, const Theorem29Input& input, const Trajectory& trajectory) {
  const rigor::UpwardRounding upward;
  Records records(theorem);
  const Context context{theorem, input, trajectory, records};
  Audit audit;
  bool within_assumptions = true;
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const bool assumed = audit_assumptions(context, k);
    within_assumptions = within_assumptions && assumed;
    audit.steps_within_assumptions += within_assumptions ? 1 : 0;
    audit_signal_model(context, k);
    audit_estimator(context, k);
  }
  audit_homogeneous(context);
  audit.inequalities = records.inequalities();
  return audit;
}

const AuditedInequality& find_inequality(const Audit& audit, const std::string& id) {
  const auto found = std::find_if(audit.inequalities.begin(), audit.inequalities.end(),
                                  [&](const AuditedInequality& inequality) { return inequality.id == id; });
  if (found == audit.inequalities.end()) {
    throw std::out_of_range("no audited inequality named " + id);
  }
  return *found;
}

}  // namespace veritrack::theorems
