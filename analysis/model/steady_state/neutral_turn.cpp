#include "analysis/model/steady_state/neutral_turn.hpp"

#include <cmath>
#include <random>
#include <vector>

namespace veritrack::model {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd turned(VectorXd state, const NeutralTurn& turn, double by) {
  const auto cosine = static_cast<Index>(turn.cosine);
  const auto sine = static_cast<Index>(turn.sine);
  const double c = state[cosine];
  const double s = state[sine];
  state[static_cast<Index>(turn.angle)] += by;
  state[cosine] = c * std::cos(by) - s * std::sin(by);
  state[sine] = c * std::sin(by) + s * std::cos(by);
  return state;
}

/// Places that are tried, the same at each call.
struct Places {
  std::vector<VectorXd> states, samples;
};

Places places_near(const StepMap& step, const VectorXd& near, const VectorXd& size) {
  constexpr int kTried = 4;
  constexpr double kFar = 0.1;  // of the sizes
  std::mt19937_64 generator(1);
  const auto random = [&generator](Index count) {
    return VectorXd(VectorXd::NullaryExpr(
        count, [&generator] { return 2.0 * static_cast<double>(generator() >> 11U) * 0x1p-53 - 1.0; }));
  };
  Places places;
  for (int k = 0; k < kTried; ++k) {
    places.states.emplace_back(near + kFar * size.cwiseProduct(random(near.size())));
    places.samples.emplace_back(random(step.samples()));
  }
  return places;
}

/// A comparison with NaN is false.
bool is_neutral(const StepMap& step, const Places& places, const VectorXd& size, const NeutralTurn& turn) {
  constexpr double kTurn = 1.0;
  constexpr double kEqual = 1e-11;
  for (std::size_t k = 0; k < places.states.size(); ++k) {
    const VectorXd& state = places.states[k];
    const VectorXd before = turned(state, turn, kTurn);
    const VectorXd after = turned(step.next(state, places.samples[k]), turn, kTurn);
    const VectorXd apart = step.next(before, places.samples[k]) - after;
    const VectorXd scale = size + after.cwiseAbs();
    const double frequency = step.frequency(state);
    if (!(apart.cwiseQuotient(scale).cwiseAbs().maxCoeff() < kEqual) ||
        !(std::fabs(step.frequency(before) - frequency) < kEqual * (1.0 + std::fabs(frequency)))) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::optional<NeutralTurn> find_neutral_turn(const StepMap& step, const VectorXd& near,
                                             const VectorXd& size) {
  const std::vector<bool>& is_angle = step.recursion().is_angle;
  const VectorXd unit = size.unaryExpr([](double s) { return s > 0.0 ? s : 1.0; });
  const Places places = places_near(step, near, unit);
  for (std::size_t angle = 0; angle < is_angle.size(); ++angle) {
    for (std::size_t c = 0; is_angle[angle] && c < is_angle.size(); ++c) {
      for (std::size_t s = 0; !is_angle[c] && s < is_angle.size(); ++s) {
        const NeutralTurn turn{angle, c, s};
        if (s != c && !is_angle[s] && is_neutral(step, places, unit, turn)) {
          return turn;
        }
      }
    }
  }
  return std::nullopt;
}

std::string words_of(const NeutralTurn& turn, const std::vector<std::string>& names) {
  const auto name = [&](std::size_t state) {
    return state < names.size() ? names[state] : "state " + std::to_string(state);
  };
  const std::string angle = name(turn.angle);
  const std::string c = name(turn.cosine);
  const std::string s = name(turn.sine);
  return angle + ", " + c + " and " + s + " may turn together, and the tracker does not notice. Write " + c +
         "*cos(" + angle + ") + " + s + "*sin(" + angle + ") and " + s + "*cos(" + angle + ") - " + c +
         "*sin(" + angle +
         ") as two states in place of these three (docs/model.md, \"When something is not proved\")";
}

}  // namespace veritrack::model
