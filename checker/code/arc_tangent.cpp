#include "checker/code/arc_tangent.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "checker/code/listing_rounding.hpp"
#include "checker/numbers/budget.hpp"

namespace veritrack::checker {

namespace {

/// The larger sample has a size of 2^-40 to 2^40, its scale.
Ball scale_to(int degree) {
  return Ball(std::ldexp(1.0, 40 * std::abs(degree)));
}

/// A number that grows with a power of the scale: that power times `share`. Of a sample the sign is known
/// even where it may be arbitrarily small.
struct Share {
  int degree = 0;
  Ball share = Ball::everything();
  std::optional<int> sign = std::nullopt;  ///< -1, 0 or 1
  bool is_constant = false;                ///< the same at all scales; its degree is 0
};

std::optional<int> sign_of(const Ball& x) {
  return certainly_positive(x)      ? std::optional(1)
         : certainly_positive(-x)   ? std::optional(-1)
         : certainly_equal(x, zero) ? std::optional(0)
                                    : std::nullopt;
}

Share share_of(int degree, const Ball& share) {
  return {degree, share, sign_of(share), false};
}

/// A point on the rim of the square about 0.
struct RimPoint {
  Share first, second;
  Ball angle;
};

/// The rim, in eight halves of sides and the middles of the sides: `along` is a sample's size beside 1.
RimPoint rim_point(int side, int sign, const Ball& along) {
  const Share small{1, Ball(sign) * along, sign, false};
  const Share large{1, Ball(side < 2 ? 1.0 : -1.0), side < 2 ? 1 : -1, false};
  const Ball turn = Ball(sign) * arctangent(along);
  const Ball quarter = half * pi();
  switch (side) {
    case 0:  // to the right
      return {large, small, turn};
    case 1:  // above
      return {small, large, quarter - turn};
    case 2:  // to the left
      return {large, small, pi() - turn};
    default:  // below
      return {small, large, turn - quarter};
  }
}

class RimValues {
 public:
  RimValues(const CodeListing& listing, const RimPoint& point) : listing_(&listing) {
    known_.emplace(listing.samples[0], point.first);
    known_.emplace(listing.samples[1], point.second);
  }

  const Share& at(int place) {
    spend();
    if (const auto found = known_.find(place); found != known_.end()) {
      return found->second;
    }
    Share share = computed(listing_->at(place));
    if (!share.share.finite()) {
      share = {};
    }
    return known_.emplace(place, std::move(share)).first->second;
  }

 private:
  static Share unknown() { return {}; }

  /// A constant beside numbers of another degree: at the scale where it is largest.
  static Share beside(const Share& constant, int degree) {
    return {degree, Ball::within(abs(constant.share).upper() * scale_to(degree)), constant.sign, false};
  }

  static bool make_alike(Share& x, Share& y) {
    if (x.degree != y.degree && x.is_constant) {
      x = beside(x, y.degree);
    } else if (x.degree != y.degree && y.is_constant) {
      y = beside(y, x.degree);
    }
    return x.degree == y.degree;
  }

  static Share stored(ListedFormat format, int degree, const Ball& exact, const Ball& units = one) {
    const Ball most = abs(exact).upper();
    const Ball limit(format.bits == 32 ? 0x1p127 : 0x1p1023);
    const Ball flushed(format.bits == 32 ? 0x1p-126 : 0x1p-1022);
    if (!certainly_less(most * scale_to(degree), limit)) {
      return unknown();
    }
    const Ball off = units * Ball(half_unit(format)) * most + flushed * scale_to(degree);
    return share_of(degree, exact + Ball::within(off.upper()));
  }

  Share computed(const ListedOperation& now) {
    if (now.is_number() && std::isfinite(now.number)) {
      return {0, Ball(now.number), sign_of(Ball(now.number)), true};
    }
    if (!now.format.is_float || now.operands.empty()) {
      return unknown();
    }
    if (now.is("select")) {
      return selected(now);
    }
    const Share x = at(now.operands[0]);
    if (!x.share.finite()) {
      return unknown();
    }
    return now.operands.size() == 1 ? of_one(now, x) : of_two(now, x, at(now.operands[1]));
  }

  static Share of_one(const ListedOperation& now, const Share& x) {
    if (now.is("fpext")) {
      return x;
    }
    if (now.is("fptrunc")) {
      return stored(now.format, x.degree, x.share);
    }
    if (now.is("fneg")) {
      return {x.degree, -x.share, x.sign ? std::optional(-*x.sign) : std::nullopt, x.is_constant};
    }
    if (now.is("fabs")) {
      return {x.degree, abs(x.share), x.sign ? std::optional(std::abs(*x.sign)) : std::nullopt,
              x.is_constant};
    }
    if (now.is("atan") && x.degree == 0) {
      return stored(now.format, 0, arctangent(x.share), Ball(4.0));
    }
    if (now.is("sqrt") && x.degree % 2 == 0 && certainly_positive(x.share)) {
      return stored(now.format, x.degree / 2, sqrt(x.share));
    }
    return unknown();
  }

  static Share of_two(const ListedOperation& now, Share x, Share y) {
    if (!y.share.finite() || now.operands.size() != 2) {
      return unknown();
    }
    if (now.is("fmul")) {
      const bool is_square = now.operands[0] == now.operands[1];
      return stored(now.format, x.degree + y.degree, is_square ? square(x.share) : x.share * y.share);
    }
    if (now.is("fdiv") && sign_of(y.share) && *sign_of(y.share) != 0) {
      return stored(now.format, x.degree - y.degree, x.share / y.share);
    }
    if (now.is("copysign") && y.sign && *y.sign != 0) {
      return share_of(x.degree, Ball(*y.sign) * abs(x.share));
    }
    if (!make_alike(x, y)) {
      return unknown();
    }
    if (now.is("fadd") || now.is("fsub")) {
      return stored(now.format, x.degree, now.is("fadd") ? x.share + y.share : x.share - y.share);
    }
    if (now.is("fmin") || now.is("fmax")) {
      return share_of(x.degree, now.is("fmin") ? min(x.share, y.share) : max(x.share, y.share));
    }
    return unknown();
  }

  Share selected(const ListedOperation& now) {
    const std::optional<bool> holds = truth(now.operands[0]);
    if (holds) {
      return at(now.operands[*holds ? 1 : 2]);
    }
    Share yes = at(now.operands[1]);
    Share no = at(now.operands[2]);
    if (!make_alike(yes, no) || !yes.share.finite() || !no.share.finite()) {
      return unknown();
    }
    return share_of(yes.degree,
                    Ball::hull(min(yes.share, no.share).lower(), max(yes.share, no.share).upper()));
  }

  /// What a condition certainly is.
  std::optional<bool> truth(int place) {
    const ListedOperation& now = listing_->at(place);
    if (now.is_bit()) {
      return now.integer != 0;
    }
    if (now.is("and") || now.is("or")) {
      const bool decides = now.is("or");
      const std::optional<bool> first = truth(now.operands[0]);
      const std::optional<bool> second = truth(now.operands[1]);
      if (first == decides || second == decides) {
        return decides;
      }
      return first && second ? std::optional(!decides) : std::nullopt;
    }
    if (!now.is("fcmp")) {
      return std::nullopt;
    }
    Share x = at(now.operands[0]);
    Share y = at(now.operands[1]);
    const bool are_numbers = x.share.finite() && y.share.finite();
    if (!are_numbers || now.predicate == "ord" || now.predicate == "uno") {
      return are_numbers ? std::optional(now.predicate == "ord") : std::nullopt;
    }
    const std::optional<int> order = y.is_constant && y.sign == 0 ? x.sign
                                     : x.is_constant && x.sign == 0
                                         ? (y.sign ? std::optional(-*y.sign) : y.sign)
                                     : make_alike(x, y) ? sign_of(x.share - y.share)
                                                        : std::nullopt;
    return order ? relation(now.predicate, *order) : std::nullopt;
  }

  /// Of a number that is less (-1), equal (0) or more (1) than another.
  static std::optional<bool> relation(const std::string& predicate, int order) {
    const std::string name = predicate.size() == 3 ? predicate.substr(1) : "";
    return name == "lt"   ? std::optional(order < 0)
           : name == "le" ? std::optional(order <= 0)
           : name == "gt" ? std::optional(order > 0)
           : name == "ge" ? std::optional(order >= 0)
           : name == "eq" ? std::optional(order == 0)
           : name == "ne" ? std::optional(order != 0)
                          : std::nullopt;
  }

  const CodeListing* listing_;
  std::map<int, Share> known_;
};

/// Whether everything that depends on the states knows the samples by that register alone.
bool stands_for_samples(const CodeListing& listing, int place) {
  std::vector<bool> of_samples, of_states;
  const auto is_only_of_samples = [&](int of) {
    return of_samples[static_cast<std::size_t>(of)] && !of_states[static_cast<std::size_t>(of)];
  };
  bool is_alone = true;
  const auto take = [&](int of) { is_alone = is_alone && (of == place || !is_only_of_samples(of)); };
  for (const ListedOperation& operation : listing.operations) {
    const int here = static_cast<int>(of_samples.size());
    const bool is_sample =
        std::find(listing.samples.begin(), listing.samples.end(), here) != listing.samples.end();
    bool samples = is_sample;
    bool states = operation.is("input") && !is_sample;
    for (const int operand : operation.operands) {
      samples = samples || of_samples[static_cast<std::size_t>(operand)];
      states = states || of_states[static_cast<std::size_t>(operand)];
    }
    of_samples.push_back(samples);
    of_states.push_back(states);
    if (states) {
      std::for_each(operation.operands.begin(), operation.operands.end(), take);
    }
  }
  for (const ListedState& state : listing.states) {
    take(state.next);
  }
  for (const ListedObligation& obligation : listing.obligations) {
    take(obligation.must_be_zero);
  }
  take(listing.frequency);
  return is_alone && is_only_of_samples(place);
}

bool is_near(const CodeListing& listing, const ListedArcTangent& arc, const RimPoint& point) {
  const Ball value = [&] {
    RimValues values(listing, point);
    const Share& share = values.at(arc.place);
    return share.degree == 0 ? share.share : Ball::everything();
  }();
  if (!value.finite()) {
    return false;
  }
  const Ball difference = value - point.angle;
  const Ball turns(std::round(difference.near() / 6.283185307179586));
  return certainly_at_most(abs(difference - turns * two * pi()), arc.error) &&
         certainly_at_most(abs(value), arc.largest);
}

/// On the half of a side with this sign, all of it.
bool is_near_along(const CodeListing& listing, const ListedArcTangent& arc, int side, int sign) {
  constexpr double kNarrowest = 0x1p-30;
  std::vector<std::pair<double, double>> open{{0.0, sign == 0 ? 0.0 : 1.0}};
  while (!open.empty()) {
    const auto [low, high] = open.back();
    open.pop_back();
    if (is_near(listing, arc, rim_point(side, sign, Ball::hull(Ball(low), Ball(high))))) {
      continue;
    }
    if (!(high - low > kNarrowest)) {
      return false;
    }
    const double middle = 0.5 * (low + high);
    open.emplace_back(low, middle);
    open.emplace_back(middle, high);
  }
  return true;
}

}  // namespace

void check_arc_tangent(const CodeListing& listing, const ListedArcTangent& arc, Objections& objections) {
  const int count = static_cast<int>(listing.operations.size());
  const auto is_single = [&](int sample) { return listing.at(sample).format == ListedFormat{true, 32}; };
  if (arc.place < 0 || arc.place >= count || !listing.at(arc.place).format.is_float ||
      listing.samples.size() != 2 ||
      !std::all_of(listing.samples.begin(), listing.samples.end(), is_single) ||
      !stands_for_samples(listing, arc.place)) {
    objections.emplace_back("the arc tangent is no register that all else knows two samples by");
    return;
  }
  if (!certainly_positive(arc.error) || !certainly_less(arc.error, one) || !certainly_positive(arc.largest) ||
      !certainly_less(arc.largest, Ball(4.0))) {
    objections.emplace_back("the arc tangent is off by a number between 0 and 1, and is below 4");
    return;
  }
  for (int side = 0; side < 4; ++side) {
    for (int sign = -1; sign <= 1; ++sign) {
      if (!is_near_along(listing, arc, side, sign)) {
        objections.emplace_back("the register is not as near the arc tangent as listed");
        return;
      }
    }
  }
}

}  // namespace veritrack::checker
