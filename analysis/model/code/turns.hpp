// Angles that a program wraps: values that differ by whole turns, and the ranges that the wraps keep them in.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "trackers/code/listing.hpp"

namespace veritrack::model::code {

/// A range of numbers, both ends included.
struct Range {
  double low = 0.0;
  double high = 0.0;
  friend bool operator==(const Range&, const Range&) = default;
};

/// The listing, with conversions of format looked through.
class Turns {
 public:
  explicit Turns(const trackers::code::Listing& listing) : listing_(&listing) {}

  /// The register behind conversions of format, and behind what is done for values that are no numbers: a
  /// certified value is one.
  [[nodiscard]] int plain(int value) const;
  /// The register that the value differs from by whole turns only: all branches of its selects lead there.
  /// The value itself where there is none.
  [[nodiscard]] int without_turns(int value);
  /// Whether the value is wrapped: a select of values that differ by turns, or what is left of one after a
  /// rounded number of turns is taken away.
  [[nodiscard]] bool is_wrapped(int value);
  /// The range of a wrapped value, or of one that a condition compares, where `base` has this range; nothing
  /// where the value is made of anything else.
  [[nodiscard]] std::optional<Range> range(int value, int base, Range of_base) const;
  /// A way from the base to the value.
  struct Shift {
    double by = 0.0;         ///< what is added to the base
    double roundings = 0.0;  ///< the sum of the units of roundoff of its operations
  };
  /// One entry for each way in which a value of the base's range may go.
  [[nodiscard]] std::optional<std::vector<Shift>> shifts(int value, int base, Range of_base) const;
  /// What a condition is for numbers, where it asks only whether a value is one.
  [[nodiscard]] std::optional<bool> tests_for_numbers(int condition) const;
  /// Whether a condition certainly does not hold where `base` has this range.
  [[nodiscard]] bool is_never(int condition, int base, Range of_base) const;

 private:
  [[nodiscard]] const trackers::code::Instruction& at(int value) const {
    return listing_->instructions[static_cast<std::size_t>(value)];
  }
  [[nodiscard]] std::optional<double> number(int value) const;
  /// A part of the base's range, and the comparisons that are decided there and the turns that are counted:
  /// next to its limit, a comparison may be true or false, but it is the same one wherever it is asked for.
  struct Part {
    Range of_base;
    std::map<int, bool> decided;
    std::map<int, double> counted;  ///< by the value that is left
  };
  /// There, the value is the base and a constant.
  struct Piece {
    Part part;
    Shift shift;
  };
  /// x - n T, where n is x/T, rounded, and T a whole turn: by a rounding function and a product, or by fmod.
  struct Reduction {
    int argument = -1;
    trackers::code::Operation rounding = trackers::code::Operation::trunc;
    double turn = 0.0;
    double roundings = 0.0;
  };
  [[nodiscard]] std::optional<Reduction> reduction_of(int value) const;
  /// What x is in f(x + pi) - pi, where f wraps.
  [[nodiscard]] std::optional<int> centred_of(int value);
  /// Whether the value is a rounded number of turns in this argument, by its constant.
  [[nodiscard]] std::optional<trackers::code::Operation> counted(int value, int argument, double turn) const;
  [[nodiscard]] std::optional<std::vector<Piece>> reduced(int value, const Reduction& reduction, int base,
                                                          const Part& part) const;
  /// There, a condition holds, or does not.
  struct Truth {
    Part part;
    bool holds = false;
  };
  /// As `plain`, and the roundoff of the conversions on the way.
  [[nodiscard]] std::pair<int, double> plain_with_roundings(int value) const;
  [[nodiscard]] std::optional<std::vector<Piece>> pieces(int value, int base, const Part& part) const;
  [[nodiscard]] std::optional<std::vector<Truth>> truth(int condition, int base, const Part& part) const;
  [[nodiscard]] std::optional<std::vector<Truth>> truth_of_comparison(int condition, int base,
                                                                      const Part& part) const;

  const trackers::code::Listing* listing_;
  std::map<int, int> without_turns_;
};

/// Half of a unit in the last place of 1 in a format of numbers.
[[nodiscard]] inline double unit_roundoff(trackers::code::Format format) {
  return format.bits == 32 ? 0x1p-24 : 0x1p-53;
}

/// Slack of a wrap: constants of single precision for turns and half turns, and the rounding of sums.
inline constexpr double kWrapSlack = 1e-5;

}  // namespace veritrack::model::code
