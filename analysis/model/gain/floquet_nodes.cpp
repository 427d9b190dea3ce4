#include "analysis/model/gain/floquet_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "analysis/rigor/rounding.hpp"
#include "analysis/rigor/small_matrix.hpp"
#include "analysis/rigor/spectral_radius.hpp"

namespace veritrack::model {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

/// X with e X B - A X = R, by elimination; false where there is no solution. `x`: R, then X.
bool solve_sylvester(Complex e, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXcd& x) {
  const Index rows = a.rows();
  const Index columns = b.rows();
  const Index size = rows * columns;
  Eigen::MatrixXcd lines = Eigen::MatrixXcd::Zero(size, size + 1);
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      const Index line = i * columns + j;
      for (Index k = 0; k < columns; ++k) {
        lines(line, i * columns + k) += e * b(k, j);
      }
      for (Index k = 0; k < rows; ++k) {
        lines(line, k * columns + j) -= a(i, k);
      }
      lines(line, size) = x(i, j);
    }
  }
  for (Index p = 0; p < size; ++p) {
    Index pivot = p;
    for (Index i = p + 1; i < size; ++i) {
      pivot = std::abs(lines(i, p)) > std::abs(lines(pivot, p)) ? i : pivot;
    }
    if (!(std::abs(lines(pivot, p)) > 1e-14)) {
      return false;
    }
    lines.row(p).swap(lines.row(pivot));
    for (Index i = 0; i < size; ++i) {
      if (i != p) {
        const Complex factor = lines(i, p) / lines(p, p);
        for (Index j = p; j <= size; ++j) {
          lines(i, j) -= factor * lines(p, j);
        }
      }
    }
  }
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j) {
      const Index line = i * columns + j;
      x(i, j) = lines(line, size) / lines(line, line);
    }
  }
  return true;
}

/// Matrices on a grid of phases, column-major in columns.
Eigen::Map<Eigen::MatrixXd> matrix_at(Eigen::MatrixXd& values, int j, Index n) {
  return {values.col(j).data(), n, n};
}
Eigen::Map<const Eigen::MatrixXd> matrix_at(const Eigen::MatrixXd& values, int j, Index n) {
  return {values.col(j).data(), n, n};
}

/// The functions with these harmonics.
Eigen::MatrixXd on_grid(const Eigen::MatrixXcd& harmonics, const PhaseGrid& grid) {
  Eigen::MatrixXd values(harmonics.rows(), grid.size());
  for (int j = 0; j < grid.size(); ++j) {
    values.col(j) = value_at(harmonics, grid.phase(j));
  }
  return values;
}

/// Newton's method for P with P(phi + omega)^-1 A(phi) P(phi) = [L, 0; 0, F(phi)], L constant and of one
/// block for each group of modes, where their multipliers differ.
class Refinement {
 public:
  /// No more than these harmonics of the basis are kept; the grid resolves half as many again, because the
  /// aliases of products would grow from step to step.
  Refinement(const TrackedTone& tone, const NodeCurve& curve, const PhaseGrid& grid, int harmonics,
             FloquetBasis basis)
      : grid_(&grid),
        harmonics_(harmonics),
        n_(static_cast<Index>(tone.step.states())),
        m_(basis.modes()),
        omega_(curve.frequency),
        jacobians_(jacobians_along(tone, curve, grid)),
        later_(grid.shift(curve.frequency)),
        earlier_(grid.shift(-curve.frequency)),
        kept_(grid.shift(0.0, harmonics)),
        basis_(std::move(basis)) {}

  [[nodiscard]] const FloquetBasis& basis() const { return basis_; }

  /// False where it does not converge.
  bool solve() {
    constexpr int kMostSteps = 30;
    constexpr double kEnough = 1e-6;  // what is left, also of harmonics that are not kept, is an error
    double change = INFINITY;
    for (int step = 0; step < kMostSteps; ++step) {
      look();
      const double before = std::exchange(change, improve());
      if (!(change < 1e6)) {
        return false;
      }
      if (change < 1e-11 || (change < kEnough && change >= 0.5 * before)) {
        break;
      }
    }
    return change < kEnough;
  }

  /// Turns the two columns of each pair so that the diagonal of its block has equal entries: two close modes
  /// have a block like m, s; 0, m then, whose powers have no entries that cancel.
  void even_out_pairs() {
    look();
    for (const auto& [first, size] : groups()) {
      if (size != 2) {
        continue;
      }
      const auto block = mean_.block(first, first, 2, 2);
      const double angle = 0.5 * std::atan2(block(1, 1) - block(0, 0), block(0, 1) + block(1, 0));
      for (int j = 0; j < grid_->size(); ++j) {
        auto there = matrix_at(basis_.values, j, n_);
        const Eigen::VectorXd one = there.col(first);
        const Eigen::VectorXd two = there.col(first + 1);
        there.col(first) = std::cos(angle) * one + std::sin(angle) * two;
        there.col(first + 1) = std::cos(angle) * two - std::sin(angle) * one;
      }
    }
  }

  /// Scales what decays faster by a function of the phase, so that the factor of a sample varies less: it may
  /// be 1 at some phases (of a filter's covariance, where the sample tells nothing of the parameter). Only as
  /// far as the scale itself varies little.
  void even_out_fast() {
    constexpr int kHarmonics = 8;
    constexpr double kMost = 1.2;  // of the scale's logarithm
    constexpr double kSlow = 0.9;  // where all decay faster there is nothing to correct
    const Index fast = n_ - m_;
    if (fast == 0) {
      return;
    }
    look();
    Eigen::MatrixXd rates(1, grid_->size());
    for (int j = 0; j < grid_->size(); ++j) {
      const auto factor = matrix_at(seen_, j, n_).bottomRightCorner(fast, fast);
      rates(0, j) = std::log(std::max(factor.cwiseAbs().rowwise().sum().maxCoeff(), 1e-3));
    }
    if (!(rates.maxCoeff() > std::log(kSlow))) {
      return;
    }
    // g(phi + omega) - g(phi) = rate - mean.
    Eigen::MatrixXcd waves = harmonics_of(rates, kHarmonics);
    waves(0, 0) = 0.0;
    for (int h = 1; h <= kHarmonics; ++h) {
      waves(0, h) /= std::polar(1.0, h * omega_) - 1.0;
    }
    const Eigen::MatrixXd logarithm = on_grid(waves, *grid_);
    const double share = std::min(1.0, kMost / logarithm.cwiseAbs().maxCoeff());
    for (int j = 0; j < grid_->size(); ++j) {
      matrix_at(basis_.values, j, n_).rightCols(fast) *= std::exp(share * logarithm(0, j));
    }
  }

  /// Makes it depend on the frequency smoothly: the mean of reference^-1 P has the unit matrix in the block
  /// of each group, and that of the others is the unit matrix at every phase.
  void normalise(const FloquetBasis& reference) {
    Eigen::MatrixXd seen(n_ * n_, grid_->size());
    for (int j = 0; j < grid_->size(); ++j) {
      matrix_at(seen, j, n_) = rigor::product(rigor::approximate_inverse(matrix_at(reference.values, j, n_)),
                                              matrix_at(basis_.values, j, n_));
    }
    const Eigen::VectorXd sum = seen.rowwise().mean();
    const Eigen::Map<const Eigen::MatrixXd> mean(sum.data(), n_, n_);
    Eigen::MatrixXd back = Eigen::MatrixXd::Zero(n_, n_);
    for (const auto& [first, size] : groups()) {
      back.block(first, first, size, size) = rigor::approximate_inverse(mean.block(first, first, size, size));
    }
    const Index fast = n_ - m_;
    for (int j = 0; j < grid_->size(); ++j) {
      if (fast > 0) {
        back.bottomRightCorner(fast, fast) =
            rigor::approximate_inverse(matrix_at(seen, j, n_).bottomRightCorner(fast, fast));
      }
      matrix_at(basis_.values, j, n_) = rigor::product(matrix_at(basis_.values, j, n_), back).eval();
    }
  }

  [[nodiscard]] FloquetNode node() {
    look();
    FloquetNode node{Eigen::MatrixXcd(n_ * n_, harmonics_ + 1), mean_};
    const Eigen::MatrixXcd waves = harmonics_of(basis_.values, harmonics_);
    for (Index i = 0; i < n_; ++i) {
      for (Index j = 0; j < n_; ++j) {
        node.basis.row(i * n_ + j) = waves.row(j * n_ + i);
      }
    }
    return node;
  }

 private:
  struct Group {
    Index first, size;
  };
  [[nodiscard]] std::vector<Group> groups() const {
    std::vector<Group> result;
    for (Index i = 0; i < m_; ++i) {
      const auto place = static_cast<std::size_t>(i);
      if (i == 0 || basis_.group_of[place] != basis_.group_of[place - 1]) {
        result.push_back({i, 0});
      }
      ++result.back().size;
    }
    return result;
  }

  /// The matrix of the errors in this basis, and its mean.
  void look() {
    const Eigen::MatrixXd there = basis_.values * later_;
    seen_.resize(n_ * n_, grid_->size());
    for (int j = 0; j < grid_->size(); ++j) {
      matrix_at(seen_, j, n_) =
          rigor::product(rigor::approximate_inverse(matrix_at(there, j, n_)),
                         rigor::product(matrix_at(jacobians_, j, n_), matrix_at(basis_.values, j, n_)));
    }
    const Eigen::VectorXd sum = seen_.rowwise().mean();
    mean_ = Eigen::Map<const Eigen::MatrixXd>(sum.data(), n_, n_);
  }

  /// One step; returns its size, NaN where it has none.
  double improve() {
    Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n_ * n_, grid_->size());
    if (!separate_modes(factor) || !separate_fast(factor)) {
      return NAN;
    }
    double size = 0.0;
    for (int j = 0; j < grid_->size(); ++j) {
      const Eigen::MatrixXd more = rigor::product(matrix_at(basis_.values, j, n_), matrix_at(factor, j, n_));
      size = std::max(size, matrix_at(factor, j, n_).cwiseAbs().maxCoeff());
      matrix_at(basis_.values, j, n_) += more;
    }
    basis_.values = (basis_.values * kept_).eval();
    return size;
  }

  /// Whether the multipliers of two groups differ. The coupling of those that do not stays in the matrix.
  [[nodiscard]] bool are_apart(const Group& a, const Group& b) const {
    constexpr double kClose = 0.2;  // against how fast they decay
    if (a.first == b.first) {
      return false;
    }
    for (const auto& one : rigor::eigenvalues_by_size(mean_.block(a.first, a.first, a.size, a.size))) {
      for (const auto& two : rigor::eigenvalues_by_size(mean_.block(b.first, b.first, b.size, b.size))) {
        const double decay = 1.0 - std::max(std::abs(one), std::abs(two));
        if (!(std::abs(one - two) > kClose * std::fabs(decay))) {
          return false;
        }
      }
    }
    return true;
  }

  /// Removes the change with the phase, and the coupling of groups.
  bool separate_modes(Eigen::MatrixXd& factor) const {
    const Eigen::MatrixXcd waves = harmonics_of(seen_, harmonics_);
    for (int h = 0; h <= harmonics_; ++h) {
      const Eigen::VectorXcd column = waves.col(h);
      const Eigen::Map<const Eigen::MatrixXcd> wave(column.data(), n_, n_);
      for (const Group& to : groups()) {
        for (const Group& from : groups()) {
          Eigen::MatrixXcd x = wave.block(to.first, from.first, to.size, from.size);
          if ((h == 0 && !are_apart(to, from)) || !(x.cwiseAbs().maxCoeff() > 1e-17)) {
            continue;
          }
          if (!solve_sylvester(std::polar(1.0, h * omega_), mean_.block(to.first, to.first, to.size, to.size),
                               mean_.block(from.first, from.first, from.size, from.size), x)) {
            return false;
          }
          for (int j = 0; j < grid_->size(); ++j) {
            matrix_at(factor, j, n_).block(to.first, from.first, to.size, from.size) +=
                (x * std::polar(1.0, h * grid_->phase(j))).real();
          }
        }
      }
    }
    return true;
  }

  /// Separates the modes from the others, which decay faster: by the recursions for their coupling, each in
  /// the direction in which it converges.
  bool separate_fast(Eigen::MatrixXd& factor) const {
    constexpr int kMostRounds = 3000;
    const Index fast = n_ - m_;
    if (fast == 0) {
      return true;
    }
    const Eigen::MatrixXd back = rigor::approximate_inverse(mean_.topLeftCorner(m_, m_));
    Eigen::MatrixXd by_modes = Eigen::MatrixXd::Zero(fast * m_, grid_->size());
    Eigen::MatrixXd by_fast = by_modes;
    for (int round = 0; round < kMostRounds; ++round) {
      Eigen::MatrixXd next(fast * m_, grid_->size());
      const Eigen::MatrixXd fast_later = by_fast * later_;
      Eigen::MatrixXd fast_next(fast * m_, grid_->size());
      for (int j = 0; j < grid_->size(); ++j) {
        const auto seen = matrix_at(seen_, j, n_);
        const Eigen::Map<const Eigen::MatrixXd> now(by_modes.col(j).data(), fast, m_);
        Eigen::Map<Eigen::MatrixXd>(next.col(j).data(), fast, m_) =
            (seen.bottomRightCorner(fast, fast) * now + seen.bottomLeftCorner(fast, m_)) * back;
        const Eigen::Map<const Eigen::MatrixXd> later(fast_later.col(j).data(), m_, fast);
        Eigen::Map<Eigen::MatrixXd>(fast_next.col(j).data(), m_, fast) =
            back * (later * seen.bottomRightCorner(fast, fast) - seen.topRightCorner(m_, fast));
      }
      next = (next * earlier_).eval();
      const double change =
          std::max((next - by_modes).cwiseAbs().maxCoeff(), (fast_next - by_fast).cwiseAbs().maxCoeff());
      by_modes = std::move(next);
      by_fast = std::move(fast_next);
      if (!(change < 1e12)) {
        return false;
      }
      if (change < 1e-14 * (1.0 + by_fast.cwiseAbs().maxCoeff())) {
        break;
      }
    }
    for (int j = 0; j < grid_->size(); ++j) {
      auto there = matrix_at(factor, j, n_);
      there.bottomLeftCorner(fast, m_) = Eigen::Map<const Eigen::MatrixXd>(by_modes.col(j).data(), fast, m_);
      there.topRightCorner(m_, fast) = Eigen::Map<const Eigen::MatrixXd>(by_fast.col(j).data(), m_, fast);
    }
    return true;
  }

  const PhaseGrid* grid_;
  int harmonics_;
  Index n_, m_;
  double omega_;
  Eigen::MatrixXd jacobians_, later_, earlier_, kept_;
  FloquetBasis basis_;
  Eigen::MatrixXd seen_, mean_;
};

}  // namespace

std::optional<std::vector<FloquetNode>> floquet_nodes(const TrackedTone& tone,
                                                      const std::vector<NodeCurve>& curves,
                                                      FloquetGauge gauge, int harmonics) {
  const auto n = static_cast<int>(tone.step.states());
  constexpr int kCoarse = 24;
  constexpr int kMostRows = 300;  // of a matrix whose eigenvectors are found
  const PhaseGrid coarse(std::min({harmonics, kCoarse, (kMostRows / n - 1) / 2}));
  const PhaseGrid grid(harmonics + harmonics / 2);
  const std::size_t middle = curves.size() / 2;
  FloquetBasis modes = floquet_modes(coarse, curves[middle].frequency,
                                     jacobians_along(tone, curves[middle], coarse), n, gauge);
  if (modes.modes() == 0) {
    return std::nullopt;
  }
  modes.values = on_grid(harmonics_of(modes.values, coarse.harmonics()), grid);
  Refinement reference(tone, curves[middle], grid, harmonics, std::move(modes));
  if (!reference.solve()) {
    return std::nullopt;
  }
  if (gauge == FloquetGauge::by_mode) {
    reference.even_out_pairs();
  }
  reference.even_out_fast();
  std::vector<FloquetNode> nodes(curves.size());
  nodes[middle] = reference.node();
  FloquetBasis nearest = reference.basis();
  const auto go_on_to = [&](std::size_t i) {
    Refinement here(tone, curves[i], grid, harmonics, nearest);
    if (!here.solve()) {
      return false;
    }
    here.normalise(reference.basis());
    nodes[i] = here.node();
    nearest = here.basis();
    return true;
  };
  for (std::size_t i = middle; i-- > 0;) {
    if (!go_on_to(i)) {
      return std::nullopt;
    }
  }
  nearest = reference.basis();
  for (std::size_t i = middle + 1; i < curves.size(); ++i) {
    if (!go_on_to(i)) {
      return std::nullopt;
    }
  }
  return nodes;
}

}  // namespace veritrack::model
