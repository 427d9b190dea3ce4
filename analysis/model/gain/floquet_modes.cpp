#include "analysis/model/gain/floquet_modes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "analysis/rigor/eigenpairs.hpp"
#include "analysis/rigor/small_matrix.hpp"

namespace veritrack::model {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

struct Mode {
  Complex multiplier;
  Eigen::MatrixXcd values;  ///< n x grid.size()
  double harmonics = 0.0;   ///< the mean of h^2
  double edge = 0.0;        ///< the share of the highest
};

class Modes {
 public:
  Modes(const PhaseGrid& grid, double omega, const Eigen::MatrixXd& jacobians, Index states)
      : grid_(&grid), omega_(omega), n_(states), jacobians_(jacobians) {
    balance();
  }

  /// The lifts with arguments within omega / 2 and the fewest harmonics.
  [[nodiscard]] FloquetBasis by_mode() const {
    std::vector<Mode> candidates = resolved();
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Mode& a, const Mode& b) { return a.harmonics < b.harmonics; });
    std::vector<Mode> taken;
    std::vector<Eigen::MatrixXd> columns;
    for (const Mode& each : candidates) {
      if (std::fabs(std::arg(each.multiplier)) <= 0.5 * omega_ && add_to(columns, each)) {
        taken.push_back(each);
      }
    }
    return completed(grouped(taken));
  }

  /// The lifts whose means over the phase are farthest from dependent; empty where they are not enough.
  [[nodiscard]] FloquetBasis by_state() const {
    constexpr double kLeast = 0.01;
    std::vector<Eigen::MatrixXd> columns;
    const std::vector<Mode> candidates = resolved();
    while (static_cast<Index>(columns.size()) < n_) {
      const Mode* best = nullptr;
      double most = kLeast;
      for (const Mode& each : candidates) {
        std::vector<Eigen::MatrixXd> with = columns;
        const double left = add_to(with, each) ? mean_left(with) : 0.0;
        if (left > most) {
          most = left;
          best = &each;
        }
      }
      if (best == nullptr || !add_to(columns, *best)) {
        return {};
      }
    }
    FloquetBasis result = completed({columns, std::vector<int>(columns.size(), 0)});
    const Eigen::VectorXd sum = result.values.rowwise().mean();
    const Eigen::MatrixXd back =
        rigor::approximate_inverse(Eigen::Map<const Eigen::MatrixXd>(sum.data(), n_, n_));
    for (int j = 0; j < grid_->size(); ++j) {
      Eigen::Map<Eigen::MatrixXd> there(result.values.col(j).data(), n_, n_);
      there = (there * back).eval();
    }
    return result;
  }

 private:
  /// A column for each mode, by groups.
  struct Columns {
    std::vector<Eigen::MatrixXd> values;
    std::vector<int> group_of;
  };

  [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> jacobian(int j) const {
    return {jacobians_.col(j).data(), n_, n_};
  }

  /// Units in which rows and columns are of the same size.
  void balance() {
    constexpr int kRounds = 20;
    units_ = Eigen::VectorXd::Ones(n_);
    Eigen::MatrixXd size = Eigen::MatrixXd::Zero(n_, n_);
    for (int j = 0; j < grid_->size(); ++j) {
      size = size.cwiseMax(jacobian(j).cwiseAbs());
    }
    size.diagonal().setZero();
    for (int round = 0; round < kRounds; ++round) {
      for (Index i = 0; i < n_; ++i) {
        const double row = size.row(i).sum();
        const double column = size.col(i).sum();
        if (row > 0.0 && column > 0.0) {
          const double unit = std::sqrt(row / column);
          size.row(i) /= unit;
          size.col(i) *= unit;
          units_[i] *= unit;
        }
      }
    }
    for (int j = 0; j < grid_->size(); ++j) {
      Eigen::Map<Eigen::MatrixXd> each(jacobians_.col(j).data(), n_, n_);
      each = (units_.cwiseInverse().asDiagonal() * each * units_.asDiagonal()).eval();
    }
  }

  /// p -> A(phi - omega) p(phi - omega), and its eigenfunctions with few harmonics.
  [[nodiscard]] std::vector<Mode> resolved() const {
    constexpr double kEdge = 1e-8;
    constexpr double kFastest = 3.0;  // by a factor of e in a radian
    const int phases = grid_->size();
    const Eigen::MatrixXd back = grid_->shift(-omega_);
    Eigen::MatrixXd map(n_ * phases, n_ * phases);
    for (int to = 0; to < phases; ++to) {
      for (int from = 0; from < phases; ++from) {
        map.block(to * n_, from * n_, n_, n_) = back(from, to) * jacobian(from);
      }
    }
    const rigor::Eigenpairs found = rigor::eigenpairs(map);
    std::vector<Mode> modes;
    for (Index e = 0; e < found.values.size(); ++e) {
      const Complex value = found.values[e];
      if (!(value.imag() >= 0.0) || !(std::log(std::abs(value)) > -kFastest * omega_)) {
        continue;
      }
      const Eigen::VectorXcd vector = found.vectors.col(e);
      Mode mode{value, Eigen::Map<const Eigen::MatrixXcd>(vector.data(), n_, phases), 0.0, 0.0};
      count_harmonics(mode);
      if (mode.edge < kEdge) {
        modes.push_back(std::move(mode));
      }
    }
    return modes;
  }

  void count_harmonics(Mode& mode) const {
    double sum = 0.0;
    const int most = grid_->harmonics();
    for (const Complex& turn : {Complex(1.0), Complex(0.0, -1.0)}) {
      const Eigen::MatrixXcd waves = harmonics_of((turn * mode.values).real(), most);
      for (int h = 0; h <= most; ++h) {
        const double power = waves.col(h).squaredNorm();
        sum += power;
        mode.harmonics += power * h * h;
        mode.edge += h + 1 >= most ? power : 0.0;
      }
    }
    mode.harmonics /= sum;
    mode.edge /= sum;
  }

  /// False, with no change, where there is no room or the columns would be dependent at some phase.
  [[nodiscard]] bool add_to(std::vector<Eigen::MatrixXd>& columns, const Mode& mode) const {
    std::vector<Eigen::MatrixXd> more = columns;
    more.emplace_back(mode.values.real());
    if (mode.multiplier.imag() != 0.0) {
      more.emplace_back(mode.values.imag());
    }
    if (static_cast<Index>(more.size()) > n_ || !are_independent(more)) {
      return false;
    }
    columns = std::move(more);
    return true;
  }

  /// The smallest share of a column, against its largest entry, that its mean has beside those of the others.
  [[nodiscard]] double mean_left(const std::vector<Eigen::MatrixXd>& columns) const {
    Eigen::MatrixXd means(n_, static_cast<Index>(columns.size()));
    double least = 1.0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Eigen::VectorXd mean = columns[c].rowwise().mean();
      const double share = mean.norm() / columns[c].cwiseAbs().maxCoeff();
      if (!(share > 0.0)) {
        return 0.0;
      }
      least = std::min(least, share);
      means.col(static_cast<Index>(c)) = mean;
    }
    return least * least_left(means);
  }

  /// At every phase.
  [[nodiscard]] bool are_independent(const std::vector<Eigen::MatrixXd>& columns) const {
    constexpr double kLeast = 1e-7;
    for (int j = 0; j < grid_->size(); ++j) {
      Eigen::MatrixXd there(n_, static_cast<Index>(columns.size()));
      for (std::size_t c = 0; c < columns.size(); ++c) {
        there.col(static_cast<Index>(c)) = columns[c].col(j);
      }
      if (!(least_left(there) > kLeast)) {
        return false;
      }
    }
    return true;
  }

  /// Orthogonalises the columns; the smallest share of a column that is left.
  static double least_left(Eigen::MatrixXd& columns) {
    double least = 1.0;
    for (Index c = 0; c < columns.cols(); ++c) {
      const double before = columns.col(c).norm();
      for (int round = 0; round < 2; ++round) {
        for (Index b = 0; b < c; ++b) {
          columns.col(c) -= columns.col(b).dot(columns.col(c)) * columns.col(b);
        }
      }
      const double after = columns.col(c).norm();
      least = std::min(least, after / before);
      columns.col(c) /= after;
    }
    return least;
  }

  /// Modes that are nearly parallel, or whose multipliers are close and that are not nearly orthogonal, get
  /// an orthonormal basis together.
  [[nodiscard]] Columns grouped(const std::vector<Mode>& modes) const {
    constexpr double kClose = 0.2;  // against how fast they decay
    constexpr double kAligned = 0.9;
    constexpr double kAlignedIfClose = 0.3;
    std::vector<int> group(modes.size());
    std::iota(group.begin(), group.end(), 0);
    for (std::size_t a = 0; a < modes.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const double decay = 1.0 - std::max(std::abs(modes[a].multiplier), std::abs(modes[b].multiplier));
        const bool are_close =
            std::abs(modes[a].multiplier - modes[b].multiplier) < kClose * std::fabs(decay);
        if (alignment(modes[a].values, modes[b].values) > (are_close ? kAlignedIfClose : kAligned)) {
          std::replace(group.begin(), group.end(), group[a], group[b]);
        }
      }
    }
    Columns result;
    int number = 0;
    for (std::size_t first = 0; first < modes.size(); ++first) {
      std::vector<Eigen::MatrixXd> members;
      for (std::size_t a = 0; a < modes.size(); ++a) {
        if (group[a] == static_cast<int>(first)) {
          members.emplace_back(modes[a].values.real());
          if (modes[a].multiplier.imag() != 0.0) {
            members.emplace_back(modes[a].values.imag());
          }
        }
      }
      if (members.empty()) {
        continue;
      }
      orthonormalise(members);
      for (Eigen::MatrixXd& each : members) {
        result.values.push_back(std::move(each));
        result.group_of.push_back(number);
      }
      ++number;
    }
    return result;
  }

  /// As functions of the phase.
  static double alignment(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
    const double along =
        std::max(std::abs(a.cwiseProduct(b.conjugate()).sum()), std::abs(a.cwiseProduct(b).sum()));
    return along / (a.norm() * b.norm());
  }

  void orthonormalise(std::vector<Eigen::MatrixXd>& members) const {
    for (std::size_t c = 0; c < members.size(); ++c) {
      for (int round = 0; round < 2; ++round) {
        for (std::size_t b = 0; b < c; ++b) {
          members[c] -= members[b].cwiseProduct(members[c]).sum() / grid_->size() * members[b];
        }
      }
      members[c] *= std::sqrt(grid_->size()) / members[c].norm();
    }
  }

  /// With unit vectors: those with which the columns are least dependent at the worst phase.
  [[nodiscard]] FloquetBasis completed(const Columns& modes) const {
    const Index missing = n_ - static_cast<Index>(modes.values.size());
    std::vector<bool> is_in(static_cast<std::size_t>(n_), false);
    std::fill(is_in.begin(), is_in.begin() + missing, true);
    FloquetBasis best;
    double most = 0.0;
    do {
      Eigen::MatrixXd values(n_ * n_, grid_->size());
      double least = INFINITY;
      for (int j = 0; j < grid_->size(); ++j) {
        Eigen::MatrixXd there = Eigen::MatrixXd::Zero(n_, n_);
        Index place = 0;
        for (const Eigen::MatrixXd& each : modes.values) {
          there.col(place++) = each.col(j);
        }
        for (Index i = 0; i < n_; ++i) {
          if (is_in[static_cast<std::size_t>(i)]) {
            there(i, place++) = 1.0;
          }
        }
        Eigen::Map<Eigen::MatrixXd>(values.col(j).data(), n_, n_) = units_.asDiagonal() * there;
        least = std::min(least, least_left(there));
      }
      if (least > most) {
        most = least;
        best = {std::move(values), modes.group_of};
      }
    } while (std::prev_permutation(is_in.begin(), is_in.end()));
    return best;
  }

  const PhaseGrid* grid_;
  double omega_;
  Index n_;
  Eigen::MatrixXd jacobians_;  ///< in the units
  Eigen::VectorXd units_;
};

}  // namespace

FloquetBasis floquet_modes(const PhaseGrid& grid, double omega, const Eigen::MatrixXd& jacobians,
                           Index states, FloquetGauge gauge) {
  const Modes modes(grid, omega, jacobians, states);
  return gauge == FloquetGauge::by_mode ? modes.by_mode() : modes.by_state();
}

}  // namespace veritrack::model
