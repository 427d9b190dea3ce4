#include "checker/kkl_observer/projected_cells.hpp"

namespace veritrack::checker {

namespace {

/// The mean-value form: all values over a cell, from the one at its middle and the derivatives.
Ball centred(const Ball& at_middle, const ProjectedCell::Slope& over, const std::array<Ball, 2>& radius) {
  return at_middle + Ball::within(over.along[0] * radius[0]) + Ball::within(over.along[1] * radius[1]);
}

Size larger_of(const Size& x, const Size& y) {
  return {max(x.driven, y.driven), max(x.left, y.left)};
}
Size operator+(const Size& x, const Size& y) {
  return {x.driven + y.driven, x.left + y.left};
}
Size operator*(const Ball& factor, const Size& x) {
  return {factor * x.driven, factor * x.left};
}

}  // namespace

ProjectedCells::ProjectedCells(const KklDesign& design, const Ball& settling_time)
    : lambda_(design.lambda),
      moves_(design, settling_time),
      amplitude_low_(design.amplitude_low),
      amplitude_high_(design.amplitude_high),
      gram_(0.0),
      box_{Range(design.frequency_low.lower(), design.frequency_high.upper()), Range(zero, pi().upper())} {
  const std::size_t filters = lambda_.size();
  const Ball count(static_cast<double>(filters));
  Ball sum(0.0);
  Ball squares(0.0);
  for (std::size_t i = 0; i < filters; ++i) {
    sum += lambda_[i];
    squares += square(lambda_[i]);
    for (std::size_t j = i + 1; j < filters; ++j) {
      gram_ += square(lambda_[i] - lambda_[j]);
      for (std::size_t k = j + 1; k < filters; ++k) {
        triples_.push_back(
            {{i, j, k}, (lambda_[i] - lambda_[j]) * (lambda_[j] - lambda_[k]) * (lambda_[i] - lambda_[k])});
      }
    }
  }
  rows_.assign(kAcross + filters, Filters(filters));
  for (std::size_t i = 0; i < filters; ++i) {
    rows_[kFirst][i] = (count * lambda_[i] - sum) / gram_;
    rows_[kSecond][i] = (squares - sum * lambda_[i]) / gram_;
  }
  for (std::size_t i = 0; i < filters; ++i) {
    for (std::size_t k = 0; k < filters; ++k) {
      const Ball unit = i == k ? one : zero;
      rows_[kAcross + i][k] = unit - lambda_[i] * rows_[kFirst][k] - rows_[kSecond][k];
    }
  }
  for (const Filters& row : rows_) {
    Filters of_f2(filters);
    for (std::size_t i = 0; i < filters; ++i) {
      of_f2[i] = row[i] * square(lambda_[i]);
    }
    row_.push_back(moves_.size(row));
    row_of_f2_.push_back(moves_.size(of_f2));
  }
  for (std::size_t i = 0; i < filters; ++i) {
    Filters unit(filters, zero);
    unit[i] = one;
    longest_.push_back(moves_.size(unit).sum().upper());
  }
}

template <typename S>
ProjectedSignal<S> ProjectedCells::signal(const S& frequency, const S& phase) const {
  const std::size_t filters = lambda_.size();
  ProjectedSignal<S> at;
  at.frequency = frequency;
  at.sine = sin(phase);
  at.cosine = cos(phase);
  std::vector<S> over;   // 1 / w_i
  std::vector<S> angle;  // p_i
  for (const Ball& rate : lambda_) {
    over.push_back(reciprocal(sqrt(S(square(rate)) + square(frequency))));
    angle.push_back(arctangent(reciprocal(rate) * frequency));
    at.transformed.push_back(sin(phase - angle.back()) * over.back());
  }
  // Over the squared determinants: NN' is the sum of d d' / gram, d the coefficients of each of them.
  at.across.assign(filters, S(zero));
  at.squared_norm = S(zero);
  for (const auto& [which, vandermonde] : triples_) {
    const auto& [i, j, k] = which;
    const S determinant =
        vandermonde * (sin(phase - angle[i] - angle[j] - angle[k]) * over[i] * over[j] * over[k]);
    const S share = reciprocal(gram_) * determinant;
    at.across[i] = at.across[i] + (lambda_[j] - lambda_[k]) * share;
    at.across[j] = at.across[j] + (lambda_[k] - lambda_[i]) * share;
    at.across[k] = at.across[k] + (lambda_[i] - lambda_[j]) * share;
    at.squared_norm = at.squared_norm + share * determinant;
  }
  for (const S& entry : at.across) {
    at.direction.push_back(entry * reciprocal(at.squared_norm));
  }
  return at;
}

bool ProjectedCells::always(const Statement& statement) const {
  constexpr int kDepth = 60;
  int cells = 40'000;
  return is_true(statement, box_, kDepth, cells);
}

bool ProjectedCells::is_true(const Statement& statement, const Box& box, int depth, int& cells) const {
  std::array<Ball, 2> middle;
  std::array<Slope, 2> over;
  ProjectedCell cell;
  for (std::size_t v = 0; v < 2; ++v) {
    const auto& [low, high] = box[v];
    middle[v] = (half * (low + high)).lower();
    over[v] = Slope::variable(Ball::hull(low, high), v);
    cell.radius[v] = max(high - middle[v], middle[v] - low).upper();
  }
  cell.middle = signal(middle[0], middle[1]);
  cell.over = signal(over[0], over[1]);
  if (statement(cell)) {
    return true;
  }
  if (depth == 0 || --cells < 0) {
    return false;
  }
  // Cut where v moves most.
  const auto movement = [&](std::size_t v) {
    Ball sum(0.0);
    for (const Slope& entry : cell.over.across) {
      sum += abs(entry.along[v]);
    }
    return (cell.radius[v] * sum).upper_double();
  };
  const std::size_t widest = movement(1) > movement(0) ? 1 : 0;
  Box lower = box;
  Box upper = box;
  lower[widest].high = middle[widest];
  upper[widest].low = middle[widest];
  return is_true(statement, lower, depth - 1, cells) && is_true(statement, upper, depth - 1, cells);
}

/// The size of the sum over all rows of (first F^2 + second) row'u, for the two coefficients of each.
Size ProjectedCells::sum_of(const std::vector<std::array<Ball, 2>>& coefficients) const {
  Filters q(lambda_.size(), zero);
  Size change{zero, zero};
  for (std::size_t j = 0; j < coefficients.size(); ++j) {
    const std::array<const Size*, 2> sizes{&row_of_f2_[j], &row_[j]};
    std::array<Ball, 2> near;
    for (std::size_t k = 0; k < 2; ++k) {
      near[k] = Ball(coefficients[j][k].near());
      change = change + abs(coefficients[j][k] - near[k]).upper() * *sizes[k];
    }
    for (std::size_t i = 0; i < q.size(); ++i) {
      q[i] += (near[0] * square(lambda_[i]) + near[1]) * rows_[j][i];
    }
  }
  const Size size = moves_.size(q) + change;
  return {size.driven.upper(), size.left.upper()};
}

template <typename Function>
Size ProjectedCells::largest(const ProjectedCell& cell, const Function& weights, const Ball& shift) const {
  const Weights<Ball> at_middle = weights(cell.middle);
  const Weights<Slope> over = weights(cell.over);
  std::vector<std::array<Ball, 2>> coefficients;
  for (std::size_t j = 0; j < at_middle.size(); ++j) {
    coefficients.push_back({centred(at_middle[j], over[j], cell.radius),
                            centred(at_middle[j] * (square(cell.middle.frequency) + shift),
                                    over[j] * (square(cell.over.frequency) + Slope(shift)), cell.radius)});
  }
  return sum_of(coefficients);
}

template <typename Function>
Size ProjectedCells::of_moves(const ProjectedCell& cell, const Function& weights) const {
  const Weights<Ball> at_middle = weights(cell.middle);
  const Weights<Slope> over = weights(cell.over);
  std::vector<std::array<Ball, 2>> coefficients;
  for (std::size_t j = 0; j < at_middle.size(); ++j) {
    coefficients.push_back({zero, centred(at_middle[j], over[j], cell.radius)});
  }
  return sum_of(coefficients);
}

namespace {

/// first row_1 + second row_2 + third q'NN'.
template <typename S>
std::vector<S> along(const ProjectedSignal<S>& at, const S& first, const S& second, const S& third) {
  std::vector<S> weights{first, second};
  for (const S& entry : at.direction) {
    weights.push_back(third * entry);
  }
  return weights;
}

/// q.
constexpr auto kDirection = []<typename S>(const ProjectedSignal<S>& at) {
  return along(at, S(zero), S(zero), S(one));
};

}  // namespace

Size ProjectedCells::first_order(const ProjectedCell& cell, const Ball& error) const {
  // A convex function of e.
  return larger_of(largest(cell, kDirection, -error), largest(cell, kDirection, error));
}

ProjectedCells::Across ProjectedCells::across(const ProjectedCell& cell) const {
  Across result;
  for (std::size_t i = 0; i < lambda_.size(); ++i) {
    const auto row = [i]<typename S>(const ProjectedSignal<S>& at) {
      std::vector<S> weights = along(at, S(zero), S(zero), -at.across[i]);
      weights[kAcross + i] = weights[kAcross + i] + S(one);
      return weights;
    };
    result.move.push_back(of_moves(cell, row));
    result.pull.push_back(largest(cell, row, zero).sum());
  }
  const Ball norm = centred(cell.middle.squared_norm, cell.over.squared_norm, cell.radius);
  // Roots of what may be negative are balls of everything.
  result.along = square(sqrt(one - of_moves(cell, kDirection).sum()));
  result.over = one / (result.along * norm);
  return result;
}

Size ProjectedCells::Across::second_order(const Ball& error) const {
  Size squares{zero, zero};
  Ball pulled(0.0);
  for (std::size_t i = 0; i < move.size(); ++i) {
    squares = squares + Size{square(move[i].driven), square(move[i].left)};
    pulled += square(pull[i] + error * move[i].sum());
  }
  return sqrt(pulled) * over * Size{sqrt(squares.driven), sqrt(squares.left)};
}

Size ProjectedCells::Across::outright(const Size& first) const {
  return (one / along) * (first + second_order(zero));
}

// With u replaced by r u for r from 0 to 1, e goes from 0 to its value continuously; were it first at +-error
// for some r < 1, the right-hand side there would be at most r times what it is checked to be for r = 1.
bool ProjectedCells::error_at_most(const ProjectedCell& cell, const Ball& error) const {
  // cannot bind (first): it only saves work; the requirement on the sums is stronger.
  const Ball first = first_order(cell, error).sum();
  if (!certainly_at_most(first, error)) {
    return false;
  }
  const Across rest = across(cell);
  return certainly_at_most(first + rest.second_order(error).sum(), error) ||
         certainly_at_most(rest.outright(largest(cell, kDirection, zero)).sum(), error);
}

bool ProjectedCells::ratio_at_least(const ProjectedCell& cell, const Ball& bound) const {
  const Ball share = of_moves(cell, kDirection).sum();
  Ball squares(0.0);
  for (std::size_t i = 0; i < lambda_.size(); ++i) {
    squares +=
        square(abs(centred(cell.middle.transformed[i], cell.over.transformed[i], cell.radius)) + longest_[i]);
  }
  const Ball norm = centred(cell.middle.squared_norm, cell.over.squared_norm, cell.radius);
  const Ball least = two * gram_ * norm * square(square(sqrt(one - share)));
  return certainly_at_most(bound * squares, least);
}

bool ProjectedCells::relative_square_at_least(const ProjectedCell& cell, const Ball& bound) const {
  return error_at_most(cell, (square(cell.over.frequency.value) * (one - bound)).lower());
}

bool ProjectedCells::frequency_error_at_most(const ProjectedCell& cell, const Ball& bound) const {
  // w_hat >= w - bound where e >= -error, and then w_hat <= w + bound for e <= error.
  return error_at_most(cell, (bound * (two * cell.over.frequency.value - bound)).lower());
}

// (A_hat / A)^2 - 1 = k1 (2 sin p + k1) + d (d - 2 cos p), with k1 the error of x1 and d = x2_hat / w_hat +
// cos p = (k2 + cos p e / (w_hat + w)) / w_hat, k2 the error of x2. Given e, k1 = row_1'(F^2 + w^2 + e) u + e
// row_1'T and k2 likewise; the squares only add.
bool ProjectedCells::amplitude_error_at_most(const ProjectedCell& cell, const Ball& bound,
                                             const Ball& frequency_error) const {
  constexpr int kTimesBetter = 2;
  constexpr int kPieces = 4;
  const Across rest = across(cell);
  Ball error = min(frequency_error * (two * cell.over.frequency.value + frequency_error),
                   rest.outright(largest(cell, kDirection, zero)).sum())
                   .upper();
  for (int i = 0; i < kTimesBetter; ++i) {
    error = min(error, (first_order(cell, error) + rest.second_order(error)).sum()).upper();
  }
  const Size second = rest.second_order(error);
  const auto pulled = [&]<typename S>(const ProjectedSignal<S>& at, Row row) {
    S sum(zero);
    for (std::size_t i = 0; i < lambda_.size(); ++i) {
      sum = sum + rows_[row][i] * at.transformed[i];
    }
    return sum;
  };
  // w_hat for the e of a piece.
  const auto estimate = []<typename S>(const ProjectedSignal<S>& at, const Ball& piece) {
    return sqrt(square(at.frequency) + S(piece));
  };
  // The contributions of e to d and to the linear part.
  const auto of_e = [&]<typename S>(const ProjectedSignal<S>& at, const Ball& piece) {
    const S found = estimate(at, piece);
    return (pulled(at, kSecond) + at.cosine * reciprocal(found + at.frequency)) * reciprocal(found);
  };
  // first row_1 + second row_2 + third q over a piece of e: convex in the e of F^2 + w^2 + e.
  const auto over_piece = [&](const auto& first, const auto& row_2, const auto& third, const Ball& low,
                              const Ball& high) {
    const Ball piece = Ball::hull(low, high);
    const auto weights = [&]<typename S>(const ProjectedSignal<S>& at) {
      return along(at, S(first(at)), S(row_2(at, piece)), S(third(at, piece)));
    };
    const Ball of_second =
        abs(centred(third(cell.middle, piece), third(cell.over, piece), cell.radius)).upper();
    return larger_of(largest(cell, weights, low), largest(cell, weights, high)) + of_second * second;
  };
  const Size k1 = over_piece(
      []<typename S>(const ProjectedSignal<S>& /*at*/) { return S(one); },
      []<typename S>(const ProjectedSignal<S>& /*at*/, const Ball& /*e*/) { return S(zero); },
      [&]<typename S>(const ProjectedSignal<S>& at, const Ball& /*e*/) { return -pulled(at, kFirst); },
      -error, error);
  const Size d = over_piece(
      []<typename S>(const ProjectedSignal<S>& /*at*/) { return S(zero); },
      [&]<typename S>(const ProjectedSignal<S>& at, const Ball& e) { return reciprocal(estimate(at, e)); },
      [&]<typename S>(const ProjectedSignal<S>& at, const Ball& e) { return -of_e(at, e); }, -error, error);
  Size linear{zero, zero};
  for (int k = 0; k < kPieces; ++k) {
    const auto end = [&](int index) { return (Ball(2.0 * index / kPieces) - one) * error; };
    linear =
        larger_of(linear, over_piece([]<typename S>(const ProjectedSignal<S>& at) { return two * at.sine; },
                                     [&]<typename S>(const ProjectedSignal<S>& at, const Ball& e) {
                                       return -(two * (at.cosine * reciprocal(estimate(at, e))));
                                     },
                                     [&]<typename S>(const ProjectedSignal<S>& at, const Ball& e) {
                                       return two * (at.cosine * of_e(at, e) - at.sine * pulled(at, kFirst));
                                     },
                                     end(k), end(k + 1)));
  }
  const Size raised = linear + k1.sum() * k1 + d.sum() * d;
  // The disturbance has less effect at a higher amplitude. sqrt(1 + t) - 1 is at most t / 2, and largest in
  // size below at the lowest t.
  const auto of_amplitude = [&](const Size& x) {
    return amplitude_low_ * x.driven + amplitude_high_ * x.left;
  };
  const Ball below = of_amplitude(linear) / (one + sqrt(one - linear.sum()));
  return certainly_at_most(max(below, half * of_amplitude(raised)), bound);
}

}  // namespace veritrack::checker
