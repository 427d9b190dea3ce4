#include "analysis/theorems/riccati_bounds.hpp"

#include <stdexcept>

#include "analysis/rigor/eigenvalues.hpp"
#include "analysis/rigor/linear_solve.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;

void require(bool fits) {
  if (!fits) {
    throw std::invalid_argument("a window needs N transitions and process noises and N + 1 measurements");
  }
}

void validate(const LinearWindow& window) {
  require(!window.outputs.empty() && window.outputs.size() == window.measurement_noises.size() &&
          window.transitions.size() == window.process_noises.size() &&
          window.outputs.size() == window.transitions.size() + 1);
  const Eigen::Index states = window.outputs.front().cols();
  require(states > 0);
  for (std::size_t i = 0; i < window.outputs.size(); ++i) {
    const Eigen::Index outputs = window.outputs[i].rows();
    require(outputs > 0 && window.outputs[i].cols() == states &&
            window.measurement_noises[i].rows() == outputs && window.measurement_noises[i].cols() == outputs);
  }
  for (const auto* matrices : {&window.transitions, &window.process_noises}) {
    for (const SmallMatrix& matrix : *matrices) {
      require(matrix.rows() == states && matrix.cols() == states);
    }
  }
}

SmallMatrix zero_matrix(Eigen::Index size) {
  return SmallMatrix::Constant(size, size, Interval(0.0));
}

SmallMatrix sum(const std::vector<SmallMatrix>& matrices, Eigen::Index size) {
  SmallMatrix total = zero_matrix(size);
  for (const SmallMatrix& matrix : matrices) {
    total += matrix;
  }
  return total;
}

SmallMatrix symmetric_product(const SmallMatrix& factor, const SmallMatrix& matrix) {
  const SmallMatrix product = factor * matrix;
  return symmetrized(product * factor.transpose());
}

std::optional<SmallMatrix> symmetric_inverse(const SmallMatrix& matrix) {
  const auto inverse = rigor::inverse(matrix);
  return inverse ? std::optional<SmallMatrix>(symmetrized(*inverse)) : std::nullopt;
}

/// An end of the spectrum; empty when unknown.
Interval eigenvalue(const SmallMatrix& matrix, bool largest) {
  const auto eigenvalues = rigor::symmetric_eigenvalues(matrix);
  if (!eigenvalues) {
    return Interval::empty();
  }
  return (*eigenvalues)(largest ? eigenvalues->size() - 1 : 0);
}

}  // namespace

SmallMatrix symmetrized(const SmallMatrix& matrix) {
  return rigor::intersection(matrix, matrix.transpose());
}

std::optional<WindowGramians> window_gramians(const LinearWindow& window) {
  validate(window);
  const std::size_t steps = window.transitions.size();
  const Eigen::Index states = window.outputs.front().cols();
  WindowGramians gramians;
  gramians.information.resize(steps + 1);
  gramians.noise.resize(steps);
  SmallMatrix backward = SmallMatrix::Identity(states, states);  // Phi(i,k)
  SmallMatrix forward = backward;                                // Phi(k,i)
  for (std::size_t i = steps + 1; i-- > 0;) {
    if (i < steps) {
      const auto earlier = rigor::solve(window.transitions[i], backward);
      if (!earlier) {
        return std::nullopt;
      }
      backward = *earlier;
      gramians.noise[i] = symmetric_product(forward, window.process_noises[i]);
      forward = (forward * window.transitions[i]).eval();
    }
    const SmallMatrix seen = window.outputs[i] * backward;
    const auto weighted = rigor::solve(window.measurement_noises[i], seen);
    if (!weighted) {
      return std::nullopt;
    }
    const SmallMatrix weights = *weighted;
    gramians.information[i] = symmetrized(seen.transpose() * weights);
  }
  gramians.observability = sum(gramians.information, states);
  gramians.controllability = sum(gramians.noise, states);
  return gramians;
}

std::optional<SmallMatrix> covariance_bound(const WindowGramians& gramians) {
  const auto inverse = symmetric_inverse(gramians.observability);
  if (!inverse) {
    return std::nullopt;
  }
  SmallMatrix bound = *inverse;
  SmallMatrix earlier = zero_matrix(bound.rows());  // sum of M_i, i <= j
  for (std::size_t j = 0; j < gramians.noise.size(); ++j) {
    earlier += gramians.information[j];
    bound += symmetric_product(*inverse * earlier, gramians.noise[j]);
  }
  return bound;
}

std::optional<SmallMatrix> information_bound(const WindowGramians& gramians) {
  const auto inverse = symmetric_inverse(gramians.controllability);
  if (!inverse) {
    return std::nullopt;
  }
  SmallMatrix bound = *inverse;
  SmallMatrix earlier = zero_matrix(bound.rows());  // D_i
  for (std::size_t i = 1; i < gramians.information.size(); ++i) {
    earlier += gramians.noise[i - 1];
    bound += symmetric_product(*inverse * earlier, gramians.information[i]);
  }
  return bound;
}

std::optional<SmallMatrix> naive_covariance_bound(const WindowGramians& gramians) {
  const auto inverse = symmetric_inverse(gramians.observability);
  return inverse ? std::optional<SmallMatrix>(*inverse + gramians.controllability) : std::nullopt;
}

std::optional<SmallMatrix> naive_information_bound(const WindowGramians& gramians) {
  const auto inverse = symmetric_inverse(gramians.controllability);
  return inverse ? std::optional<SmallMatrix>(*inverse + gramians.observability) : std::nullopt;
}

Interval largest_eigenvalue(const SmallMatrix& matrix) {
  return eigenvalue(matrix, true);
}

Interval smallest_eigenvalue(const SmallMatrix& matrix) {
  return eigenvalue(matrix, false);
}

}  // namespace veritrack::theorems
