// Enclosures of sets of states of the rotating-frame map, for following many starts at once.
//
// Boxes are poor at this: each step turns them, and putting a box around a turned box grows it (wrapping).
// Here small sets are zonotopes, linear images of cubes, which a linear map turns exactly.
#pragma once

#include "analysis/rigor/matrix.hpp"

namespace veritrack::quadrature {

inline constexpr int kStateSize = 9;
inline constexpr int kInputSize = 3;  ///< noise in phase, noise in quadrature, slew
using StateVector = rigor::Vector<kStateSize>;
using StateBox = rigor::IntervalVector<kStateSize>;
using StateMatrix = rigor::IntervalMatrix<kStateSize>;

/// {G s : s in [-1, 1]^m}, the columns of G its generators: a set of small deviations of the state, symmetric
/// about zero. Needs the upward mode. NaN and infinite entries stay, and show in radii().
class Zonotope {
 public:
  /// Many, because each reduction encloses the dropped generators in a box: with a third of this the wrapping
  /// alone grows the set tenfold in forty samples.
  static constexpr Eigen::Index kMostGenerators = 135;
  using Generators =
      Eigen::Matrix<double, kStateSize, Eigen::Dynamic, Eigen::ColMajor, kStateSize, kMostGenerators>;

  /// The point zero.
  Zonotope() : generators_(kStateSize, 0) {}

  [[nodiscard]] const Generators& generators() const noexcept { return generators_; }
  /// Upper bounds on the absolute values of the entries.
  [[nodiscard]] StateVector radii() const;

  /// Adds every vector whose entries are at most these, which are >= 0 or NaN: the smallest generators are
  /// first replaced by a box when there are too many.
  void add_box(const StateVector& radii);
  /// Adds A d for every d with |d_i| <= radii_i and every A in `matrix`: what disturbances do, which push all
  /// entries at once.
  void add_image(const rigor::IntervalMatrix<kStateSize, kInputSize>& matrix,
                 const rigor::Vector<kInputSize>& radii);
  /// Becomes a set that holds A x for every x in it and every A in `matrix`.
  void transform(const StateMatrix& matrix);

 private:
  /// Makes room for this many more generators, at most nine, by a box around the smallest ones.
  void reduce(Eigen::Index room);
  Generators generators_;
};

/// {center + G s + b : s in [-1, 1]^m, |b_i| <= box_i}, with a box that holds all of it.
struct StateEnclosure {
  StateVector center;
  rigor::DynamicMatrix generators;  ///< 9 x m
  StateVector box;
  StateBox hull;
};

}  // namespace veritrack::quadrature
