// Covariances of the single-channel tracker over a cell of phases and frequencies, in the frame of the
// signal.
#pragma once

#include "checker/numbers/cell_series.hpp"
#include "checker/single_channel/single_channel_design.hpp"

namespace veritrack::checker {

/// A symmetric matrix over a cell, by its lower triangle.
struct CellCovariance {
  CellSeries p11, p21, p22, p31, p32, p33;
};

/// diag(signal, signal, frequency).
CellCovariance diagonal(const Ball& signal, const Ball& frequency);
/// factor p.
CellCovariance scaled(const Ball& factor, const CellCovariance& p);
/// a - factor b.
CellCovariance less(const CellCovariance& a, const Ball& factor, const CellCovariance& b);

/// True only when the matrix is positive definite all over the cell: when it is at the corners, minus a bound
/// on the quadratic part, because the linear part is between its values there.
bool definite(const CellCovariance& a CHECKER_PLACE);

/// The step of the signal to a sample: it turns by the frequency (once), into the phase `here`.
struct Turn {
  SineCosine once, twice, here;
};

/// keep A P A' + diag(q1 + added, q1 + added, q2): A turns the first two components by the frequency and adds
/// the third, times i e^{i here}.
CellCovariance predicted(const CellCovariance& p, const Turn& turn, const Ball& keep, const Ball& added,
                         const SingleChannelDesign& design);

/// After a measurement of the first component with variance r. A bound on P gives one on the updated P,
/// whatever its sign, only where P11 + r > 0; elsewhere the result is unknown.
CellCovariance updated(const CellCovariance& p, const Ball& r);

/// A matrix without remainders, at least (sign 1) or at most (sign -1) every one that `p` contains.
CellCovariance without_remainder(CellCovariance p, const Ball& sign);

}  // namespace veritrack::checker
