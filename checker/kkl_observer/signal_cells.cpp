#include "checker/kkl_observer/signal_cells.hpp"

#include <algorithm>

namespace veritrack::checker {

namespace {

Ball dot_over_filters(const std::array<Ball, kFilters>& x, const std::array<Ball, kFilters>& y) {
  Ball sum(0.0);
  for (std::size_t i = 0; i < kFilters; ++i) {
    sum += x[i] * y[i];
  }
  return sum;
}

/// The mean-value form: all values over a cell, from the one at its middle and the derivatives.
Ball centred(const Ball& at_middle, const Slope& over, const std::array<Ball, kVariables>& radius) {
  Ball value = at_middle;
  for (std::size_t v = 0; v < kVariables; ++v) {
    value += Ball::within(over.along[v] * radius[v]);
  }
  return value;
}

}  // namespace

SignalCells::SignalCells(const KklDesign& design, const Ball& settling_time)
    : moves_(design, settling_time),
      amplitude_low_(design.amplitude_low),
      amplitude_high_(design.amplitude_high),
      box_{Range(design.frequency_low.lower(), design.frequency_high.upper()), Range(zero, pi().upper()),
           Range(zero), Range(zero)} {
  std::copy_n(design.lambda.begin(), kFilters, lambda_.begin());
  find_rows();
  for (std::size_t j = 0; j < kRows; ++j) {
    FourFilters of_f2;
    for (std::size_t i = 0; i < kFilters; ++i) {
      of_f2[i] = rows_[j][i] * square(lambda_[i]);
    }
    row_[j] = moves_.size(rows_[j]);
    row_of_f2_[j] = moves_.size(of_f2);
  }
  for (std::size_t j = 0; j < 2; ++j) {
    const Ball reach = row_[kAcross + j].sum().upper();
    box_[2 + j] = Range(-reach, reach);
  }
  Ball sum(0.0);
  for (std::size_t i = 0; i < kFilters; ++i) {
    FourFilters unit{zero, zero, zero, zero};
    unit[i] = one;
    sum += square(moves_.size(unit).sum());
  }
  longest_move_ = sqrt(sum);
}

void SignalCells::find_rows() {
  const auto& [a, b, c, d] = lambda_;
  const Ball sum = a + b + c + d;
  const Ball squares = dot_over_filters(lambda_, lambda_);
  gram_ = zero;  // 4 squares - sum^2, without its cancellation
  for (const Ball& rate : lambda_) {
    for (const Ball& other : lambda_) {
      gram_ += half * square(rate - other);
    }
  }
  for (std::size_t i = 0; i < kFilters; ++i) {
    rows_[kFirst][i] = (four * lambda_[i] - sum) / gram_;
    rows_[kSecond][i] = (squares - sum * lambda_[i]) / gram_;
  }
  // det(xi, lambda, 1) of the first and of the last three filters, then Gram and Schmidt.
  const FourFilters first{b - c, c - a, a - b, zero};
  const FourFilters last{zero, c - d, d - b, b - c};
  const Ball first_norm = sqrt(dot_over_filters(first, first));
  const Ball share = dot_over_filters(first, last) / square(first_norm);
  FourFilters rest;
  for (std::size_t i = 0; i < kFilters; ++i) {
    rest[i] = last[i] - share * first[i];
  }
  const Ball rest_norm = sqrt(dot_over_filters(rest, rest));
  for (std::size_t i = 0; i < kFilters; ++i) {
    rows_[kAcross][i] = first[i] / first_norm;
    rows_[kAcross + 1][i] = rest[i] / rest_norm;
  }
  normal_ = {one / first_norm, -(share / rest_norm), one / rest_norm};
  triples_ = {triple(0), triple(1)};
}

SignalCells::Triple SignalCells::triple(std::size_t first) const {
  const Ball& a = lambda_[first];
  const Ball& b = lambda_[first + 1];
  const Ball& c = lambda_[first + 2];
  return {{first, first + 1, first + 2},
          a + b + c,
          a * b + b * c + c * a,
          a * b * c,
          (a - b) * (b - c) * (a - c)};
}

template <typename S>
KklSignal<S> SignalCells::signal(const std::array<S, kVariables>& x) const {
  KklSignal<S> at;
  at.frequency = x[0];
  at.sine = sin(x[1]);
  at.cosine = cos(x[1]);
  const S s = square(x[0]);
  const S x2 = -(x[0] * at.cosine);
  std::array<S, kFilters> over;
  for (std::size_t i = 0; i < kFilters; ++i) {
    over[i] = reciprocal(S(square(lambda_[i])) + s);
    at.transformed[i] = (lambda_[i] * at.sine + x2) * over[i];
  }
  // det(T, lambda, 1) is a Vandermonde determinant times a second divided difference of (l x1 + x2)/(l^2 +
  // s).
  const auto determinant = [&](const Triple& t) {
    const S numerator = (S(t.e3) - t.e1 * s) * at.sine + (S(t.e2) - s) * x2;
    return t.vandermonde * (numerator * over[t.at[0]] * over[t.at[1]] * over[t.at[2]]);
  };
  const S first = determinant(triples_[0]);
  const S last = determinant(triples_[1]);
  at.y = {normal_[0] * first + x[2], normal_[1] * first + normal_[2] * last + x[3]};
  at.squared_norm = square(at.y[0]) + square(at.y[1]);
  return at;
}

bool SignalCells::always(const Statement& statement) const {
  constexpr int kDepth = 60;
  int cells = 40'000;
  return is_true(statement, box_, kDepth, cells);
}

bool SignalCells::is_true(const Statement& statement, const Box& box, int depth, int& cells) const {
  KklCell cell;
  std::array<Ball, kVariables> middle;
  std::array<Slope, kVariables> over;
  for (std::size_t v = 0; v < kVariables; ++v) {
    const auto& [low, high] = box[v];
    middle[v] = (half * (low + high)).lower();
    over[v] = Slope::variable(Ball::hull(low, high), v);
    cell.radius[v] = max(high - middle[v], middle[v] - low).upper();
  }
  cell.middle = signal(middle);
  cell.over = signal(over);
  if (statement(cell)) {
    return true;
  }
  if (depth == 0 || --cells < 0) {
    return false;
  }
  // Cut where y moves most.
  const auto movement = [&](std::size_t v) {
    return (cell.radius[v] * (abs(cell.over.y[0].along[v]) + abs(cell.over.y[1].along[v]))).upper_double();
  };
  std::size_t widest = 0;
  for (std::size_t v = 1; v < kVariables; ++v) {
    widest = movement(v) > movement(widest) ? v : widest;
  }
  Box lower = box;
  Box upper = box;
  lower[widest].high = middle[widest];
  upper[widest].low = middle[widest];
  return is_true(statement, lower, depth - 1, cells) && is_true(statement, upper, depth - 1, cells);
}

template <typename Function>
Size SignalCells::largest(const KklCell& cell, const Function& weights) const {
  const Weights<Ball> at_middle = weights(cell.middle);
  const Weights<Slope> over = weights(cell.over);
  FourFilters q{zero, zero, zero, zero};
  Size change{zero, zero};
  for (std::size_t j = 0; j < kRows; ++j) {
    // The coefficients of row'F^2 u and of row'u.
    const std::array<Ball, 2> coefficients{centred(at_middle[j], over[j], cell.radius),
                                           centred(at_middle[j] * square(cell.middle.frequency),
                                                   over[j] * square(cell.over.frequency), cell.radius)};
    const std::array<const Size*, 2> sizes{&row_of_f2_[j], &row_[j]};
    std::array<Ball, 2> near;
    for (std::size_t k = 0; k < 2; ++k) {
      near[k] = Ball(coefficients[k].near());
      const Ball away = abs(coefficients[k] - near[k]).upper();
      change.driven += away * sizes[k]->driven;
      change.left += away * sizes[k]->left;
    }
    for (std::size_t i = 0; i < kFilters; ++i) {
      q[i] += (near[0] * square(lambda_[i]) + near[1]) * rows_[j][i];
    }
  }
  const Size size = moves_.size(q);
  return {size.driven + change.driven, size.left + change.left};
}

Ball SignalCells::squared_error(const KklCell& cell) const {
  const auto weights = []<typename S>(const KklSignal<S>& x) -> Weights<S> {
    const S over = reciprocal(x.squared_norm * x.frequency);
    return {S(zero), S(zero), -(x.y[0] * over), -(x.y[1] * over)};
  };
  return largest(cell, weights).sum();
}

bool SignalCells::ratio_at_least(const KklCell& cell, const Ball& bound) const {
  const auto excess = [&]<typename S>(const KklSignal<S>& x) -> S {
    S squares = square(x.transformed[0]);
    for (std::size_t i = 1; i < kFilters; ++i) {
      squares = squares + square(x.transformed[i]);
    }
    return two * gram_ * x.squared_norm - bound * square(sqrt(squares) + S(longest_move_));
  };
  return certainly_not_negative(centred(excess(cell.middle), excess(cell.over), cell.radius));
}

bool SignalCells::relative_square_at_least(const KklCell& cell, const Ball& bound) const {
  return certainly_at_most(bound, one - squared_error(cell) / cell.over.frequency.value.lower());
}

bool SignalCells::frequency_error_at_most(const KklCell& cell, const Ball& bound) const {
  // Largest in size for e < 0: w - sqrt(w^2 - w error), which falls with w.
  const Ball error = squared_error(cell);
  const Ball root = sqrt(one - error / cell.over.frequency.value.lower());
  return certainly_at_most(error / (one + root), bound);
}

bool SignalCells::amplitude_error_at_most(const KklCell& cell, const Ball& bound) const {
  const Ball relative = squared_error(cell) / cell.over.frequency.value.lower();
  // cannot bind (relative): roots of what may be negative are balls of everything.
  if (!certainly_less(relative, one)) {
    return false;
  }
  // w_hat / w, and the factor of e in the errors of x1 and x2: the sum of row_i (T + u)_i.
  const Ball speed = sqrt(one + Ball::within(relative));
  const auto pulled = [&]<typename S>(const KklSignal<S>& x, Row row) -> S {
    S sum(Ball::within(row_[row].sum()));
    for (std::size_t i = 0; i < kFilters; ++i) {
      sum = sum + rows_[row][i] * x.transformed[i];
    }
    return sum;
  };
  /// first row_1'(F^2 + w^2) u + second row_2'(F^2 + w^2) u + third e.
  const auto with_error = []<typename S>(const KklSignal<S>& x, const S& first, const S& second,
                                         const S& third) -> Weights<S> {
    const S over = third * reciprocal(x.squared_norm);
    return {first, second, -(x.y[0] * over), -(x.y[1] * over)};
  };
  // k1 = x1_hat / A - sin p, and m = k2 / w + cos p e / (w (w_hat + w)), with k2 = x2_hat / A + w cos p.
  const auto k1 = [&]<typename S>(const KklSignal<S>& x) -> Weights<S> {
    return with_error(x, S(one), S(zero), pulled(x, kFirst));
  };
  const auto m = [&]<typename S>(const KklSignal<S>& x) -> Weights<S> {
    const S over = reciprocal(x.frequency);
    return with_error(x, S(zero), over, (pulled(x, kSecond) + x.cosine * over / (one + speed)) * over);
  };
  const Size k1_size = largest(cell, k1);
  const Size m_size = largest(cell, m);
  // With d = x2_hat / (A w_hat) + cos p = m w / w_hat, (A_hat / A)^2 - 1 = k1 (2 sin p + k1) + d (d - 2 cos
  // p): 2 sin p k1 - 2 cos p m, a linear function of u, and products of errors.
  Size squared = largest(cell, [&]<typename S>(const KklSignal<S>& x) -> Weights<S> {
    const Weights<S> of_k1 = k1(x);
    const Weights<S> of_m = m(x);
    Weights<S> sum;
    for (std::size_t j = 0; j < kRows; ++j) {
      sum[j] = two * (x.sine * of_k1[j] - x.cosine * of_m[j]);
    }
    return sum;
  });
  const Ball slow = one / speed;
  const Ball times_m =
      (m_size.sum() * square(slow) + two * abs(cell.over.cosine.value) * abs(slow - one)).upper();
  squared.driven += k1_size.sum() * k1_size.driven + times_m * m_size.driven;
  squared.left += k1_size.sum() * k1_size.left + times_m * m_size.left;
  // sqrt(1 + t) - 1 is largest in size at the lowest t. The disturbance has less effect at a higher
  // amplitude.
  const Ball error =
      (amplitude_low_ * squared.driven + amplitude_high_ * squared.left) / (one + sqrt(one - squared.sum()));
  return certainly_at_most(error, bound);
}

}  // namespace veritrack::checker
