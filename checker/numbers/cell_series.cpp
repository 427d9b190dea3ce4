#include "checker/numbers/cell_series.hpp"

namespace veritrack::checker {

CellSeries& CellSeries::operator+=(const CellSeries& other) {
  for (std::size_t i = 0; i < c_.size(); ++i) {
    c_[i] += other.c_[i];
  }
  return *this;
}
CellSeries& CellSeries::operator-=(const CellSeries& other) {
  for (std::size_t i = 0; i < c_.size(); ++i) {
    c_[i] -= other.c_[i];
  }
  return *this;
}
CellSeries& CellSeries::operator*=(const Ball& factor) {
  for (Ball& coefficient : c_) {
    arb_mul(coefficient.raw(), coefficient.raw(), factor.raw(), precision());
  }
  return *this;
}

CellSeries CellSeries::varying() const {
  CellSeries rest = *this;
  rest.c_[0] = zero;
  return rest;
}

Ball CellSeries::deviation() const {
  Ball sum(0.0);
  for (std::size_t i = 1; i < c_.size(); ++i) {
    sum += abs(c_[i]);
  }
  return sum;
}

Ball CellSeries::remainder() const {
  Ball sum(0.0);
  for (const Ball& coefficient : c_) {
    sum += coefficient.radius();
  }
  return sum;
}

void CellSeries::drop_remainder() {
  for (Ball& coefficient : c_) {
    arb_get_mid_arb(coefficient.raw(), coefficient.raw());
  }
}

CellSeries operator*(const CellSeries& a, const CellSeries& b) {
  CellSeries product;
  const auto add = [&](std::size_t to, std::size_t i, std::size_t j) {
    arb_addmul(product.c_[to].raw(), a.c_[i].raw(), b.c_[j].raw(), precision());
  };
  for (std::size_t i = 0; i < 6; ++i) {
    add(i, 0, i);
  }
  for (std::size_t i = 1; i < 6; ++i) {
    add(i, i, 0);
  }
  add(3, 1, 1);
  add(4, 1, 2);
  add(4, 2, 1);
  add(5, 2, 2);
  // The remainder: at most |a1| |b2| + |a2| |b1| + |a2| |b2|, with the parts of degree one and two.
  mag_t size;
  mag_t parts[2][2];
  mag_init(size);
  for (std::size_t which = 0; which < 2; ++which) {
    const CellSeries& f = which == 0 ? a : b;
    for (std::size_t degree = 0; degree < 2; ++degree) {
      mag_init(parts[which][degree]);
      for (std::size_t i = degree == 0 ? 1 : 3; i < (degree == 0 ? 3U : 6U); ++i) {
        arb_get_mag(size, f.c_[i].raw());
        mag_add(parts[which][degree], parts[which][degree], size);
      }
    }
  }
  mag_mul(size, parts[0][0], parts[1][1]);
  mag_addmul(size, parts[0][1], parts[1][0]);
  mag_addmul(size, parts[0][1], parts[1][1]);
  arb_add_error_mag(product.c_[0].raw(), size);
  mag_clear(size);
  for (auto& of_one : parts) {
    mag_clear(of_one[0]);
    mag_clear(of_one[1]);
  }
  return product;
}

CellSeries reciprocal(const CellSeries& a) {
  // 1/(c + u) = 1/c - u/c^2 + u^2/c^3 - u^3/(c^3 (c + u)).
  const Ball over = one / a.constant();
  const CellSeries v = over * a.varying();
  const Ball tail = abs(v.deviation() * v.deviation() * v.deviation() / a.range());
  return over * (one - v + v * v) + Ball::within(tail);
}

SineCosine::SineCosine(const CellSeries& argument) {
  // sin(c + u) = sin c + u cos c - u^2/2 sin c +- |u|^3/6, and so the cosine.
  const CellSeries u = argument.varying();
  const CellSeries square = half * (u * u);
  const Ball s = sin(argument.constant());
  const Ball c = cos(argument.constant());
  const Ball deviation = u.deviation();
  const Ball tail = Ball::within(deviation * deviation * deviation / Ball(6.0));
  sine = s * (one - square) + c * u + tail;
  cosine = c * (one - square) - s * u + tail;
}

}  // namespace veritrack::checker
