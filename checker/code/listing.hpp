// What a step of a C function computes, as a certificate lists it: IEEE operations in order, without memory,
// loops or jumps.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace veritrack::checker {

/// binary32, binary64, or an integer of 1 to 64 bits.
struct ListedFormat {
  bool is_float = false;
  int bits = 0;

  friend bool operator==(const ListedFormat&, const ListedFormat&) = default;
};

/// A register: an input, a constant, or an operation on registers listed before.
struct ListedOperation {
  std::string name;       ///< "fadd"; "input" of samples and states, "constant"
  std::string predicate;  ///< of a comparison: "olt"
  ListedFormat format;    ///< of the result
  std::vector<int> operands;
  double number = 0.0;        ///< of a constant in a format of numbers; may be infinite or "not a number"
  std::uint64_t integer = 0;  ///< of any other constant

  [[nodiscard]] bool is(std::string_view known) const { return name == known; }
  [[nodiscard]] bool is_number() const { return name == "constant" && format.is_float; }
  [[nodiscard]] bool is_bit() const { return name == "constant" && format == ListedFormat{false, 1}; }
};

struct ListedState {
  std::string name;
  int input = -1;      ///< its register before the step
  int next = -1;       ///< and after it
  double start = 0.0;  ///< after `setup`, of numbers
};

/// A bit that has to be 0 for the listing to be what the program does.
struct ListedObligation {
  int must_be_zero = -1;
  std::string why;
};

struct CodeListing {
  std::vector<ListedOperation> operations;
  std::vector<int> samples;
  std::vector<std::string> sample_names;
  std::vector<ListedState> states;
  int frequency = -1;     ///< of the states alone
  long steps_before = 0;  ///< the listing says what steps do after the first ones
  std::vector<ListedObligation> obligations;
  /// The size at most, rad, of an operation "arc": an angle of the samples in its operands, up to turns.
  double largest_arc = 0.0;

  [[nodiscard]] const ListedOperation& at(int place) const {
    return operations[static_cast<std::size_t>(place)];
  }
};

/// Every line is understood, registers are in order and formats fit, each state has one next value, and the
/// frequency depends on no sample. Throws Malformed for any other text.
CodeListing read_listing(const std::string& text);

}  // namespace veritrack::checker
