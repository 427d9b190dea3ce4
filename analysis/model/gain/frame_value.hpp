// Values of a loop's formulas in the frame of its signal (docs/gain-proof.md, section 2): run over them, the
// step is a linear recursion of the errors with inputs whose sizes are known.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "analysis/rigor/interval.hpp"

namespace veritrack::model {

/// Thrown for an operation that the rules do not cover: gains say nothing about the loop.
class NoFrame : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// turns phi + constant + per_frequency omega + a form in deviations of the states and components of inputs.
struct FrameLine {
  int turns = 0;
  bool is_modular = false;  ///< known modulo 2 pi only
  rigor::Interval constant{0.0}, per_frequency{0.0};
  std::vector<rigor::Interval> states;    ///< empty: none
  std::map<int, rigor::Interval> inputs;  ///< by the number of the component

  [[nodiscard]] bool is_form_empty() const { return states.empty() && inputs.empty(); }
  [[nodiscard]] bool is_constant() const {
    return turns == 0 && !is_modular && is_form_empty() && per_frequency == rigor::Interval(0.0);
  }
};

/// |y|^magnitude e^(i (order arg y + sum of k L)), times the constants in `factors`; L and constants by name.
/// With one channel |y| stands for the amplitude, arg y for the phase of the sample, and the noise is a
/// factor. `lengths`: times powers of linear values without turns, by name, and of the lengths of vectors of
/// states, of which nothing is known but that they are positive.
struct Monomial {
  int magnitude = 0, order = 0;
  int noise = 0;                    ///< the power of the noise; one channel
  std::map<int, int> angles;        ///< k by the name of L, not 0
  std::vector<int> factors;         ///< names of constants, in order
  std::map<int, int> lengths = {};  ///< powers that are not 0

  [[nodiscard]] bool is_real() const { return order == 0 && angles.empty(); }
  /// Whether a length of which nothing is known is a factor: these have names below 0.
  [[nodiscard]] bool has_unknown_length() const { return !lengths.empty() && lengths.begin()->first < 0; }
  friend auto operator<=>(const Monomial&, const Monomial&) = default;  // NOLINT(modernize-use-nullptr)
};

/// real Re M + imaginary Im M for each monomial M; both are exact. (imaginary, real) of one as a quotient:
/// the tangent of its angle.
struct WaveWeights {
  double real = 0.0, imaginary = 0.0;
};
using Waves = std::map<Monomial, WaveWeights>;

class Frame;

/// A value: linear, a sum of waves, or the tangent of a wave's angle.
class FrameValue {
 public:
  enum class Kind { line, waves, tangent };

  /// An exact constant.
  explicit FrameValue(int number);
  FrameValue(Frame* frame, int name, FrameLine line);
  FrameValue(Frame* frame, int name, Kind kind, Waves waves);

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] const FrameLine& line() const { return *line_; }
  [[nodiscard]] const Waves& waves() const { return *waves_; }
  [[nodiscard]] Frame* frame() const { return frame_; }
  /// The same name: the same number. -1: none (exact constants get one when they are used).
  [[nodiscard]] int name() const { return name_; }
  [[nodiscard]] bool is_constant() const { return kind_ == Kind::line && line_->is_constant(); }

 private:
  Frame* frame_ = nullptr;
  int name_ = -1;
  Kind kind_ = Kind::line;
  std::shared_ptr<const FrameLine> line_;
  std::shared_ptr<const Waves> waves_;
};

FrameValue operator+(const FrameValue& a, const FrameValue& b);
FrameValue operator-(const FrameValue& a, const FrameValue& b);
FrameValue operator*(const FrameValue& a, const FrameValue& b);
FrameValue operator/(const FrameValue& a, const FrameValue& b);
FrameValue operator-(const FrameValue& a);
FrameValue square(const FrameValue& a);
FrameValue sqrt(const FrameValue& a);
FrameValue exp(const FrameValue& a);
FrameValue log(const FrameValue& a);
FrameValue sin(const FrameValue& a);
FrameValue cos(const FrameValue& a);
FrameValue tan(const FrameValue& a);
FrameValue asin(const FrameValue& a);
FrameValue acos(const FrameValue& a);
FrameValue atan(const FrameValue& a);
FrameValue atan2(const FrameValue& y, const FrameValue& x);
FrameValue stays_within(const FrameValue& x, const FrameValue& low, const FrameValue& high);
FrameValue maximum(const FrameValue& a, const FrameValue& b);
FrameValue minimum(const FrameValue& a, const FrameValue& b);
FrameValue absolute(const FrameValue& x);
FrameValue clamped(const FrameValue& x, const FrameValue& low, const FrameValue& high);
/// `a` where `positive` is above 0, else `b`.
FrameValue chosen(const FrameValue& positive, const FrameValue& a, const FrameValue& b);
FrameValue sign_of(const FrameValue& x);

/// An input of the network: noise, or the remainder of an operation.
struct FrameInput {
  int first = 0;       ///< its first component
  int components = 1;  ///< 2: in a disc
  bool is_remainder = false;
  std::string what;  ///< of a remainder: the operation
  /// At most, for noise: at this noise. For a remainder: at these bounds of all forms.
  std::function<double(double noise)> at_noise = {};
  std::function<double(const std::vector<double>& bounds)> at_bounds = {};
};

/// |form| < room.
struct FrameLimit {
  int form = 0;
  double room = 0.0;
};

/// An input of two components that turns with the signal, A^s e^(i (turns phase + lambda)), one channel.
struct FrameRipple {
  int first = 0;  ///< its first component
  int turns = 0;
  double size = 0.0;                    ///< A^s, at most
  std::vector<rigor::Interval> states;  ///< lambda, a form in the deviations of the states; empty: 0
};

/// The network that arises while formulas are run over values. Needs the upward rounding mode.
class Frame {
 public:
  /// Amplitudes of the samples, signal units; `band`, rad/sample; one or two channels. With `shares_noise`,
  /// two channels, the noise of a sample is one input wherever it comes in; else each wave has its own.
  Frame(const rigor::Interval& amplitude, const rigor::Interval& band, int states, int channels = 2,
        bool shares_noise = false)
      : amplitude_(amplitude),
        band_(band),
        states_(states),
        channels_(channels),
        shares_noise_(shares_noise && channels == 2) {}
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  /// A constant of the formulas, by its number.
  [[nodiscard]] FrameValue constant(int number, const rigor::Interval& value);
  /// State number `state`: turns phi + constant + per_frequency omega + its deviation.
  [[nodiscard]] FrameValue state(int state, bool is_angle, int turns, double constant, double per_frequency);
  /// The real (0) or imaginary (1) part of a sample at the phase phi + omega; of one channel the sample.
  [[nodiscard]] FrameValue sample(int channel);
  /// States that are the two parts of a vector: its angle is turns phi + constant + per_frequency omega + the
  /// deviation of state number `real`. Its length is this value, or any where that is an exact constant.
  [[nodiscard]] std::array<FrameValue, 2> vector(int real, int turns, double constant, double per_frequency,
                                                 const FrameValue& length);
  /// The angle of a vector with these two parts, up to whole turns, where its length is certainly positive
  /// and depends on that of no vector before. Throws NoFrame.
  [[nodiscard]] FrameLine direction_of(const FrameValue& real, const FrameValue& imaginary);
  /// The angle of a vector, up to whole turns, and its length: seen from the direction of what is kept of the
  /// vector whose length has this name, or else from turns (phi + omega) + constant + per_frequency omega.
  /// Throws NoFrame.
  [[nodiscard]] std::array<FrameLine, 2> polar_of(const FrameValue& real, const FrameValue& imaginary,
                                                  int length, int turns, double constant,
                                                  double per_frequency);
  /// A linear value equal to this one. Throws NoFrame where it depends on the phase.
  [[nodiscard]] FrameLine line_of(const FrameValue& value);

  [[nodiscard]] const std::vector<FrameInput>& inputs() const { return inputs_; }
  [[nodiscard]] const std::vector<FrameLine>& forms() const { return forms_; }
  /// The forms that are angles of waves, or of which a function took one turn only.
  [[nodiscard]] const std::vector<int>& angle_forms() const { return angle_forms_; }
  [[nodiscard]] const std::vector<FrameLimit>& limits() const { return limits_; }
  [[nodiscard]] const std::vector<FrameRipple>& ripples() const { return ripples_; }
  /// Whether a steady state may be at a kink or a jump: then nothing is linear to first order.
  [[nodiscard]] bool may_rest_at_kink() const { return may_rest_at_kink_; }
  [[nodiscard]] const rigor::Interval& band() const { return band_; }
  [[nodiscard]] int states() const { return states_; }

 private:
  friend struct FrameRules;

  rigor::Interval amplitude_, band_;
  int states_;
  int channels_;
  bool shares_noise_;
  int components_ = 0;
  int names_ = 0;
  std::map<std::tuple<int, int, int>, int> name_of_;     // of an operation on names
  std::map<double, int> exact_;                          // names of exact constants
  std::map<int, FrameLine> angles_;                      // by name: of which sin and cos were taken
  std::map<int, FrameLine> lengths_;                     // by name: that are factors of waves
  std::set<int> positive_;                               // those that are above 0
  std::map<int, rigor::Interval> factors_;               // by name: constants
  std::map<std::tuple<int, int, int>, FrameLine> made_;  // nodes, by operation and operands
  std::map<Monomial, int> discs_;                        // number of the input
  std::map<Monomial, int> phase_forms_;                  // of the angles of monomials
  std::map<std::pair<Monomial, int>, FrameLine> parts_;  // Re M and Im M
  int angle_input_ = -1;                                 // of the angle that noise adds, or -1
  int noise_input_ = -1;                                 // of the noise in the frame of the signal, or -1
  int noise_form_ = -1;
  std::vector<FrameInput> inputs_;
  std::vector<FrameLine> forms_;
  std::vector<int> angle_forms_;
  std::vector<FrameLimit> limits_;
  std::vector<FrameRipple> ripples_;
  bool may_rest_at_kink_ = false;
};

}  // namespace veritrack::model
