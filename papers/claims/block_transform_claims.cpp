#include "papers/claims/block_transform_claims.hpp"

#include <Eigen/Core>
#include <array>
#include <string>

#include "analysis/rigor/dual.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/matrix.hpp"
#include "analysis/statements/comparison.hpp"

namespace veritrack::theorems {

namespace {

using rigor::Interval;

Interval whole(int number) {
  return Interval(static_cast<double>(number));
}

/// A complex number.
struct Complex {
  Interval real, imaginary;
};

Complex operator*(const Complex& a, const Complex& b) {
  return {a.real * b.real - a.imaginary * b.imaginary, a.real * b.imaginary + a.imaginary * b.real};
}

Complex operator+(const Complex& a, const Complex& b) {
  return {a.real + b.real, a.imaginary + b.imaginary};
}

Complex scaled(const Complex& a, const Interval& factor) {
  return {a.real * factor, a.imaginary * factor};
}

/// e^{j angle}.
Complex phasor(const Interval& angle) {
  const auto [sine, cosine] = rigor::sin_cos(angle);
  return {cosine, sine};
}

Interval distance(const Complex& a, const Complex& b) {
  return sqrt(square(a.real - b.real) + square(a.imaginary - b.imaginary));
}

/// The tone of the witness: amplitude 1, its place M + delta in bins, its phase at the start of the block.
constexpr int kBlock = 64;
constexpr int kBin = 16;
constexpr int kHalfWidth = 2;
constexpr int kBins = 2 * kHalfWidth + 1;

struct Tone {
  Interval offset{0.25};
  Interval phase{0.5};
};

/// d = M - m + delta.
Interval bins_off(const Tone& tone, int bin) {
  return whole(kBin - bin) + tone.offset;
}

Interval turn() {
  return Interval(2.0) * rigor::pi();
}

/// Bin m of (4.4), summed.
Complex transform(const Tone& tone, int bin) {
  Complex sum{Interval(0.0), Interval(0.0)};
  for (int t = 0; t < kBlock; ++t) {
    const Interval time = whole(t) / whole(kBlock);
    const Interval sample = cos(turn() * (whole(kBin) + tone.offset) * time + tone.phase);
    sum = sum + scaled(phasor(-turn() * whole(bin) * time), sample);
  }
  return scaled(sum, Interval(1.0) / whole(kBlock));
}

/// (rho/2T) e^{j (sign) (phi + pi (T-1)/T places)} sin(pi places)/sin(pi places/T): a term of (4.5).
Complex kernel(const Interval& phase, const Interval& places, double sign) {
  const Interval angle = phase + rigor::pi() * places * (whole(kBlock - 1) / whole(kBlock));
  const Interval ratio = sin(rigor::pi() * places) / sin(rigor::pi() * places / whole(kBlock));
  return scaled(phasor(Interval(sign) * angle), ratio / whole(2 * kBlock));
}

/// (4.9) with `sign` = 1, (4.6) with -1: rho/(4 pi) e^{j phi} (e^{+-j 2 pi delta} - 1)/(j d).
Complex model(const Tone& tone, int bin, double sign) {
  const Complex turned = phasor(Interval(sign) * turn() * tone.offset);
  const Complex over_j{turned.imaginary, Interval(1.0) - turned.real};  // (turned - 1)/j
  return scaled(phasor(tone.phase) * over_j, Interval(0.5) / (turn() * bins_off(tone, bin)));
}

/// The largest distance over the bins between the transform and a formula for it.
template <typename Formula>
Interval largest_distance(const Tone& tone, Formula&& formula) {
  Interval largest(0.0);
  for (int bin = kBin - kHalfWidth; bin <= kBin + kHalfWidth; ++bin) {
    largest = rigor::max(largest, distance(transform(tone, bin), formula(bin)));
  }
  return largest;
}

const std::string kTone =
    "For a tone of amplitude 1, phase 0.5 rad and offset 1/4 in a block of T = 64 samples, M = 16, bins 14 "
    "to "
    "18, ";

Statement agreement(const std::string& id, const std::string& claim, const Interval& off,
                    const Interval& allowed) {
  return make_statement(id, kTone + claim, decide(off, allowed, Strictness::weak),
                        "The formula is off by " + enclosed(off) + " at most.", {});
}

std::vector<Statement> transform_statements() {
  const Tone tone;
  const auto terms = [&](int bin, double sign) {
    return kernel(tone.phase, bins_off(tone, bin), 1.0) +
           kernel(tone.phase, whole(kBin + bin) + tone.offset, sign);
  };
  const Interval nine_digits(1e-9);
  const Interval approximate = Interval(2.0) / whole(kBlock);
  return {
      agreement("chapter-4/transform/printed", "(4.5), as printed, is the transform (4.4), to nine digits.",
                largest_distance(tone, [&](int bin) { return terms(bin, 1.0); }), nine_digits),
      agreement("chapter-4/transform/corrected",
                "(4.5) with the conjugate phase in its second term is the transform (4.4), to nine digits.",
                largest_distance(tone, [&](int bin) { return terms(bin, -1.0); }), nine_digits),
      agreement("chapter-4/narrow-band/4.6", "(4.6) is the transform (4.4), to within 2/T.",
                largest_distance(tone, [&](int bin) { return model(tone, bin, -1.0); }), approximate),
      agreement("chapter-4/narrow-band/4.9", "(4.9) is the transform (4.4), to within 2/T.",
                largest_distance(tone, [&](int bin) { return model(tone, bin, 1.0); }), approximate)};
}

using Derivative = rigor::Dual<Interval, 3>;

/// (4.16) for row < 2L + 1, (4.17) beyond, as printed.
Derivative output(const std::array<Derivative, 3>& x, int row) {
  const Derivative d = Derivative(static_cast<double>(kHalfWidth - row % kBins)) + x[2];
  const Derivative late = x[1] + Derivative(turn()) * x[2];
  const Derivative difference = row < kBins ? sin(late) - sin(x[1]) : cos(x[1]) - cos(late);
  return x[0] * x[0] / d * difference;
}

using Jacobian = Eigen::Matrix<Interval, 2 * kBins, 3>;

/// (4.19)-(4.24), as printed.
Jacobian printed_jacobian(const std::array<Interval, 3>& x) {
  Jacobian result;
  const Interval late = x[1] + turn() * x[2];
  const Interval square_1 = square(x[0]);
  for (int row = 0; row < kBins; ++row) {
    const Interval d = whole(kHalfWidth - row) + x[2];
    const Interval sines = sin(late) - sin(x[1]);
    const Interval cosines = cos(late) - cos(x[1]);
    result(row, 0) = Interval(2.0) * x[0] / d * sines;
    result(row, 1) = square_1 / d * cosines;
    result(row, 2) = turn() * square_1 / d * cos(late) - square_1 / square(d) * sines;
    result(row + kBins, 0) = -Interval(2.0) * x[0] / d * cosines;
    result(row + kBins, 1) = square_1 / d * sines;
    result(row + kBins, 2) = turn() * square_1 / d * sin(late) + square_1 / square(d) * cosines;
  }
  return result;
}

const std::array<Interval, 3> kState{Interval(0.75), Interval(0.5), Interval(0.25)};

Statement jacobian_statement() {
  std::array<Derivative, 3> x;
  for (int i = 0; i < 3; ++i) {
    std::array<Interval, 3> direction{Interval(0.0), Interval(0.0), Interval(0.0)};
    direction.at(static_cast<std::size_t>(i)) = Interval(1.0);
    x.at(static_cast<std::size_t>(i)) = {kState.at(static_cast<std::size_t>(i)), direction};
  }
  const Jacobian printed = printed_jacobian(kState);
  Interval off(0.0);
  for (int row = 0; row < printed.rows(); ++row) {
    const Derivative value = output(x, row);
    for (int column = 0; column < 3; ++column) {
      off = rigor::max(off, abs(printed(row, column) - value.derivative(column)));
    }
  }
  return make_statement("chapter-4/jacobian",
                        "At x = (0.75, 0.5, 0.25), L = 2, (4.19) to (4.24) are the derivatives of (4.16) and "
                        "(4.17), to nine digits.",
                        decide(off, Interval(1e-9), Strictness::weak),
                        "The entries differ by " + enclosed(off) + " at most.", {});
}

/// Row m of the third column at the offset 1, where the factor of the first two columns vanishes.
Statement integer_offset_statement() {
  constexpr int kRow = 2;  // the bin M, which is one off
  const Interval entry = printed_jacobian({kState[0], kState[1], Interval(1.0)})(kRow, 2);
  return make_statement(
      "chapter-4/integer-offset",
      "At an integer offset all entries of H are zero but for two elements of two rows (section 4.3).",
      decide(abs(entry), Interval(1e-9), Strictness::weak),
      "At x = (0.75, 0.5, 1), L = 2, the entry H(3, 3), of a bin one off, is " + enclosed(entry) + ".", {});
}

/// det(H'H) with the bins M - width ... M + width of the witness: the information of one block.
Interval information(int width) {
  const Jacobian jacobian = printed_jacobian(kState);
  rigor::IntervalMatrix<3> sum = rigor::IntervalMatrix<3>::Constant(Interval(0.0));
  for (int row = kHalfWidth - width; row <= kHalfWidth + width; ++row) {
    for (const int part : {row, row + kBins}) {
      sum += jacobian.row(part).transpose() * jacobian.row(part);
    }
  }
  return sum(0, 0) * (sum(1, 1) * sum(2, 2) - sum(1, 2) * sum(2, 1)) -
         sum(0, 1) * (sum(1, 0) * sum(2, 2) - sum(1, 2) * sum(2, 0)) +
         sum(0, 2) * (sum(1, 0) * sum(2, 1) - sum(1, 1) * sum(2, 0));
}

Statement width_statement() {
  const Interval narrow = information(1);
  const Interval wide = information(2);
  return make_statement("chapter-4/larger-L",
                        "A larger L than necessary decreases the effective signal-to-noise ratio (section "
                        "4.4.3): what a block says "
                        "of the state, det(H'H), does not grow with L.",
                        decide(wide, narrow, Strictness::weak),
                        "At x = (0.75, 0.5, 0.25) det(H'H) is " + enclosed(narrow) + " for L = 1 and " +
                            enclosed(wide) +
                            " for L = 2: each further bin adds a positive semidefinite matrix to H'H.",
                        {});
}

}  // namespace

std::vector<Statement> block_transform_claims() {
  std::vector<Statement> statements = transform_statements();
  statements.push_back(jacobian_statement());
  statements.push_back(integer_offset_statement());
  statements.push_back(width_statement());
  return statements;
}

}  // namespace veritrack::theorems
