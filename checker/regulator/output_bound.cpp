#include "checker/regulator/output_bound.hpp"

#include <algorithm>
#include <cmath>

#include "checker/regulator/inverse_filter.hpp"

namespace veritrack::checker {

namespace {

const Ball three(3.0);

/// At least the largest |cos| of the band.
Ball largest_cosine(const Band& band) {
  return certainly_at_most(band.highest, pi()) ? max(abs(cos(band.lowest)), abs(cos(band.highest))) : one;
}

/// For one plant and one disturbance: y is 1/A_1 of the signal that `driven` bounds, plus direct noise.
class ClosedLoop {
 public:
  ClosedLoop(const DelayPlant& plant, const FrequencyPromise& promise)
      : plant_(plant), promise_(promise), inverse_(plant.a), inverse_of_b_(plant.b) {
    for (std::size_t i = 0; i < plant.a.size(); ++i) {
      const Ball delay(static_cast<double>(i));
      sum_ += abs(plant.a[i]);
      steps_ += abs(plant.a[i]) * (two * delay + one);
      bends_ += abs(plant.a[i]) * delay * (delay + one) / two;
    }
    constexpr int kPieces = 4096;
    const Ball width = (promise.band.highest - promise.band.lowest) / Ball(kPieces);
    for (int i = 0; i < kPieces; ++i) {
      const Ball left = promise.band.lowest + Ball(i) * width;
      add_piece(Ball::hull(left, left + width));
    }
  }

  [[nodiscard]] const InverseFilter& inverse() const { return inverse_; }

  /// While |frequency error| <= error.
  [[nodiscard]] Ball output(const Ball& error) const {
    return inverse_.norm() * driven(error) + straight_noise();
  }
  /// |A_1 y| at every sample.
  [[nodiscard]] Ball ever_driven() const {
    Ball most = driven(promise_.for_ever);
    for (const Ball& each : driven_at_first()) {
      most = max(most, each);
    }
    return most;
  }
  /// The first samples pass 1/A_1 one by one, or all samples are as large as the largest.
  [[nodiscard]] Ball ever_output() const {
    Ball first = zero;
    for (const Ball& each : driven_at_first()) {
      first += each;
    }
    const Ball apart = inverse_.norm() * driven(promise_.for_ever) + inverse_.peak() * first;
    return min(inverse_.norm() * ever_driven(), apart) + straight_noise();
  }
  [[nodiscard]] Ball ever_input() const {
    return inverse_of_b_.norm() * three * sum_ * (promise_.amplitude + promise_.noise);
  }
  [[nodiscard]] Ball input(const Ball& error) const {
    const Ball seen = largest([&](const Piece& piece) { return piece.plant + promise_.slew * bends_; });
    const Ball left = largest([&](const Piece& piece) { return tone(piece, error); });
    return inverse_of_b_.norm() * (promise_.amplitude * seen + left + three * sum_ * promise_.noise);
  }

 private:
  struct Piece {
    Ball frequency, plant;  ///< the size of A_1
  };

  [[nodiscard]] std::vector<Ball> driven_at_first() const {
    const Ball& error = promise_.for_ever;
    const Ball off = largest([&](const Piece& piece) { return mismatch(piece, error); });
    std::vector<Ball> found;
    // At sample m, the part of a_i is whole for i <= m - 2, lacks the tone before sample 0 for i = m - 1, and
    // is the tone at sample 0 for i = m.
    for (std::size_t m = 0; m <= plant_.a.size(); ++m) {
      Ball of_tone = zero;
      for (std::size_t i = 0; i < plant_.a.size() && i <= m; ++i) {
        const Ball whole = off + promise_.slew * (two * Ball(static_cast<double>(i)) + one);
        of_tone += abs(plant_.a[i]) * (i == m ? one : i + 1 == m ? whole + one : whole);
      }
      found.push_back(promise_.amplitude * of_tone + off * sum_ * promise_.noise);
    }
    return found;
  }
  void add_piece(const Ball& frequency) {
    Ball real = zero;
    Ball imaginary = zero;
    for (std::size_t i = 0; i < plant_.a.size(); ++i) {
      const Ball turn = Ball(static_cast<double>(i)) * frequency;
      real += plant_.a[i] * cos(turn);
      imaginary += plant_.a[i] * sin(turn);
    }
    pieces_.push_back({frequency, root_of_non_negative(square(real) + square(imaginary))});
  }
  template <typename Value>
  [[nodiscard]] Ball largest(const Value& value) const {
    Ball most = value(pieces_.front());
    for (const Piece& piece : pieces_) {
      most = max(most, value(piece).upper());
    }
    return most;
  }

  /// 2 |cos omega - cos(omega + t)| for |t| <= error plus the change of the frequency in a sample.
  [[nodiscard]] Ball mismatch(const Piece& piece, const Ball& error) const {
    const Ball most = error + promise_.slew;
    if (!certainly_less(most, pi())) {
      return four;
    }
    const Ball between = piece.frequency + Ball::within(most / two);
    return four * sin(most / two) * min(one, abs(sin(between)));
  }
  [[nodiscard]] Ball tone(const Piece& piece, const Ball& error) const {
    return promise_.amplitude *
           (mismatch(piece, error) * (piece.plant + promise_.slew * bends_) + promise_.slew * steps_);
  }
  [[nodiscard]] Ball driven(const Ball& error) const {
    return largest([&](const Piece& piece) {
      return tone(piece, error) + mismatch(piece, error) * sum_ * promise_.noise;
    });
  }
  /// The part of the noise that is in the output whatever the estimate.
  [[nodiscard]] Ball straight_noise() const {
    const Ball moved = two * promise_.slew * sum_ * inverse_.delay_norm();
    return (one + two * largest_cosine(promise_.band) + moved) * promise_.noise;
  }

  const DelayPlant& plant_;
  const FrequencyPromise& promise_;
  InverseFilter inverse_, inverse_of_b_;
  Ball sum_ = zero, steps_ = zero, bends_ = zero;
  std::vector<Piece> pieces_;
};

Ball decibels(const Ball& ratio) {
  return Ball(20.0) * log(ratio) / log(Ball(10.0));
}

/// An upper bound on the output from the sample on that the certificate names. A ball of everything unless
/// that sample comes after the tracker has settled and the memory is full.
Ball settled_output(const ClosedLoop& loop, const DelayPlant& plant, const Settled& tracker,
                    const Ball& settling) {
  const double named = settling.lower_double();
  const double first =
      std::max(std::ceil(tracker.samples.upper_double()), static_cast<double>(plant.a.size()));
  constexpr double kMost = 1e9;
  if (!(named <= kMost) || !(first <= kMost) || !(named > first)) {
    return Ball::everything();
  }
  const auto forgotten = static_cast<std::size_t>(named - first);
  return loop.output(tracker.frequency_error) + loop.inverse().tail(forgotten) * loop.ever_driven();
}

}  // namespace

Derivation output_bound(const DelayPlant& plant, const std::optional<FrequencyPromise>& promise,
                        const std::optional<Ball>& settling) {
  Derivation found;
  const InverseFilter of_a(plant.a);
  const InverseFilter of_b(plant.b);
  found.conditions = {{"plant", "A1 is Schur", proved_if(of_a.is_stable())},
                      {"zeros", "B1 is Schur", proved_if(of_b.is_stable())},
                      {"tracker", "the frequency error is bounded", proved_if(promise.has_value())}};
  const auto add = [&](const char* name, const Ball& value, Sense sense = Sense::bounds_above) {
    found.quantities.push_back({name, value, sense});
  };
  add("inverse_plant_norm", of_a.norm());
  add("inverse_input_norm", of_b.norm());
  if (!promise || !of_a.is_stable() || !of_b.is_stable()) {
    return found;
  }
  const ClosedLoop loop(plant, *promise);
  const auto add_output = [&](const char* output, const char* attenuation, const Ball& value) {
    add(output, value);
    add(attenuation, decibels(promise->amplitude / value), Sense::bounds_below);
  };
  const Ball cosine = largest_cosine(promise->band);
  add("peak_sensitivity", two + two * cosine);
  add("gain_margin", (two + two * cosine) / (one + two * cosine), Sense::bounds_below);
  add("output_bound", loop.ever_output());
  add("input_bound", loop.ever_input());
  if (promise->settled && settling) {
    add("settling_samples", *settling);
    add_output("settled_output", "settled_attenuation",
               settled_output(loop, plant, *promise->settled, *settling));
  }
  if (promise->ultimate) {
    add_output("ultimate_output", "ultimate_attenuation", loop.output(*promise->ultimate));
    add("ultimate_input", loop.input(*promise->ultimate));
  }
  return found;
}

}  // namespace veritrack::checker
