#include "lift/memory.hpp"

#include <doctest/doctest.h>
#include <llvm/IR/LLVMContext.h>
#include <llvm/IR/Type.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/random.hpp"

namespace veritrack::lift {

namespace {

using trackers::code::kBit;
using trackers::code::kSingle;

/// Memory with one object of 16 bytes.
struct Fixture {
  llvm::LLVMContext context;
  llvm::DataLayout layout{"e-m:e-i64:64-f80:128-n8:16:32:64-S128"};
  Graph graph;
  Memory memory{graph, layout};
  int object = memory.add({"k", nullptr, false, false, 16, false});

  [[nodiscard]] llvm::Type* integer(int bytes) {
    return llvm::Type::getIntNTy(context, static_cast<unsigned>(8 * bytes));
  }
  [[nodiscard]] Value at(std::int64_t offset) const { return Address{object, offset, -1, 0}; }
  void store(std::int64_t offset, int bytes, std::uint64_t bits) {
    memory.store(at(offset), integer(bytes), Register{graph.constant({false, 8 * bytes}, bits)});
  }
  [[nodiscard]] std::uint64_t load(std::int64_t offset, int bytes) {
    const Value value = memory.load(at(offset), integer(bytes));
    return graph.bits(value.as<Register>()->number);
  }
};

}  // namespace

TEST_CASE("Known bytes are kept, however they are written and read") {
  test::Random random;
  for (int i = 0; i < test::effort(300); ++i) {
    Fixture fixture;
    std::vector<std::uint8_t> bytes(16, 0);
    fixture.memory.fill_with_zeros(fixture.object, 0, 16);
    for (int k = 0; k < 12; ++k) {
      const int size = 1 << random.below(4);
      const auto offset = static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(17 - size)));
      const std::uint64_t word = random.word();
      if (random.below(4) == 0) {
        fixture.memory.set(fixture.at(offset), 0, size);
        std::fill_n(bytes.begin() + offset, size, std::uint8_t{0});
      } else {
        fixture.store(offset, size, word);
        for (int b = 0; b < size; ++b) {
          bytes[static_cast<std::size_t>(offset + b)] = static_cast<std::uint8_t>(word >> (8 * b));
        }
      }
      const int read = 1 << random.below(4);
      const auto from = static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(17 - read)));
      std::uint64_t expected = 0;
      for (int b = 0; b < read; ++b) {
        expected |= std::uint64_t{bytes[static_cast<std::size_t>(from + b)]} << (8 * b);
      }
      CHECK(fixture.load(from, read) == expected);
    }
  }
}

TEST_CASE("A part of what is not known is neither read nor written") {
  Fixture fixture;
  const int state = fixture.graph.input(kSingle);
  llvm::Type* single = llvm::Type::getFloatTy(fixture.context);
  fixture.memory.store(fixture.at(4), single, Register{state});
  CHECK(fixture.memory.load(fixture.at(4), single) == Value(Register{state}));
  CHECK_THROWS_AS((void)fixture.memory.load(fixture.at(4), fixture.integer(2)), LiftError);
  CHECK_THROWS_AS((void)fixture.memory.load(fixture.at(0), fixture.integer(8)), LiftError);
  CHECK_THROWS_AS(fixture.store(7, 1, 0), LiftError);
  CHECK_THROWS_AS(fixture.store(2, 4, 0), LiftError);
  CHECK_THROWS_AS(fixture.memory.set(fixture.at(0), 0, 6), LiftError);
  fixture.store(0, 8, 5);  // as a whole it may be
  CHECK(fixture.load(0, 8) == 5);
  CHECK(fixture.memory.load(fixture.at(8), fixture.integer(8)).is_undefined());
}

TEST_CASE("Nothing is read or written outside of an object, or after its end") {
  Fixture fixture;
  fixture.memory.fill_with_zeros(fixture.object, 0, 16);
  CHECK_THROWS_AS((void)fixture.load(13, 4), LiftError);
  CHECK_THROWS_AS((void)fixture.load(-1, 1), LiftError);
  CHECK_THROWS_AS(fixture.store(16, 1, 0), LiftError);
  CHECK_THROWS_AS(fixture.memory.copy(fixture.at(8), fixture.at(0), 9), LiftError);
  CHECK_THROWS_AS(fixture.memory.set(fixture.at(8), 0, 9), LiftError);
  CHECK_THROWS_AS((void)fixture.memory.load(Address{}, fixture.integer(4)), LiftError);
  fixture.memory.end(fixture.object);
  CHECK_THROWS_AS((void)fixture.load(0, 4), LiftError);
  CHECK_THROWS_AS(fixture.store(0, 4, 0), LiftError);
}

TEST_CASE("Copies of overlapping bytes") {
  Fixture fixture;
  for (int i = 0; i < 4; ++i) {
    fixture.store(4 * i, 4, static_cast<std::uint64_t>(i + 1));
  }
  fixture.memory.copy(fixture.at(4), fixture.at(0), 12);
  CHECK(fixture.load(0, 4) == 1);
  CHECK(fixture.load(4, 4) == 1);
  CHECK(fixture.load(8, 4) == 2);
  CHECK(fixture.load(12, 4) == 3);
}

TEST_CASE("Two ways meet, with cells of two sizes") {
  test::Random random;
  for (int i = 0; i < test::effort(200); ++i) {
    Fixture fixture;
    const int condition = fixture.graph.input(kBit);
    fixture.memory.fill_with_zeros(fixture.object, 0, 16);
    const Memory::Contents before = fixture.memory.contents();
    const auto write = [&] {
      for (std::uint64_t k = 0; k <= random.below(3); ++k) {
        const int size = 1 << random.below(4);
        fixture.store(static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(17 - size))), size,
                      random.word());
      }
      return fixture.memory.contents();
    };
    const Memory::Contents yes = write();
    fixture.memory.restore(before);
    const Memory::Contents no = write();
    fixture.memory.merge(condition, yes, no);
    const Memory::Contents merged = fixture.memory.contents();
    for (const auto& [offset, cell] : *merged.back()) {
      const int number = cell.value.as<Register>()->number;
      const Instruction instruction = fixture.graph.at(number);
      const auto size = static_cast<int>(cell.size);
      const bool is_one = instruction.operation == Operation::constant;
      fixture.memory.restore(yes);
      CHECK(fixture.load(offset, size) == fixture.graph.bits(is_one ? number : instruction.operands[1]));
      fixture.memory.restore(no);
      CHECK(fixture.load(offset, size) == fixture.graph.bits(is_one ? number : instruction.operands[2]));
    }
    std::int64_t bytes = 0;
    for (const auto& [offset, cell] : *merged.back()) {
      CHECK(offset == bytes);
      bytes += cell.size;
    }
    CHECK(bytes == 16);
  }
}

TEST_CASE("Two ways of which one is not known") {
  Fixture fixture;
  const int condition = fixture.graph.input(kBit);
  const int wide = fixture.graph.input({false, 64});
  const int narrow = fixture.graph.input({false, 16});
  fixture.memory.fill_with_zeros(fixture.object, 0, 16);
  const Memory::Contents zeros = fixture.memory.contents();
  fixture.memory.store(fixture.at(0), fixture.integer(8), Register{wide});
  const Memory::Contents with_wide = fixture.memory.contents();
  fixture.memory.merge(condition, with_wide, zeros);
  const Value merged = fixture.memory.load(fixture.at(0), fixture.integer(8));
  CHECK(merged ==
        Value(Register{fixture.graph.select(condition, wide, fixture.graph.constant({false, 64}, 0))}));
  fixture.memory.restore(zeros);
  fixture.memory.store(fixture.at(2), fixture.integer(2), Register{narrow});
  const Memory::Contents with_narrow = fixture.memory.contents();
  fixture.memory.merge(condition, zeros, with_narrow);
  CHECK(fixture.memory.load(fixture.at(2), fixture.integer(2)) ==
        Value(Register{fixture.graph.select(condition, fixture.graph.constant({false, 16}, 0), narrow)}));
  CHECK(fixture.load(0, 2) == 0);
  CHECK_THROWS_AS(fixture.memory.merge(condition, with_wide, with_narrow), LiftError);
}

TEST_CASE("A write through one of two addresses that are the same") {
  Fixture fixture;
  const int condition = fixture.graph.input(kBit);
  fixture.store(0, 4, 1);
  fixture.store(4, 4, 2);
  const Value first = fixture.at(0);
  const Value second = fixture.memory.select(condition, fixture.at(0), fixture.at(4));
  const int other = fixture.graph.input(kBit);
  const Value place = fixture.memory.select(other, second, first);
  fixture.memory.store(place, fixture.integer(4), Register{fixture.graph.constant({false, 32}, 9)});
  // Where `condition` is 1 both are the first place, and it is written.
  const Value value = fixture.memory.load(first, fixture.integer(4));
  for (const std::uint64_t c : {0U, 1U}) {
    for (const std::uint64_t o : {0U, 1U}) {
      const auto evaluated = [&](int number, const auto& self) -> std::uint64_t {
        const Instruction& of = fixture.graph.at(number);
        if (number == condition || number == other) {
          return number == condition ? c : o;
        }
        if (of.operation == Operation::constant) {
          return of.bits;
        }
        if (of.operation == Operation::bit_xor) {
          return self(of.operands[0], self) ^ self(of.operands[1], self);
        }
        REQUIRE(of.operation == Operation::select);
        return self(self(of.operands[0], self) != 0 ? of.operands[1] : of.operands[2], self);
      };
      const bool is_written = o == 0 || c == 1;
      CHECK(evaluated(value.as<Register>()->number, evaluated) == (is_written ? 9U : 1U));
    }
  }
}

}  // namespace veritrack::lift
