#include "lift/graph.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lift/value.hpp"
#include "tests/support/random.hpp"
#include "trackers/code/listing_run.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::kBit;
using trackers::code::kDouble;
using trackers::code::kSingle;
using trackers::code::OperationName;

bool is_of_library(Operation operation) {
  return operation >= Operation::sin && operation <= Operation::tanh;
}

/// Bits that operations treat apart now and then: zeros, ones, limits, infinities.
std::uint64_t drawn(test::Random& random, Format format) {
  if (!format.is_float) {
    constexpr std::array<std::uint64_t, 5> kSpecial{0, 1, ~std::uint64_t{0}, 0x80, 0x80000000};
    const std::uint64_t word = random.below(3) == 0 ? kSpecial.at(random.below(5)) : random.word();
    return trackers::code::wrapped(format, random.below(4) == 0 ? word & 63U : word);
  }
  const std::array special{0.0, -0.0, 1.0, -1.0, 1e-40, 3e9, std::numeric_limits<double>::infinity()};
  return trackers::code::bits_of(format, random.below(4) == 0 ? special.at(random.below(special.size()))
                                                              : random.uniform(-100.0, 100.0));
}

Format drawn_integer(test::Random& random) {
  constexpr std::array kBits{1, 8, 16, 32, 64};
  return {false, kBits.at(random.below(kBits.size()))};
}
Format drawn_float(test::Random& random) {
  return random.below(2) == 0 ? kSingle : kDouble;
}

/// An operation with formats that fit: its own, and those of its operands.
struct Typed {
  Operation operation;
  Format format;
  std::vector<Format> operands;
  Predicate predicate = Predicate::none;
};

Typed typed(test::Random& random, const OperationName& name) {
  const Format integer = drawn_integer(random);
  const Format number = drawn_float(random);
  switch (name.operation) {
    case Operation::fpext:
      return {name.operation, kDouble, {kSingle}};
    case Operation::fptrunc:
      return {name.operation, kSingle, {kDouble}};
    case Operation::sitofp:
    case Operation::uitofp:
      return {name.operation, number, {integer}};
    case Operation::fptosi:
    case Operation::fptoui:
      return {name.operation, {false, 32}, {number}};
    case Operation::zext:
    case Operation::sext:
      return {name.operation, {false, 64}, {integer.bits == 64 ? Format{false, 32} : integer}};
    case Operation::integer_trunc:
      return {name.operation, integer.bits == 64 ? Format{false, 8} : integer, {{false, 64}}};
    case Operation::bits:
      return {name.operation, {false, number.bits}, {number}};
    case Operation::fcmp: {
      const auto which = static_cast<int>(Predicate::oeq) + static_cast<int>(random.below(14));
      return {name.operation, kBit, {number, number}, static_cast<Predicate>(which)};
    }
    case Operation::icmp: {
      constexpr std::array kPredicates{Predicate::eq,  Predicate::ne,  Predicate::ult, Predicate::uge,
                                       Predicate::slt, Predicate::sle, Predicate::sgt, Predicate::sge};
      return {name.operation, kBit, {integer, integer}, kPredicates.at(random.below(kPredicates.size()))};
    }
    case Operation::select: {
      const Format format = random.below(2) == 0 ? integer : number;
      return {name.operation, format, {kBit, format, format}};
    }
    default: {
      const bool is_integer = name.operation >= Operation::add && name.operation <= Operation::ashr;
      const Format format = is_integer ? integer : number;
      return {name.operation, format, std::vector<Format>(static_cast<std::size_t>(name.operands), format)};
    }
  }
}

/// The bits of a register for given bits of the inputs.
std::uint64_t evaluated(const Graph& graph, int value, const std::vector<std::uint64_t>& inputs) {
  std::vector<std::uint64_t> bits;
  std::size_t next = 0;
  for (int i = 0; i <= value; ++i) {
    const Instruction& instruction = graph.at(i);
    if (instruction.operation == Operation::input) {
      bits.push_back(next < inputs.size() ? inputs[next] : 0);
      ++next;
      continue;
    }
    std::array<std::uint64_t, 3> values{};
    std::array<Format, 3> formats{};
    for (std::size_t k = 0; k < 3 && instruction.operands[k] >= 0; ++k) {
      values[k] = bits.at(static_cast<std::size_t>(instruction.operands[k]));
      formats[k] = graph.format(instruction.operands[k]);
    }
    try {
      bits.push_back(trackers::code::value_of(instruction, values, formats));
    } catch (const trackers::code::UndefinedOperation&) {
      bits.push_back(0);
    }
  }
  return bits.back();
}

}  // namespace

TEST_CASE("Operations of known operands are computed, of any other they keep their value") {
  test::Random random;
  int compared = 0;
  for (const OperationName& name : trackers::code::kOperationNames) {
    if (name.operation == Operation::table) {
      continue;
    }
    CAPTURE(std::string(name.name));
    for (int i = 0; i < test::effort(300); ++i) {
      const Typed of = typed(random, name);
      Graph graph;
      Instruction instruction;
      instruction.operation = of.operation;
      instruction.format = of.format;
      instruction.predicate = of.predicate;
      std::vector<std::uint64_t> values;
      std::vector<std::uint64_t> inputs;
      std::vector<int> operands;
      const bool all_known = random.below(2) == 0;
      for (const Format format : of.operands) {
        values.push_back(drawn(random, format));
        if (all_known || random.below(2) == 0) {
          operands.push_back(graph.constant(format, values.back()));
        } else {
          operands.push_back(graph.input(format));
          inputs.push_back(values.back());
        }
      }
      std::uint64_t expected = 0;
      try {
        expected = trackers::code::value_of(instruction, values, of.operands);
      } catch (const trackers::code::UndefinedOperation&) {
        continue;
      }
      const int result = graph.make(of.operation, of.format, operands, of.predicate);
      CHECK(graph.format(result) == of.format);
      if (inputs.empty()) {
        CHECK(graph.is_known(result) == !is_of_library(of.operation));
      }
      CHECK(evaluated(graph, result, inputs) == expected);
      CHECK(graph.make(of.operation, of.format, operands, of.predicate) == result);
      ++compared;
    }
  }
  CHECK(compared > test::effort(300) * 40);
}

TEST_CASE("Simplifications of nested operations keep the value") {
  test::Random random;
  for (int i = 0; i < test::effort(3000); ++i) {
    Graph graph;
    std::vector<std::uint64_t> inputs{random.below(2), random.below(2), random.word() & 0xffU};
    const int a = graph.input(kBit);
    const int b = graph.input(kBit);
    const int byte = graph.input({false, 8});
    std::vector<int> bits{a, b, graph.bit(false), graph.bit(true)};
    std::vector<int> bytes{byte, graph.constant({false, 8}, random.word())};
    const auto any = [&](const std::vector<int>& from) { return from.at(random.below(from.size())); };
    // The same operations without a graph: a value beside each register.
    for (int k = 0; k < 12; ++k) {
      const int x = any(bits);
      const int y = any(bits);
      const int wide = graph.make(random.below(2) == 0 ? Operation::zext : Operation::sext, {false, 8}, {x});
      bytes.push_back(wide);
      const Predicate predicate = random.below(2) == 0 ? Predicate::eq : Predicate::ne;
      const int zero = graph.constant({false, 8}, 0);
      const std::array made{graph.both(x, y),
                            graph.negated(x),
                            graph.select(any(bits), x, y),
                            graph.make(Operation::bit_or, kBit, {x, y}),
                            graph.make(Operation::icmp, kBit, {any(bytes), zero}, predicate),
                            graph.make(Operation::integer_trunc, kBit, {any(bytes)})};
      const std::uint64_t u = evaluated(graph, x, inputs);
      const std::uint64_t v = evaluated(graph, y, inputs);
      CHECK(evaluated(graph, made[0], inputs) == (u & v));
      CHECK(evaluated(graph, made[1], inputs) == 1 - u);
      CHECK(evaluated(graph, made[3], inputs) == (u | v));
      const int one_of = any(bits);
      CHECK(evaluated(graph, graph.select(one_of, x, y), inputs) ==
            (evaluated(graph, one_of, inputs) != 0 ? u : v));
      const int some = any(bytes);
      const bool is_zero = evaluated(graph, some, inputs) == 0;
      CHECK((evaluated(graph, graph.make(Operation::icmp, kBit, {some, zero}, predicate), inputs) != 0) ==
            (is_zero == (predicate == Predicate::eq)));
      CHECK(evaluated(graph, graph.make(Operation::integer_trunc, kBit, {some}), inputs) ==
            (evaluated(graph, some, inputs) & 1U));
      bits.insert(bits.end(), made.begin(), made.end());
    }
  }
}

TEST_CASE("What the library computes stays an operation") {
  Graph graph;
  const int angle = graph.number(kSingle, 0.5);
  const int sine = graph.make(Operation::sin, kSingle, {angle});
  CHECK(!graph.is_known(sine));
  CHECK(graph.is_free_of_inputs(sine));
  CHECK(graph.computed_here(sine) == trackers::code::bits_of(kSingle, std::sin(0.5F)));
  const int state = graph.input(kSingle);
  CHECK(!graph.is_free_of_inputs(graph.make(Operation::fadd, kSingle, {sine, state})));
}

TEST_CASE("Signs of zero, and of what is no number, are kept") {
  Graph graph;
  const int x = graph.input(kSingle);
  const int zero = graph.number(kSingle, 0.0);
  const int minus_zero = graph.number(kSingle, -0.0);
  CHECK(zero != minus_zero);
  CHECK(graph.make(Operation::fadd, kSingle, {x, zero}) != x);  // -0 + 0 is 0
  CHECK(graph.make(Operation::fsub, kSingle, {x, zero}) != x);
  CHECK(graph.make(Operation::fmul, kSingle, {x, graph.number(kSingle, 1.0)}) != x);
  CHECK(graph.make(Operation::fsub, kSingle, {zero, x}) != graph.make(Operation::fneg, kSingle, {x}));
  CHECK(!graph.is_known(graph.make(Operation::fcmp, kBit, {x, x}, Predicate::oeq)));
}

TEST_CASE("Undefined results are 0, divisions by 0 errors") {
  Graph graph;
  const Format format{false, 32};
  const int seven = graph.constant(format, 7);
  const int zero = graph.constant(format, 0);
  CHECK(graph.make(Operation::shl, format, {seven, graph.constant(format, 32)}) == zero);
  CHECK(graph.make(Operation::fptosi, format, {graph.number(kDouble, 1e10)}) == zero);
  CHECK_THROWS_AS((void)graph.make(Operation::sdiv, format, {seven, zero}), LiftError);
  CHECK_THROWS_AS((void)graph.make(Operation::urem, format, {seven, zero}), LiftError);
}

}  // namespace veritrack::lift
