// Programs and listings that are equal, and every change of either, which has to be found.
#include "certificates/model/tie/comparison.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "tests/certificates/model/tie/tie_support.hpp"

namespace veritrack::certificates::tie {

namespace {

using trackers::code::Instruction;
using trackers::code::Listing;
using trackers::code::Operation;
using trackers::code::Predicate;

struct Function {
  std::string file;
  std::map<std::string, std::string> expressions;
};

std::vector<Function> functions_of_the_lifter() {
  std::map<std::string, std::string> ages;
  for (int age = 1; age <= 5; ++age) {
    ages[fmt::format("line.past_._M_elems_{}_ago", age)] =
        fmt::format("line.past_._M_elems[(line.at_ + 5 - {}) % 5]", age);
  }
  return {{"chosen_detector.cpp", {{"memory_of_line_1065_12", "((Limited*)detector.get())->mean_"}}},
          {"constant_table.c", {}},
          {"delay_line.cpp", ages},
          {"double_literals.c", {}},
          {"integer_oscillator.c", {}},
          {"lock_counter.c", {}},
          {"motor_pll.c", {}},
          {"optional_result.cpp", {}},
          {"sine_table.c", {}}};
}

/// What an operation may become by mistake, so that its result is another for most operands.
std::vector<Instruction> changes_of(const Instruction& instruction) {
  std::vector<Instruction> changes;
  const auto add = [&](const auto& change) {
    changes.push_back(instruction);
    change(changes.back());
  };
  switch (instruction.operation) {
    case Operation::fadd:
      add([](Instruction& each) { each.operation = Operation::fsub; });
      break;
    case Operation::fsub:
      add([](Instruction& each) { each.operation = Operation::fadd; });
      add([](Instruction& each) { std::swap(each.operands[0], each.operands[1]); });
      break;
    case Operation::fmul:
      add([](Instruction& each) { each.operation = Operation::fdiv; });
      break;
    case Operation::cos:
      add([](Instruction& each) { each.operation = Operation::sin; });
      break;
    case Operation::select:
      add([](Instruction& each) { std::swap(each.operands[1], each.operands[2]); });
      break;
    case Operation::fcmp:
      add([](Instruction& each) {
        each.predicate = each.predicate == Predicate::ogt ? Predicate::olt : Predicate::ogt;
      });
      break;
    case Operation::constant:
      if (instruction.format.is_float &&
          trackers::code::number_of(instruction.format, instruction.bits) != 0) {
        add([](Instruction& each) { each.bits += 1; });
      }
      break;
    default:
      break;
  }
  return changes;
}

}  // namespace

TEST_CASE("the functions of the lifter's tests are equal to their listings") {
  for (const Function& function : functions_of_the_lifter()) {
    CAPTURE(function.file);
    const std::filesystem::path folder = std::filesystem::path(VERITRACK_SOURCE_DIR) / "tests/lift/functions";
    code::CodeTable table;
    const bool is_cpp = function.file.find(".cpp") != std::string::npos;
    table.files.push_back({function.file, {1, 1}});
    if (is_cpp) {
      table.flags.push_back({"-std=c++17", {1, 1}});
    }
    const Listing listing = code::compiled(table, folder / "design.toml").listing;
    Sources sources = sources_of(table, listing, folder / "design.toml");
    sources.expressions = function.expressions;
    const DrawnSteps drawn = some_steps(listing);
    CHECK(drawn.steps.size() == 1000);
    const BuiltProgram program(sources, is_cpp ? "g++ -O2" : "gcc -O2", "");
    const BuildResult result = compared(listing, program, drawn.steps);
    CHECK(result.is_equal());
    CHECK(result.compared == 1000);
  }
}

TEST_CASE("every changed operation of a listing is found") {
  const OneFile file(kLoop);
  const BuiltProgram program(file.sources(), "gcc -O2", "");
  REQUIRE(compared(file.listing(), program, some_steps(file.listing()).steps).is_equal());
  int count = 0;
  for (std::size_t i = 0; i < file.listing().instructions.size(); ++i) {
    for (const Instruction& change : changes_of(file.listing().instructions[i])) {
      CAPTURE(i);
      CAPTURE(static_cast<int>(change.operation));
      Listing changed = file.listing();
      if (change.operation == Operation::sin) {  // of this, the program has not been asked for results
        continue;
      }
      changed.instructions[i] = change;
      const BuildResult result = compared(changed, program, some_steps(changed).steps);
      CHECK_FALSE(result.is_equal());
      CHECK(result.different > 0);
      ++count;
    }
  }
  CHECK(count > 12);
}

TEST_CASE(
    "every change of the source between listing and build is found, with the state that differs first") {
  const OneFile file(kLoop);
  const std::vector<StepInput> steps = some_steps(file.listing()).steps;
  const struct {
    const char* flag;
    const char* state;
  } changes[] = {{"-DGAIN=0.10000001f", "theta"},
                 {"-DPLUS=-", "w"},
                 {"-DLIMIT=w>=0.99999994f", "w"},
                 {"-DLIMIT=w>1.0000001f", "w"},
                 {"-DORDER=theta+(w+GAIN*e)", "theta"}};
  for (const auto& change : changes) {
    CAPTURE(change.flag);
    const BuiltProgram program(file.sources(), std::string("gcc -O2 ") + change.flag, "");
    const BuildResult result = compared(file.listing(), program, steps);
    REQUIRE(result.first);
    bool is_found = false;
    for (std::size_t i = 0; i < file.listing().states.size(); ++i) {
      is_found = is_found || (file.listing().states[i].name == change.state && result.largest[i] > 0.0);
    }
    CHECK(is_found);
    CHECK(result.compared == 1000);
    CHECK_FALSE(result.first->is_start);
  }
}

TEST_CASE("what setup leaves is compared") {
  const OneFile file(
      "static float w;\n#ifndef W\n#define W 0.3f\n#endif\nvoid setup(void) { w = W; }\n"
      "void step(float y) { w += 0.1f * y; }\nfloat frequency(void) { return w; }\n");
  const BuiltProgram program(file.sources(), "gcc -O2 -DW=0.30000001f", "");
  const BuildResult same = compared(file.listing(), program, some_steps(file.listing()).steps);
  CHECK(same.is_equal());  // both are the same number in single precision
  const BuiltProgram other(file.sources(), "gcc -O2 -DW=0.30000004f", "");
  const BuildResult result = compared(file.listing(), other, some_steps(file.listing()).steps);
  REQUIRE(result.first);
  CHECK(result.first->is_start);
  CHECK(result.differs_at_start);
  CHECK(result.different == 0);
}

TEST_CASE("states in which an obligation is not kept are not run") {
  const OneFile file(
      "static float w;\nvoid setup(void) { w = 0.3f; }\nvoid step(float y) {\n  float angle = w + 0.1f * "
      "y;\n  "
      "while (angle > 3.0f) angle -= 6.0f;\n  w = angle;\n}\nfloat frequency(void) { return w; }\n");
  const DrawnSteps drawn = some_steps(file.listing(), 500);
  CHECK_FALSE(drawn.left_out.empty());
  std::vector<StepInput> steps = drawn.steps;
  const std::size_t before = steps.size();
  StepInput far = steps.front();
  far.states.front() = trackers::code::bits_of(trackers::code::kSingle, 1e30);  // where the loop does not end
  steps.push_back(far);
  const BuiltProgram program(file.sources(), "gcc -O2", "");
  const BuildResult result = compared(file.listing(), program, steps);
  CHECK(result.is_equal());
  CHECK(result.compared == static_cast<int>(before));
  REQUIRE(result.left_out.size() == 1);
  CHECK(result.left_out.begin()->second == 1);
}

TEST_CASE("numbers that are none are equal to each other") {
  const std::uint64_t nan = 0x7fc00000;
  CHECK(are_equal(trackers::code::kSingle, nan, nan + 1));
  CHECK_FALSE(are_equal(trackers::code::kSingle, nan, 0));
  CHECK_FALSE(are_equal(trackers::code::kSingle, 0, 0x80000000));  // 0 and -0
  CHECK_FALSE(are_equal(trackers::code::Format{false, 32}, nan, nan + 1));
}

}  // namespace veritrack::certificates::tie
