#include "analysis/regulator/output_bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "analysis/regulator/inverse_filter.hpp"
#include "analysis/rigor/elementary.hpp"
#include "analysis/statements/derivation_builder.hpp"

namespace veritrack::regulator {

namespace {

using rigor::Interval;
using rigor::Verdict;
using theorems::Derivation;
using theorems::Sense;

/// A part of the band, and the size of A_1 there.
struct Cell {
  Interval frequency;
  Interval plant;  ///< |A_1(e^{j omega})|
};

Interval sum_of_sizes(const std::vector<Interval>& coefficients, Interval (*weight)(double index)) {
  Interval sum(0.0);
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    sum += abs(coefficients[i]) * weight(static_cast<double>(i));
  }
  return sum;
}

/// A thousandth more than the bound on cells, for a checker with other cells.
constexpr double kRoom = 1.001;

/// Bounds of the signal that drives the output, of 1/A_1 of it, and of the output.
class Loop {
 public:
  explicit Loop(const RegulatorQuestion& question)
      : question_(question),
        inverse_plant_(question.a),
        inverse_input_(question.b),
        size_(sum_of_sizes(question.a, [](double) { return Interval(1.0); })),
        drift_(sum_of_sizes(question.a, [](double i) { return Interval(2.0 * i + 1.0); })),
        bend_(sum_of_sizes(question.a, [](double i) { return Interval(i * (i + 1.0) / 2.0); })) {
    cut_band();
  }

  [[nodiscard]] const InverseFilter& inverse_plant() const { return inverse_plant_; }
  [[nodiscard]] const InverseFilter& inverse_input() const { return inverse_input_; }
  [[nodiscard]] Interval largest_cosine() const {
    const Interval cosine = abs(cos(hull(question_.lowest, question_.highest)));
    return is_finite(cosine) ? Interval(cosine.upper()) : cosine;
  }

  /// |output| in the long run, while the frequency error is at most that.
  [[nodiscard]] Interval output(const Interval& error) const {
    return inverse_plant_.norm() * drive(error) + straight_noise();
  }
  /// |A_1 y| at every sample, the first ones included, with a bound for ever on the frequency error.
  [[nodiscard]] Interval drive_for_ever(const Interval& error) const {
    Interval most = drive(error);
    for (const Interval& first : first_drives(error)) {
      most = max(most, first);
    }
    return most;
  }
  /// All of them at once, or the first ones apart.
  [[nodiscard]] Interval output_for_ever(const Interval& error) const {
    Interval first(0.0);
    for (const Interval& each : first_drives(error)) {
      first += each;
    }
    return min(inverse_plant_.norm() * drive_for_ever(error),
               inverse_plant_.norm() * drive(error) + inverse_plant_.peak() * first) +
           straight_noise();
  }

  /// |u| at every sample, and in the long run.
  [[nodiscard]] Interval input_for_ever() const {
    return inverse_input_.norm() * Interval(3.0) * size_ * (question_.amplitude + question_.noise);
  }
  [[nodiscard]] Interval input(const Interval& error) const {
    const Interval seen = largest([&](const Cell& cell) { return cell.plant + question_.slew * bend_; });
    const Interval left = largest([&](const Cell& cell) { return of_tone(cell, error); });
    return inverse_input_.norm() *
           (question_.amplitude * seen + left + Interval(3.0) * size_ * question_.noise);
  }

 private:
  void cut_band() {
    constexpr int kCells = 256;
    const double low = question_.lowest.lower();
    const double high = question_.highest.upper();
    double left = low;
    for (int i = 1; i <= kCells && (left < high || i == 1); ++i) {
      const double right = i == kCells ? high : std::min(high, low + (high - low) * i / kCells);
      add_cell(Interval::from_bounds(left, right));
      left = right;
    }
  }

  void add_cell(const Interval& frequency) {
    Interval real(0.0);
    Interval imaginary(0.0);
    for (std::size_t i = 0; i < question_.a.size(); ++i) {
      const auto [sine, cosine] = sin_cos(Interval(static_cast<double>(i)) * frequency);
      real += question_.a[i] * cosine;
      imaginary += question_.a[i] * sine;
    }
    cells_.push_back({frequency, sqrt(square(real) + square(imaginary))});
  }

  template <typename Value>
  [[nodiscard]] Interval largest(const Value& value) const {
    Interval most = value(cells_.front());
    for (const Cell& cell : cells_) {
      most = max(most, value(cell));
    }
    return Interval(kRoom) * most;
  }

  /// With a slew, the error is about the turn to the next sample or the one from the last: either is covered.
  [[nodiscard]] Interval mismatch(const Cell& cell, const Interval& error) const {
    const Interval most = error + question_.slew;
    if (!rigor::certainly_less(most, rigor::pi())) {
      return Interval(4.0);
    }
    const Interval half = most / Interval(2.0);
    return Interval(4.0) * sin(half) * abs(sin(cell.frequency + rigor::symmetric(half.upper())));
  }
  [[nodiscard]] Interval of_tone(const Cell& cell, const Interval& error) const {
    return question_.amplitude *
           (mismatch(cell, error) * (cell.plant + question_.slew * bend_) + question_.slew * drift_);
  }
  /// |A_1 y| in the long run, without straight_noise.
  [[nodiscard]] Interval drive(const Interval& error) const {
    return largest([&](const Cell& cell) {
      return of_tone(cell, error) + mismatch(cell, error) * size_ * question_.noise;
    });
  }
  /// A part of the output: -2 cos(omega_k) n_{k-1} + n_{k-2}, whatever the plant, and the effect of an
  /// earlier frequency being different.
  [[nodiscard]] Interval straight_noise() const {
    const Interval two(2.0);
    return (Interval(1.0) + two * largest_cosine() +
            two * question_.slew * size_ * inverse_plant_.weighted_norm()) *
           question_.noise;
  }
  /// |A_1 y| at the first samples, where the regulator has no samples of the tone before sample 0; without
  /// straight_noise.
  [[nodiscard]] std::vector<Interval> first_drives(const Interval& error) const {
    const Interval off = largest([&](const Cell& cell) { return mismatch(cell, error); });
    std::vector<Interval> drives;
    for (std::size_t sample = 0; sample <= question_.a.size(); ++sample) {
      drives.push_back(question_.amplitude * of_first(sample, off) + off * size_ * question_.noise);
    }
    return drives;
  }
  /// The tone's part of that, over the amplitude.
  [[nodiscard]] Interval of_first(std::size_t sample, const Interval& off) const {
    Interval sum(0.0);
    for (std::size_t i = 0; i < question_.a.size() && i <= sample; ++i) {
      Interval part = i == sample ? Interval(1.0) : off + question_.slew * Interval(2.0 * double(i) + 1.0);
      part += Interval(i + 1 == sample ? 1.0 : 0.0);
      sum += abs(question_.a[i]) * part;
    }
    return sum;
  }

  const RegulatorQuestion& question_;
  InverseFilter inverse_plant_;
  InverseFilter inverse_input_;
  Interval size_, drift_, bend_;
  std::vector<Cell> cells_;
};

Interval attenuation(const Interval& amplitude, const Interval& output) {
  return Interval(20.0) * log(amplitude / output) / log(Interval(10.0));
}

/// The sample from which on the output has settled, and its bound from then on.
std::pair<double, Interval> settled_output(const Loop& loop, const RegulatorQuestion& question) {
  const SettledFrequency& settled = *question.tracker.settled;
  const Interval from_then = loop.output(settled.error);
  const Interval before = loop.drive_for_ever(*question.tracker.for_ever);
  // The remainder of the earlier output is at most a hundredth of the lasting part, if possible.
  constexpr double kShare = 0.01;
  std::size_t low = 0;
  std::size_t high = loop.inverse_plant().size() + 1;
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    const Interval rest = loop.inverse_plant().tail(middle) * before;
    (rigor::certainly_less(rest, Interval(kShare) * from_then) ? high : low) = middle;
  }
  const double first = std::max(std::ceil(settled.samples), static_cast<double>(question.a.size()));
  return {first + static_cast<double>(high), from_then + loop.inverse_plant().tail(high) * before};
}

void add_condition(Derivation& derivation, const char* id, const char* statement, bool is_proved,
                   const char* ground, const char* objection) {
  derivation.conditions.push_back({id, statement, is_proved ? Verdict::proved : Verdict::undecided,
                                   Interval::empty(), Interval::empty(), is_proved ? ground : objection});
}

struct Text {
  const char *name, *symbol, *words;
  Sense sense = Sense::at_most;
};

void add(Derivation& derivation, const Text& text, const Interval& value) {
  theorems::add_quantity(derivation,
                         {text.name, text.symbol, "", "docs/regulator.md", text.words, text.sense}, value);
}

void add_bounds(Derivation& derivation, const Loop& loop, const RegulatorQuestion& question) {
  const FrequencyBounds& tracker = question.tracker;
  const auto add_both = [&](const Text& output, const Text& decibels, const Interval& value) {
    add(derivation, output, value);
    add(derivation, decibels, attenuation(question.amplitude, value));
  };
  add(derivation, {"output_bound", "\\sup_k |y_k|", "the output, at every sample, at most"},
      loop.output_for_ever(*tracker.for_ever));
  if (tracker.settled) {
    const auto [samples, output] = settled_output(loop, question);
    add(derivation, {"settling_samples", "k_y", "samples until the output has settled"}, Interval(samples));
    add_both({"settled_output", "y_s", "the output from then on, at most"},
             {"settled_attenuation", "20 \\log_{10} A/y_s", "attenuation from then on, dB, at least",
              Sense::at_least},
             output);
  }
  if (tracker.ultimate) {
    add_both({"ultimate_output", "\\limsup_k |y_k|", "the output in the long run, at most"},
             {"ultimate_attenuation", "20 \\log_{10} A/\\limsup_k |y_k|",
              "attenuation in the long run, dB, at least", Sense::at_least},
             loop.output(*tracker.ultimate));
  }
  add(derivation, {"input_bound", "\\sup_k |u_k|", "the input, at every sample, at most"},
      loop.input_for_ever());
  if (tracker.ultimate) {
    add(derivation, {"ultimate_input", "\\limsup_k |u_k|", "the input in the long run, at most"},
        loop.input(*tracker.ultimate));
  }
}

/// For the loop whose estimate is frozen at the true frequency: S = 1 - 2 cos(omega) q^-1 + q^-2.
void add_frozen_loop(Derivation& derivation, const Interval& cosine) {
  const Interval two(2.0);
  add(derivation,
      {"peak_sensitivity", "\\max_\\theta |S(e^{j\\theta})|",
       "largest gain from a disturbance of any frequency to the output, the estimate frozen, at most"},
      two + two * cosine);
  add(derivation,
      {"gain_margin", "g", "factor up to which the plant's gain may be larger, the estimate frozen, at least",
       Sense::at_least},
      (two + two * cosine) / (Interval(1.0) + two * cosine));
}

}  // namespace

Derivation derive_output_bound(const RegulatorQuestion& question) {
  Derivation derivation;
  derivation.id = "regulator";
  derivation.title = "The output of the plant under minimum-variance control at the tracker's frequencies";
  const Loop loop(question);
  const auto& [plant, input] = std::pair(&loop.inverse_plant(), &loop.inverse_input());
  add_condition(
      derivation, "plant", "A_1(z) \\ne 0 \\text{ for } |z| \\ge 1", plant->is_stable(),
      "A finite filter is an inverse of it up to an error below 1.",
      "No finite filter was found that is its inverse up to an error below 1: the plant is unstable, or "
      "its slowest mode lasts longer than 20000 samples.");
  add_condition(
      derivation, "zeros", "B_1(z) \\ne 0 \\text{ for } |z| \\ge 1", input->is_stable(),
      "A finite filter is an inverse of it up to an error below 1.",
      "No finite filter was found that is its inverse up to an error below 1: the input would grow, or "
      "its slowest mode lasts longer than 20000 samples.");
  add_condition(derivation, "tracker", "\\sup_k |\\hat\\omega_k - \\omega_k| < \\infty",
                question.tracker.for_ever.has_value(),
                "It is the bound that the tracker's certificate proves.",
                "The tracker's certificate proves no bound on its frequency error for ever.");
  if (plant->is_stable()) {
    add(derivation,
        {"inverse_plant_norm", "|1/A_1|_1", "sum of the sizes of the impulse response of 1/A1, at most"},
        plant->norm());
  }
  if (input->is_stable()) {
    add(derivation,
        {"inverse_input_norm", "|1/B_1|_1", "sum of the sizes of the impulse response of 1/B1, at most"},
        input->norm());
  }
  theorems::conclude(derivation);
  if (derivation.verdict == Verdict::proved) {
    add_bounds(derivation, loop, question);
    add_frozen_loop(derivation, loop.largest_cosine());
  }
  return derivation;
}

}  // namespace veritrack::regulator
