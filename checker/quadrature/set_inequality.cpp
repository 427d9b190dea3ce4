#include "checker/quadrature/set_inequality.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "checker/quadrature/multipliers.hpp"

namespace veritrack::checker {

namespace step_form {

namespace {

/// (s, beta, d1, d2): a = s A cos(beta), chi = s C sin(beta), and the corrected estimate is d away from the
/// one that the mean gain gives without noise.
struct Cell {
  std::array<double, kVariables> low, high;
  [[nodiscard]] double middle(std::size_t i) const { return 0.5 * (low[i] + high[i]); }
  [[nodiscard]] Ball side(std::size_t i) const { return Ball::hull(Ball(low[i]), Ball(high[i])); }
};

Matrix<double> near(const Matrix<Ball>& m) {
  Matrix<double> result{};
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      result[i][j] = m[i][j].near();
    }
  }
  return result;
}

/// C m C' for a lower triangular C.
Matrix<Ball> congruent(const Matrix<Ball>& c, const Matrix<Ball>& m) {
  Matrix<Ball> left;
  Matrix<Ball> result;
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j < kSize; ++j) {
      for (std::size_t k = 0; k <= i; ++k) {
        arb_addmul(left[i][j].raw(), c[i][k].raw(), (k < j ? m[j][k] : m[k][j]).raw(), precision());
      }
    }
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t k = 0; k <= j; ++k) {
        arb_addmul(result[i][j].raw(), left[i][k].raw(), c[j][k].raw(), precision());
      }
    }
  }
  return result;
}

/// fixed + lambda by_lambda + by_inverse / lambda, of a part of each entry.
template <typename S, typename Part>
Matrix<Ball> combined(const Form<S>& form, double lambda, const Part& part) {
  const Ball over_lambda = one / Ball(lambda);
  Matrix<Ball> m;
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      m[i][j] = part(form.fixed[i][j]) + Ball(lambda) * part(form.by_lambda[i][j]) +
                over_lambda * part(form.by_inverse[i][j]);
    }
  }
  return m;
}

/// Multipliers, and a C for which C m C' is near the identity in the middle of a cell: any are valid.
struct MultiplierProposal {
  double lambda, tau;
  Matrix<Ball> inverse_factor;
};
std::optional<MultiplierProposal> propose(const Form<Ball>& at, const Ball& tangent_squared) {
  const Form<double> rough{near(at.fixed), near(at.by_lambda), near(at.by_inverse), true};
  const double lambda = propose_lambda(rough);
  MultiplierProposal proposal{lambda, propose_tau(rough, lambda, std::sqrt(tangent_squared.near())), {}};
  if (!(proposal.lambda > 0.0) || !(proposal.tau >= 0.0)) {
    return std::nullopt;
  }
  Matrix<double> proposed = with_lambda(rough, lambda);
  proposed[kAlong][kAlong] -= proposal.tau * tangent_squared.near();
  proposed[kAcross][kAcross] += proposal.tau;
  const Matrix<double> factor = inverse_factor(proposed);
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (!std::isfinite(factor[i][j])) {
        return std::nullopt;
      }
      proposal.inverse_factor[i][j] = Ball(factor[i][j]);
    }
  }
  return proposal;
}

/// Adds slope times way to the sum; how far that moves it, all entries together.
double add_moved(const Matrix<Ball>& slope, const Ball& way, Matrix<Ball>& sum) {
  double influence = 0.0;
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const Ball moved = slope[i][j] * way;
      influence += moved.upper_double();
      sum[i][j] += moved;
    }
  }
  return influence;
}

class CellCover {
 public:
  CellCover(const Setting& setting, std::int64_t& cells) : setting_(setting), cells_(cells) {}

  bool is_proved(Cell cell, int depth) {
    if (++cells_ > kMostCells || !clip(cell)) {
      return false;
    }
    std::size_t side = 0;
    if (proves(cell, side)) {
      return true;
    }
    if (depth == 0) {
      return false;
    }
    Cell first = cell;
    Cell second = cell;
    first.high[side] = second.low[side] = cell.middle(side);
    return is_proved(first, depth - 1) && is_proved(second, depth - 1);
  }

 private:
  static constexpr std::int64_t kMostCells = 40000;

  /// Leaves out the (d1, d2) that no point of the cell reaches. False when the reach is not finite.
  bool clip(Cell& cell) const {
    const Ball a = cell.side(0) * setting_.largest_amplitude * cos(cell.side(1));
    const Ball chi = cell.side(0) * setting_.largest_chi * sin(cell.side(1));
    const Correction<Ball> c = correction(setting_, a, chi);
    for (std::size_t i = 0; i < 2; ++i) {
      const double reach = c.reach[i].upper_double();
      if (!std::isfinite(reach)) {
        return false;
      }
      // Where nothing is left any one point is enough: there is nothing to be proved.
      cell.low[2 + i] = std::clamp(cell.low[2 + i], -reach, reach);
      cell.high[2 + i] = std::clamp(cell.high[2 + i], -reach, reach);
    }
    return true;
  }

  /// The mean value theorem: the matrix in the middle plus its derivatives over the cell times the way.
  /// `side` is the variable that moves it most.
  bool proves(const Cell& cell, std::size_t& side) const {
    std::array<Ball, kVariables> middle;
    std::array<Slope, kVariables> range;
    for (std::size_t i = 0; i < kVariables; ++i) {
      middle[i] = Ball(cell.middle(i));
      range[i] = Slope::variable(cell.side(i), i);
      side = cell.high[i] - cell.low[i] > cell.high[side] - cell.low[side] ? i : side;
    }
    const std::array<Ball, 2> axis{cos(middle[1]), sin(middle[1])};
    const Form<Ball> at = form_of(setting_, middle, axis);
    const Form<Slope> over = form_of(setting_, range, axis);
    if (!over.meaningful) {
      return false;
    }
    const Ball angle = range[1].value - middle[1];
    const Ball tangent_squared = square(sin(angle) / cos(angle)).upper();
    const auto proposal = propose(at, tangent_squared);
    // cannot bind (cos(angle)): no cell is wider than half a turn / 8.
    if (!proposal || !certainly_positive(cos(angle))) {
      return false;
    }
    Matrix<Ball> m = combined(at, proposal->lambda, [](const Ball& entry) { return entry; });
    m[kAlong][kAlong] -= Ball(proposal->tau) * tangent_squared;
    m[kAcross][kAcross] += Ball(proposal->tau);
    Matrix<Ball> sum = congruent(proposal->inverse_factor, m);
    double most = 0.0;
    for (std::size_t variable = 0; variable < kVariables; ++variable) {
      const Matrix<Ball> slope = congruent(
          proposal->inverse_factor,
          combined(over, proposal->lambda, [&](const Slope& entry) { return entry.along[variable]; }));
      const double influence = add_moved(slope, range[variable].value - middle[variable], sum);
      if (influence > most && std::isfinite(influence)) {
        most = influence;
        side = variable;
      }
    }
    // C m C' > 0 implies m > 0: C has an inverse, or else C m C' would be singular.
    return definite(sum);
  }

  const Setting& setting_;
  std::int64_t& cells_;
};

}  // namespace

}  // namespace step_form

bool contracts(const Setting& setting, std::int64_t& cells) {
  constexpr int kScales = 4;
  constexpr int kAngles = 8;
  constexpr int kDepth = 24;
  const double half_turn = pi().upper_double();
  step_form::CellCover cover(setting, cells);
  for (int i = 0; i < kScales; ++i) {
    for (int j = 0; j < kAngles; ++j) {
      // The mirror image (psi, nu, P12, P13, v2, w) -> -(...) commutes with the step: 0 <= beta <= pi
      // suffices.
      const step_form::Cell cell{
          {i / static_cast<double>(kScales), half_turn * j / kAngles, -HUGE_VAL, -HUGE_VAL},
          {(i + 1) / static_cast<double>(kScales), half_turn * (j + 1) / kAngles, HUGE_VAL, HUGE_VAL}};
      if (!cover.is_proved(cell, kDepth)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace veritrack::checker
