// Values of a loop of one channel or two, measured from the phase of its signal: linear in the deviations of
// the states and in inputs of known size (docs/gain-proof.md, section 2). Each operation on the same values
// is made once, so that a value is known by its number.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "checker/model/gain/exact_number.hpp"
#include "checker/numbers/ball.hpp"

namespace veritrack::checker {

/// The factors of the two components of an input; an input of one component has the first alone.
struct InputFactor {
  Ball first, second;
};

/// turns phi + constant + per_frequency omega + the sum of deviations, with phi and omega those of the sample
/// before.
struct LinearValue {
  long turns = 0;
  Ball constant, per_frequency;
  /// By source: the states, then the inputs.
  std::map<std::size_t, InputFactor> deviations;
  bool is_modulo_turn = false;  ///< known modulo 2 pi only

  /// Without the phase, and known as a number.
  [[nodiscard]] bool is_plain() const { return turns == 0 && !is_modulo_turn; }
  [[nodiscard]] bool is_constant() const {
    return is_plain() && deviations.empty() && certainly_equal(per_frequency, zero);
  }
};

/// An input z e^(j turns phi_(k+1)), where z has a length that is the same at all samples, and an angle that
/// is a constant and this form in the deviations of states (docs/gain-proof.md, section 9).
struct FrameRipple {
  long turns = 0;
  std::map<std::size_t, Ball> angle;
  Ball size;
};

/// An input from outside of the linear recursion, one for each sample: noise, or a remainder.
struct FrameInput {
  /// The size of noise for this bound on the noise.
  std::function<Ball(const Ball& noise)> at_noise;
  /// The values whose deviations a remainder is about, and its size where these are at most as large.
  std::vector<int> about;
  std::function<Ball(const std::vector<Ball>& bounds)> at_bounds;

  /// The ripple, where the input is one; its size is at_noise, too.
  std::optional<FrameRipple> ripple = std::nullopt;

  [[nodiscard]] bool is_remainder() const { return !about.empty(); }
};

/// low < base + deviation of a value < high.
struct FrameLimit {
  int about = 0;
  Ball base, low, high;
};

class LinearFrame {
 public:
  /// Amplitudes and frequencies are anywhere in these ranges. Samples have one channel or two. With two, the
  /// noise of a sample may be one input wherever it comes in.
  LinearFrame(std::size_t states, Ball least_amplitude, Ball largest_amplitude, const Ball& lowest,
              const Ball& highest, std::size_t channels, bool has_one_noise = false);

  // Each returns the number of the value. Throws NotCovered.
  int number(const Ball& value);
  /// A constant by its place; another place is another number, whatever the balls.
  int constant(const Ball& value, std::size_t place);
  int state(std::size_t index, const LinearValue& value);
  /// phi + omega.
  int sample_phase();
  int sum(int x, int y);
  int negated(int x);
  int product(int x, int y);
  int quotient(int x, int y);
  /// A function of this name: sqrt, exp, log, tan, asin, acos, atan, reciprocal.
  int function(const std::string& name, int x);
  /// atan2 of y and x, off its cut.
  int direction(int y, int x);
  /// The root of x^2 + y^2, near a positive x.
  int length(int y, int x);
  int stays_within(int x, int low, int high);
  /// Whether its steady value is above 0: that it stays so is a limit.
  bool stays_positive(int x);
  int larger(int x, int y);
  int clamped(int x, int low, int high);
  /// 1 or -1: that it stays so is a limit.
  int certain_sign(int x);
  /// The angle that noise adds to that of the sample.
  int noise_angle();
  /// The real (0) or imaginary (1) part of the noise, turned back by the phase of the signal: one input.
  int noise_part(std::size_t part);
  int quarter_turns(int count);
  /// The value less a multiple of `period`, certain to be within half a period of 0.
  int principal(int x, const Ball& period);
  /// The same, known modulo 2 pi.
  int modulo_turn(int x);
  /// A value made otherwise, once for each name.
  int made(const std::string& name, const std::function<LinearValue()>& make);
  /// The number of a value that was made with this name.
  [[nodiscard]] int known(const std::string& name) const { return names_.at(name); }
  /// A new input; returns its source.
  std::size_t add_input(FrameInput input);
  /// The input of this name, made once; returns its source.
  std::size_t named_input(const std::string& name, const std::function<FrameInput()>& make);

  [[nodiscard]] const LinearValue& at(int number) const {
    return values_.at(static_cast<std::size_t>(number));
  }
  /// The whole number that a constant is, if it is one.
  [[nodiscard]] std::optional<long> whole(int x) const;
  [[nodiscard]] ConstantFactors factors(int constant) const;
  /// constant + per_frequency omega over the band.
  [[nodiscard]] Ball base(const LinearValue& value) const;
  [[nodiscard]] const Ball& least_amplitude() const { return least_; }
  [[nodiscard]] const Ball& largest_amplitude() const { return largest_; }
  [[nodiscard]] std::size_t states() const { return states_; }
  [[nodiscard]] bool has_one_channel() const { return channels_ == 1; }
  [[nodiscard]] bool has_one_noise() const { return has_one_noise_; }
  [[nodiscard]] const std::vector<FrameInput>& inputs() const { return inputs_; }
  [[nodiscard]] const std::vector<FrameLimit>& limits() const { return limits_; }
  /// The values that are angles of waves, or of which a function took one turn only.
  [[nodiscard]] const std::vector<int>& angles() const { return angles_; }
  void note_angle(int x) { angles_.push_back(x); }
  /// Whether a steady state may be at a kink or a jump: then nothing is linear to first order.
  [[nodiscard]] bool may_rest_at_kink() const { return may_rest_at_kink_; }

 private:
  /// With a name of its own, or that of the exact number that it is.
  int keep(const std::string& name, LinearValue value);
  void limit(int x, const Ball& low, const Ball& high);
  [[nodiscard]] LinearValue scaled(const LinearValue& x, int constant) const;
  [[nodiscard]] LinearValue product_of_plain(int x, int y);
  /// What deviates along the direction of x + j y and across it, relative to its length.
  [[nodiscard]] std::array<int, 2> relative_to_direction(int y, int x);
  void note_distance(const Ball& distance);
  [[nodiscard]] int difference(int x, int y) { return sum(x, negated(y)); }
  [[nodiscard]] LinearValue value_of_function(const std::string& name, int x);

  std::size_t states_, channels_;
  bool has_one_noise_;
  Ball least_, largest_, frequency_;
  std::map<std::string, int> names_;
  std::vector<LinearValue> values_;
  std::map<int, ConstantFactors> factors_;
  std::map<std::string, std::size_t> input_names_;
  std::vector<FrameInput> inputs_;
  std::vector<FrameLimit> limits_;
  std::vector<int> angles_;
  bool may_rest_at_kink_ = false;
};

/// Throws NotCovered where a value is not plain.
void require_plain(const LinearValue& x);
/// The deviations of x times a number, added to those of `sum`.
void add_deviations(LinearValue& sum, const LinearValue& x, const Ball& factor);

}  // namespace veritrack::checker
