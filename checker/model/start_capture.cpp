#include "checker/model/start_capture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "checker/model/length_bound.hpp"
#include "checker/model/rounding.hpp"
#include "checker/model/tube_check.hpp"
#include "checker/model/tube_cover.hpp"

namespace veritrack::checker {

namespace {

constexpr double kNothingKnown = std::numeric_limits<double>::infinity();
/// Samples between two looks at whether the state is in the tube.
constexpr std::size_t kBetweenLooks = 4;

/// The same angles, by whole turns nearer to 0.
BallPolynomial without_turns(const BallPolynomial& angle) {
  constexpr double kTurn = 6.283185307179586;
  const double turns = std::round(angle.constant() / kTurn);
  return std::isfinite(turns) && turns != 0.0 ? angle - BallPolynomial(Ball(turns) * two * pi()) : angle;
}

/// The part that depends on s and z alone, without the error.
BallPolynomial place_part(const BallPolynomial& polynomial) {
  const std::span<const double> block = polynomial.block(0, 0);
  std::array<double, BallPolynomial::kPlaces> coefficients{};
  std::copy_n(block.begin(), std::min(block.size(), coefficients.size()), coefficients.begin());
  return BallPolynomial::of_places(coefficients, 0.0);
}

/// A bound on the length of a vector by the sizes of its components.
double length_by_components(const std::vector<BallPolynomial>& vector) {
  double squares = 0.0;
  for (const BallPolynomial& component : vector) {
    const double size = component.known() ? bound_on(component.norm() + component.error()) : kNothingKnown;
    squares += size * size;
  }
  return bound_on(std::sqrt(bound_on(squares)));
}

/// A bound that is hardly larger than necessary; `near`: a guess. Infinite when nothing is known.
double length_of_rest(const std::vector<BallPolynomial>& vector, double near) {
  const double most = length_by_components(vector);
  if (!(most > 0.0) || !(most < kNothingKnown)) {
    return most;
  }
  const LengthBound bound(vector);
  double high = std::min(near, most);
  while (high < most && !bound.is_at_most(high, 1.0)) {
    high *= 1.0625;
  }
  if (!(high < most)) {
    return most;
  }
  constexpr int kBisections = 12;
  double low = 0.5 * high;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (bound.is_at_most(middle, 1.0) ? high : low) = middle;
  }
  return high;
}

/// The start on its way, over a part of a tube.
class FollowedStart {
 public:
  FollowedStart(const TrackedModel& model, const PhaseTube& tube, const TubePart& part,
                const StartClaim& start, const VectorMonomials& monomials)
      : model_(&model),
        tube_(&tube),
        shape_only_(tube),
        part_(part),
        start_(&start),
        monomials_(&monomials),
        noise_(start.noise.upper_double()) {
    shape_only_.curve.clear();
  }

  /// In the tube in time, with errors of the frequency as small as stated.
  [[nodiscard]] bool gets_in() {
    begin();
    constexpr double kMuch = 64.0;  // of the tube: wider sets of states do not come back
    while (radius_ <= kMuch * tube_->levels.front() && has_small_error()) {
      if ((sample_ % kBetweenLooks == 0 || sample_ == start_->samples) && is_inside()) {
        return true;
      }
      if (sample_ >= start_->samples) {
        return false;
      }
      step();
    }
    return false;
  }
  [[nodiscard]] std::size_t sample() const { return sample_; }

 private:
  /// U at this sample, about P.
  [[nodiscard]] TubeOver around(const std::vector<BallPolynomial>& middle) const {
    TubeOver over(shape_only_, part_, sample_);
    over.curve = middle;
    return over;
  }

  void set(std::vector<BallPolynomial> next) {
    std::vector<BallPolynomial> middle;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (model_->recursion->is_angle()[i] && next[i].known()) {
        next[i] = without_turns(next[i]);
      }
      middle.push_back(next[i].known() ? place_part(next[i]) : BallPolynomial());
      next[i] -= middle.back();
    }
    here_ = around(middle);
    constexpr double kLeast = 0x1p-40;  // so that a vector of the ball is always there
    const double length =
        here_->has_shape() ? length_of_rest(here_->coordinates(next), 0.75 * radius_) : kNothingKnown;
    radius_ = kNothingKnown;
    if (length >= 0.0) {
      radius_ = std::max(length, kLeast * tube_->levels.front());
    }
  }

  void begin() {
    radius_ = tube_->levels.front();
    std::vector<BallPolynomial> state;
    for (const Ball& each : start_->state) {
      state.emplace_back(each);
    }
    set(std::move(state));
  }

  void step() {
    const std::vector<BallPolynomial> state = here_->point(radius_, components(*monomials_));
    ++sample_;
    set(model_->recursion->next(
        state, with_noise(*model_, signal_later(*model_, *tube_, part_, sample_), noise_, *monomials_)));
  }

  [[nodiscard]] bool has_small_error() const {
    if (!start_->frequency_error) {
      return true;
    }
    const Ball error =
        frequency_error(*model_, *tube_, part_, here_->point(radius_, components(*monomials_))).range();
    return certainly_at_most(error, *start_->frequency_error) &&
           certainly_at_most(-*start_->frequency_error, error);
  }

  /// |U^-1 (P - C)| + r <= R_0.
  [[nodiscard]] bool is_inside() const {
    const double level = tube_->levels.front();
    if (!(radius_ < level)) {
      return false;
    }
    const TubeOver over(*tube_, part_, sample_);
    if (!over.has_shape()) {
      return false;
    }
    std::vector<BallPolynomial> deviation;
    for (std::size_t i = 0; i < over.curve.size(); ++i) {
      const BallPolynomial difference = here_->curve[i] - over.curve[i];
      deviation.push_back(model_->recursion->is_angle()[i] ? without_turns(difference) : difference);
    }
    BallPolynomial squares;
    for (const BallPolynomial& component : over.coordinates(deviation)) {
      squares += component * component;
    }
    if (!squares.known()) {
      return false;
    }
    const Ball room = Ball(level) - Ball(radius_);
    return certainly_positive(room) && certainly_at_most(squares.range(), square(room));
  }

  const TrackedModel* model_;
  const PhaseTube* tube_;
  PhaseTube shape_only_;
  TubePart part_;
  const StartClaim* start_;
  const VectorMonomials* monomials_;
  double noise_;
  std::optional<TubeOver> here_;  ///< P and U
  double radius_ = 0.0;
  std::size_t sample_ = 0;
};

bool is_number_of_parts(std::size_t n) {
  return n > 0 && (n & (n - 1)) == 0;
}

}  // namespace

bool is_captured(const TrackedModel& model, const TubeSet& set, const StartClaim& start,
                 std::int64_t& cells) {
  constexpr std::size_t kMostParts = 1U << 18U;
  const ModelRecursion& recursion = *model.recursion;
  Objections objections;
  const bool is_start = !set.tubes.empty() && !bounds_covariance(set) && !set.gaussian && start.samples > 0 &&
                        is_number_of_parts(start.phases) && is_number_of_parts(start.frequencies) &&
                        start.phases * start.frequencies <= kMostParts &&
                        start.state.size() == recursion.states() && certainly_not_negative(start.noise) &&
                        has_known_angles(model, set, objections);
  if (!is_start) {
    return false;
  }
  const double noise = start.noise.upper_double();
  const VectorMonomials monomials(recursion.states(), model.is_disturbed(noise) ? recursion.samples() : 0, 0);
  const auto ask = [&](std::size_t number, const TubePart& part, const std::vector<std::size_t>& questions) {
    FollowedStart followed(model, set.tubes[number], part, start, monomials);
    PartAnswer answer;
    if (!followed.gets_in()) {
      answer.open = questions;
      // The wider of both determines the errors from the phase of a late sample.
      constexpr double kTurn = 6.283;
      answer.halve_frequencies =
          static_cast<double>(followed.sample()) * part.half_z * set.tubes[number].half_width >
          kTurn * part.half_turn;
    }
    return answer;
  };
  const std::vector<FirstGrid> grids(set.tubes.size(), FirstGrid{start.phases, start.frequencies, 1});
  return certain_everywhere(grids, ask, cells);
}

}  // namespace veritrack::checker
