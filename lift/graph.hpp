// The operations of a listing while it is made: each once, and those of known operands computed.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "trackers/code/listing.hpp"

namespace veritrack::lift {

using trackers::code::Format;
using trackers::code::Instruction;
using trackers::code::Operation;
using trackers::code::Place;
using trackers::code::Predicate;

/// Registers are numbers; -1 is none. Functions of the library are never computed: the library of the target
/// may give another number.
class Graph {
 public:
  [[nodiscard]] int constant(Format format, std::uint64_t bits);
  [[nodiscard]] int number(Format format, double value);
  [[nodiscard]] int bit(bool value) { return constant(trackers::code::kBit, value ? 1 : 0); }
  /// A new input.
  [[nodiscard]] int input(Format format);
  /// The register of an operation on registers. Throws LiftError for a known division by 0; where the result
  /// alone is undefined for known operands, it is 0.
  [[nodiscard]] int make(Operation operation, Format format, std::vector<int> operands,
                         Predicate predicate = Predicate::none);
  [[nodiscard]] int element(Format format, int index, const std::vector<std::uint64_t>& table,
                            bool is_of_library);
  [[nodiscard]] int select(int condition, int yes, int no);
  [[nodiscard]] int negated(int condition);
  [[nodiscard]] int both(int a, int b);
  /// The same bits in another format.
  [[nodiscard]] int reinterpreted(int value, Format format);

  [[nodiscard]] const Instruction& at(int value) const {
    return instructions_[static_cast<std::size_t>(value)];
  }
  [[nodiscard]] bool is_known(int value) const { return at(value).operation == Operation::constant; }
  [[nodiscard]] std::uint64_t bits(int value) const { return at(value).bits; }
  [[nodiscard]] Format format(int value) const { return at(value).format; }
  [[nodiscard]] std::int64_t signed_bits(int value) const;
  /// Whether no input is below the value.
  [[nodiscard]] bool is_free_of_inputs(int value);
  /// The bits that the library of this machine gives to a value without inputs.
  [[nodiscard]] std::uint64_t computed_here(int value);

  /// Operations made from now on come from this place.
  void set_place(Place place) { place_ = place; }
  [[nodiscard]] Place place() const { return place_; }
  [[nodiscard]] std::size_t size() const { return instructions_.size(); }
  [[nodiscard]] const std::vector<std::vector<std::uint64_t>>& tables() const { return tables_; }
  /// Those whose elements the library of this machine has computed.
  [[nodiscard]] const std::set<int>& tables_of_library() const { return tables_of_library_; }

 private:
  using Key = std::tuple<Operation, bool, int, Predicate, int, int, int, int, std::uint64_t>;

  [[nodiscard]] int put(Instruction instruction);
  /// A register that is equal without the operation, or -1.
  [[nodiscard]] int simpler(const Instruction& instruction);
  [[nodiscard]] int simpler_of_integers(const Instruction& instruction);
  [[nodiscard]] int simpler_comparison(const Instruction& instruction);

  std::vector<Instruction> instructions_;
  std::vector<std::vector<std::uint64_t>> tables_;
  std::map<Key, int> known_;
  std::vector<bool> free_of_inputs_;  ///< of the first registers
  std::set<int> tables_of_library_;
  Place place_;
};

}  // namespace veritrack::lift
