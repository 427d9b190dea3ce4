#include "analysis/search/constrained.hpp"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <exception>
#include <stdexcept>

#include "analysis/rigor/rounding.hpp"

namespace veritrack::search {

namespace {

using Ipopt::Index;
using Ipopt::Number;

/// The problem in Ipopt's interface. Throws nothing through Ipopt: an exception is stored, and the search
/// stops.
class IpoptProblem : public Ipopt::TNLP {
 public:
  explicit IpoptProblem(const ConstrainedProblem& problem)
      : problem_(problem), result_{problem.start, 0.0, false} {}

  [[nodiscard]] const ConstrainedPoint& result() const { return result_; }
  void rethrow_if_any() const {
    if (thrown_) {
      std::rethrow_exception(thrown_);
    }
  }

  bool get_nlp_info(Index& n, Index& m, Index& nonzeros_jacobian, Index& nonzeros_hessian,
                    IndexStyleEnum& index_style) override {
    n = static_cast<Index>(problem_.start.size());
    m = static_cast<Index>(problem_.constraints_lower.size());
    nonzeros_jacobian = n * m;
    nonzeros_hessian = 0;
    index_style = TNLP::C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* constraints_lower,
                       Number* constraints_upper) override {
    vector(lower, n) = problem_.lower;
    vector(upper, n) = problem_.upper;
    vector(constraints_lower, m) = problem_.constraints_lower;
    vector(constraints_upper, m) = problem_.constraints_upper;
    return true;
  }

  bool get_starting_point(Index n, bool /*init_x*/, Number* x, bool /*init_z*/, Number* /*z_lower*/,
                          Number* /*z_upper*/, Index /*m*/, bool /*init_lambda*/,
                          Number* /*lambda*/) override {
    vector(x, n) = problem_.start;
    return true;
  }

  bool eval_f(Index n, const Number* x, bool /*new_x*/, Number& value) override {
    return guarded([&] { value = problem_.objective(vector(x, n)).value(0); });
  }

  bool eval_grad_f(Index n, const Number* x, bool /*new_x*/, Number* gradient) override {
    return guarded(
        [&] { vector(gradient, n) = problem_.objective(vector(x, n)).jacobian.row(0).transpose(); });
  }

  bool eval_g(Index n, const Number* x, bool /*new_x*/, Index m, Number* values) override {
    return guarded([&] { vector(values, m) = problem_.constraints(vector(x, n)).value; });
  }

  bool eval_jac_g(Index n, const Number* x, bool /*new_x*/, Index m, Index /*nonzeros*/, Index* rows,
                  Index* columns, Number* values) override {
    if (values != nullptr) {
      return guarded([&] {
        const Eigen::MatrixXd jacobian = problem_.constraints(vector(x, n)).jacobian;
        for (Index i = 0; i < m; ++i) {
          for (Index j = 0; j < n; ++j) {
            values[i * n + j] = jacobian(i, j);
          }
        }
      });
    }
    for (Index i = 0; i < m; ++i) {
      for (Index j = 0; j < n; ++j) {
        rows[i * n + j] = i;
        columns[i * n + j] = j;
      }
    }
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn status, Index n, const Number* x, const Number* /*z_lower*/,
                         const Number* /*z_upper*/, Index /*m*/, const Number* /*g*/,
                         const Number* /*lambda*/, Number objective, const Ipopt::IpoptData* /*data*/,
                         Ipopt::IpoptCalculatedQuantities* /*quantities*/) override {
    result_ = {vector(x, n), objective, status == Ipopt::SUCCESS};
  }

 private:
  static Eigen::Map<Eigen::VectorXd> vector(Number* data, Index size) { return {data, size}; }
  static Eigen::Map<const Eigen::VectorXd> vector(const Number* data, Index size) { return {data, size}; }

  template <typename Evaluation>
  bool guarded(const Evaluation& evaluation) {
    try {
      evaluation();
      return true;
    } catch (...) {
      thrown_ = std::current_exception();
      return false;
    }
  }

  const ConstrainedProblem& problem_;
  ConstrainedPoint result_;
  std::exception_ptr thrown_;
};

}  // namespace

ConstrainedPoint minimize_constrained(const ConstrainedProblem& problem) {
  const Eigen::Index size = problem.start.size();
  if (size == 0 || problem.lower.size() != size || problem.upper.size() != size ||
      problem.constraints_lower.size() != problem.constraints_upper.size()) {
    throw std::invalid_argument("minimize_constrained: sizes differ");
  }
  const rigor::NearestRounding nearest;
  const Ipopt::SmartPtr<IpoptProblem> ipopt_problem = new IpoptProblem(problem);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = IpoptApplicationFactory();
  application->Options()->SetIntegerValue("print_level", 0);
  application->Options()->SetStringValue("sb", "yes");
  application->Options()->SetStringValue("hessian_approximation", "limited-memory");
  application->Options()->SetNumericValue("tol", problem.tolerance);
  application->Options()->SetNumericValue("bound_relax_factor", 0.0);
  application->Options()->SetNumericValue("compl_inf_tol", problem.tolerance);
  application->Options()->SetIntegerValue("acceptable_iter", 0);
  application->Options()->SetIntegerValue("max_iter", problem.iterations);
  application->Initialize("");  // no option file
  application->OptimizeTNLP(ipopt_problem);
  ipopt_problem->rethrow_if_any();
  return ipopt_problem->result();
}

}  // namespace veritrack::search
