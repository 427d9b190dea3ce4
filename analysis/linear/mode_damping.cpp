#include "analysis/linear/mode_damping.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "analysis/linear/stability.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/rigor/spectral_radius.hpp"

namespace veritrack::linear {

using rigor::Interval;
using rigor::Verdict;

namespace {

/// |z - centre| <= radius.
struct Disc {
  std::complex<double> centre;
  double radius = 0.0;
};

Interval distance(const std::complex<double>& x, const std::complex<double>& y) {
  return sqrt(square(Interval(x.real()) - Interval(y.real())) +
              square(Interval(x.imag()) - Interval(y.imag())));
}

Interval size_at(const std::vector<Interval>& p, const std::complex<double>& z) {
  const Interval x(z.real());
  const Interval y(z.imag());
  Interval real(0.0);
  Interval imaginary(0.0);
  for (std::size_t i = p.size(); i-- > 0;) {
    const Interval next = real * x - imaginary * y + p[i];
    imaginary = real * y + imaginary * x;
    real = next;
  }
  return sqrt(square(real) + square(imaginary));
}

/// Discs about these points that together contain all roots of a monic polynomial, and as many in those that
/// touch each other as there are of these. Empty where it is not certain.
std::optional<std::vector<Disc>> root_discs(const std::vector<Interval>& p,
                                            const std::vector<std::complex<double>>& near) {
  std::vector<Disc> discs;
  for (std::size_t i = 0; i < near.size(); ++i) {
    Interval radius = Interval(static_cast<double>(near.size())) * size_at(p, near[i]);
    for (std::size_t j = 0; j < near.size(); ++j) {
      radius = j == i ? radius : radius / distance(near[i], near[j]);
    }
    if (!rigor::is_finite(radius)) {
      return std::nullopt;
    }
    discs.push_back({near[i], radius.upper()});
  }
  return discs;
}

/// Ends of the box around the disc.
struct Box {
  double left, right;  // of the real part
  double near_, far;   // of the size of the imaginary part
};
Box box_of(const Disc& disc) {
  const double across = std::fabs(disc.centre.imag());
  return {rigor::sub_down(disc.centre.real(), disc.radius), rigor::add_up(disc.centre.real(), disc.radius),
          std::max(0.0, rigor::sub_down(across, disc.radius)), rigor::add_up(across, disc.radius)};
}

/// The largest |argument| in the disc, at most.
Interval largest_angle(const Disc& disc) {
  const Box box = box_of(disc);
  if (box.left > 0.0) {
    return atan(Interval(box.far) / Interval(box.left));
  }
  return box.near_ > 0.0 ? Interval(0.5) * rigor::pi() + atan(Interval(-box.left) / Interval(box.near_))
                         : rigor::pi();
}
/// The smallest one, at least.
Interval smallest_angle(const Disc& disc) {
  const Box box = box_of(disc);
  if (box.right < 0.0) {
    return rigor::pi() - atan(Interval(box.far) / Interval(-box.right));
  }
  return box.near_ > 0.0 && box.right > 0.0 ? atan(Interval(box.near_) / Interval(box.right)) : Interval(0.0);
}

/// For all points of the disc, or for none.
Verdict is_damped(const Disc& disc, const Interval& least) {
  const Interval size = distance(disc.centre, {0.0, 0.0});
  const Interval room = Interval(1.0) - square(least);
  const Interval outer = size + Interval(disc.radius);
  if (rigor::certainly_less(outer, Interval(1.0)) &&
      rigor::certainly_less_equal(square(largest_angle(disc) * least), square(log(outer)) * room)) {
    return Verdict::proved;
  }
  const Interval inner = size - Interval(disc.radius);
  // cannot bind (inner): the square of a logarithm of what may be 0 has no upper bound.
  const bool has_logarithm = rigor::certainly_positive(inner);
  const bool is_less = rigor::certainly_less_equal(Interval(1.0), inner) ||
                       (has_logarithm && rigor::certainly_less(square(log(inner)) * room,
                                                               square(smallest_angle(disc) * least)));
  return is_less ? Verdict::refuted : Verdict::undecided;
}

/// Refuted where this is so of a disc and of all that it touches, one after the other.
Verdict are_damped(const std::vector<Disc>& discs, const Interval& least) {
  std::vector<Verdict> verdicts;
  verdicts.reserve(discs.size());
  for (const Disc& disc : discs) {
    verdicts.push_back(is_damped(disc, least));
  }
  const auto touches = [&](std::size_t i, std::size_t j) {
    const Interval reach = Interval(discs[i].radius) + Interval(discs[j].radius);
    return !rigor::certainly_less(reach, distance(discs[i].centre, discs[j].centre));
  };
  for (std::size_t start = 0; start < discs.size(); ++start) {
    std::vector<std::size_t> group{start};
    for (std::size_t k = 0; k < group.size(); ++k) {
      for (std::size_t j = 0; j < discs.size(); ++j) {
        if (std::find(group.begin(), group.end(), j) == group.end() && touches(group[k], j)) {
          group.push_back(j);
        }
      }
    }
    if (std::all_of(group.begin(), group.end(),
                    [&](std::size_t i) { return verdicts[i] == Verdict::refuted; })) {
      return Verdict::refuted;
    }
  }
  return rigor::conjunction(verdicts);
}

}  // namespace

Verdict has_damping(const std::vector<Row>& a, const Interval& least) {
  std::vector<Interval> p = characteristic_polynomial(a);
  while (p.size() > 1 && p.front() == Interval(0.0)) {
    p.erase(p.begin());  // errors of this mode are gone at once
  }
  if (p.size() == 1) {
    return Verdict::proved;
  }
  const auto n = static_cast<Eigen::Index>(a.size());
  Eigen::MatrixXd middle(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      middle(i, j) = rigor::midpoint(a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    }
  }
  if (!middle.allFinite()) {
    return Verdict::undecided;
  }
  std::vector<std::complex<double>> near = rigor::eigenvalues_by_size(middle);
  near.resize(p.size() - 1);
  // Where some are equal, apart from each other.
  for (const double apart : {0.0, 1e-8, 1e-6, 1e-4}) {
    std::vector<std::complex<double>> points = near;
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] += std::polar(apart, static_cast<double>(i));
    }
    const auto discs = root_discs(p, points);
    const Verdict verdict = discs ? are_damped(*discs, least) : Verdict::undecided;
    if (verdict != Verdict::undecided) {
      return verdict;
    }
  }
  return Verdict::undecided;
}

}  // namespace veritrack::linear
