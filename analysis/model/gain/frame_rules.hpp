// The rules by which values are combined: shared by the files of frame_value.hpp.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "analysis/model/gain/frame_value.hpp"

namespace veritrack::model {

/// Numbers of operations, for names.
enum class FrameOperation {
  constant,
  state,
  sample,
  add,
  subtract,
  multiply,
  divide,
  negate,
  reciprocal,
  root,
  exponential,
  logarithm,
  sine,
  cosine,
  tangent,
  arcsine,
  arccosine,
  arctangent,
  arctangent2,
  within,
  line,
  largest,
  least,
  absolute,
  limits,
  clamped,
  vector
};

/// Where Y = value Im-like and X = value Re-like of one wave M: X + i Y = kappa M or kappa conj(M), with
/// kappa a positive number times i^quarters.
struct WavePattern {
  Monomial monomial;
  int sign = 1;  ///< -1: of the conjugate
  int quarters = 0;
};

struct FrameRules {
  static Frame& frame_of(const FrameValue& a, const FrameValue& b);
  static int name_of(Frame& frame, const FrameValue& value);
  static int named(Frame& frame, FrameOperation operation, int first, int second = -1);
  static int named(FrameOperation operation, const FrameValue& a, const FrameValue& b);

  /// The number that a constant is, if it is exact: a double with few digits.
  static std::optional<double> exact(const FrameValue& value);
  static double exact_sum(double a, double b);
  static double exact_product(double a, double b);
  /// A constant or waves as waves; false for others.
  static bool as_waves(const FrameValue& value, Waves& waves);
  /// A linear value without turns as a factor of waves that turn with the signal; false for others.
  static bool as_factor(const FrameValue& value, const FrameValue& of, Waves& waves);
  static void add_wave(Waves& waves, Monomial monomial, WaveWeights weights);
  static Waves product_of(const Waves& a, const Waves& b);
  static FrameLine sum_of(const FrameLine& a, const FrameLine& b, bool subtracts);
  static FrameLine scaled(const FrameLine& line, const rigor::Interval& factor, std::optional<double> exact);

  // Lines, and parts of the network (frame_nodes.cpp).
  static void require_no_turns(const FrameLine& line);
  /// The deviations alone.
  static FrameLine form_of(const FrameLine& line);
  /// The value in the steady state, but for its turns.
  static rigor::Interval base_of(const FrameLine& line, const rigor::Interval& band);
  static void add_component(FrameLine& line, int component, const rigor::Interval& weight);
  static int add_form(Frame& frame, const FrameLine& line);
  static int add_angle_form(Frame& frame, const FrameLine& line);
  static int add_input(Frame& frame, FrameInput input);
  static void add_limit(Frame& frame, int form, const rigor::Interval& room);
  /// Adds an input of this size at bounds of the forms.
  static void add_remainder(Frame& frame, FrameLine& line, const char* what,
                            std::function<double(const std::vector<double>& bounds)> size);

  // Waves and noise (frame_waves.cpp).
  static rigor::Interval whole_power(const rigor::Interval& x, int exponent);
  /// Whether all lengths in it are above 0, which is a limit from now on.
  static bool keeps_positive(Frame& frame, const Monomial& monomial);
  static FrameLine scaled_part(Frame& frame, const Monomial& monomial, int part);
  static FrameLine part_of_wave(Frame& frame, const Monomial& monomial, int part);
  static int form_of_phase(Frame& frame, const Monomial& monomial, const FrameLine& phase);
  static FrameLine line_of_waves(Frame& frame, const Waves& waves);
  static FrameLine phase_of(Frame& frame, const Monomial& monomial);
  static int disc(Frame& frame, const Monomial& monomial);
  static int ripple(Frame& frame, const Monomial& monomial, const FrameLine& phase);

  // Noise that is one input (frame_shared_noise.cpp).
  /// The first component of the noise of a sample as the signal's phase sees it.
  static int shared_noise(Frame& frame);
  /// What noise adds to Re M or Im M.
  static void add_shared_noise(Frame& frame, FrameLine& line, const Monomial& monomial,
                               const FrameLine& phase, int part);
  /// `multiple` times the angle that noise adds to that of the sample.
  static void add_shared_angle(Frame& frame, FrameLine& line, double multiple);

  // Products and functions (frame_functions.cpp).
  static FrameLine product_line(Frame& frame, const FrameLine& a, const FrameLine& b, bool is_square);
  static FrameLine function_line(Frame& frame, FrameOperation operation, const FrameLine& operand);

  // Vectors (frame_polar.cpp).
  static FrameLine direction_line(Frame& frame, const FrameLine& y, const FrameLine& x);
  static FrameLine length_line(Frame& frame, const FrameLine& y, const FrameLine& x);

  // Kinks (frame_kinks.cpp).
  static void rest_at_kink(Frame& frame);

  // Angles, and division (frame_angles.cpp).
  static void keep_angle(Frame& frame, int name, const FrameLine& line);
  static int exact_factor(Frame& frame, double number);
  static int reciprocal_factor(Frame& frame, int factor);
  static bool find_pattern(Frame& frame, const Waves& y, const Waves& x, WavePattern& pattern);
  /// The angle of kappa M, up to whole turns.
  static FrameLine whole_angle(Frame& frame, const WavePattern& pattern);
  /// The same: with a limit at half of the period where it has no turns.
  static FrameLine angle_line(Frame& frame, const WavePattern& pattern, int turns_per_period);
};

}  // namespace veritrack::model
