// Designs with code, written in the tests: a listing, and the recursion that is compared with it.
#pragma once

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "checker/code/code_certificate.hpp"
#include "checker/document/json_tree.hpp"
#include "checker/model/formula.hpp"

namespace veritrack::test {

/// The text with one place changed, which must be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from);
  return text.replace(at, from.size(), to);
}

struct CodeDesign {
  std::string listing;
  std::vector<std::string> samples, states, angles;
  std::string step, frequency;

  [[nodiscard]] nlohmann::json json() const {
    const std::string digest(64, 'a');
    return {{"model",
             {{"samples", samples},
              {"states", states},
              {"angles", angles},
              {"step", step},
              {"frequency", frequency}}},
            {"code",
             {{"files", {{{"name", "loop.c"}, {"sha256", digest}}}},
              {"included", nlohmann::json::array()},
              {"flags", nlohmann::json::array()},
              {"compiler", "clang"},
              {"listing", listing}}}};
  }
  /// Whether its angles keep their ranges when they are rounded, too.
  [[nodiscard]] bool may_be_rounded() const {
    checker::Objections objections;
    return checker::check_code(checker::read_json(json().dump()), objections).angles && objections.empty();
  }
  /// The first objection; empty: verified.
  [[nodiscard]] std::string objection() const {
    checker::Objections objections;
    try {
      checker::check_code(checker::read_json(json().dump()), objections);
    } catch (const checker::Malformed& error) {
      return std::string("malformed: ") + error.what();
    } catch (const checker::FormulaError& error) {
      return std::string("malformed: ") + error.what();
    }
    return objections.empty() ? "" : objections.front();
  }
};

inline const std::string kPi = "f32:0x1.921fb6p+1";
inline const std::string kMinusPi = "f32:-0x1.921fb6p+1";
inline const std::string kTurn = "f32:0x1.921fb6p+2";
inline const std::string kMinusTurn = "f32:-0x1.921fb6p+2";

/// One channel: an angle that is wrapped, and a frequency between limits.
inline CodeDesign loop() {
  return {
      "veritrack listing 1\n"
      "file 0 loop.c\n"
      "sample r0 f32 y\n"
      "state r1 f32:0x0p+0 theta\n"
      "state r2 f32:0x1p-2 w\n"
      "r3 = sin.f32 r1 @0:3:4\n"
      "r4 = fmul.f32 r0 r3\n"
      "r5 = fmul.f32 r4 f32:-0x1.99999ap-5\n"
      "r6 = fadd.f32 r2 r5\n"
      "r7 = fadd.f32 r1 r6\n"
      "r8 = fcmp.ogt.f32 r7 " +
          kPi +
          "\n"
          "r9 = fadd.f32 r7 " +
          kMinusTurn +
          "\n"
          "r10 = select.f32 r8 r9 r7\n"
          "r11 = fcmp.olt.f32 r10 " +
          kMinusPi +
          "\n"
          "r12 = fadd.f32 r10 " +
          kTurn +
          "\n"
          "r13 = select.f32 r11 r12 r10\n"
          "r14 = fcmp.olt.f32 r6 f32:0x1p-4\n"
          "r15 = select.f32 r14 f32:0x1p-4 r6\n"
          "r16 = fcmp.ogt.f32 r15 f32:0x1p+0\n"
          "r17 = select.f32 r16 f32:0x1p+0 r15\n"
          "r18 = fcmp.ogt.f32 r9 " +
          kPi +
          "\n"
          "r19 = and.i1 r18 r8\n"
          "next r1 r13\n"
          "next r2 r17\n"
          "frequency r2\n"
          "must-be-zero r19 @0:5:1 a loop has ended\n",
      {"y"},
      {"theta", "w"},
      {"theta"},
      "e = y*sin(theta)*(-0.0500000007450580596923828125)\n"
      "turn1 = stays_within(w + e, -pi, pi)\n"
      "theta' = theta + w + e\n"
      "w' = clamp(w + e, 0.0625, 1)\n",
      "w"};
}

/// Two channels: the angle of the signal beside that of the loop, wrapped, as a number.
inline CodeDesign detector() {
  return {
      "veritrack listing 1\n"
      "sample r0 f32 a\n"
      "sample r1 f32 b\n"
      "state r2 f32:0x0p+0 theta\n"
      "state r3 f32:0x0p+0 w\n"
      "r4 = atan2.f32 r1 r0\n"
      "r5 = fsub.f32 r4 r2\n"
      "r6 = fcmp.ogt.f32 r5 " +
          kPi +
          "\n"
          "r7 = fadd.f32 r5 " +
          kMinusTurn +
          "\n"
          "r8 = select.f32 r6 r7 r5\n"
          "r9 = fcmp.olt.f32 r8 " +
          kMinusPi +
          "\n"
          "r10 = fadd.f32 r8 " +
          kTurn +
          "\n"
          "r11 = select.f32 r9 r10 r8\n"
          "r12 = fcmp.uno.f32 r11 f32:0x0p+0\n"
          "r13 = fmul.f32 r11 f32:0x1p-3\n"
          "r14 = fadd.f32 r2 r13\n"
          "r15 = fcmp.ogt.f32 r14 " +
          kPi +
          "\n"
          "r16 = fadd.f32 r14 " +
          kMinusTurn +
          "\n"
          "r17 = fcmp.olt.f32 r14 " +
          kMinusPi +
          "\n"
          "r18 = fadd.f32 r14 " +
          kTurn +
          "\n"
          "r19 = select.f32 r17 r18 r14\n"
          "r20 = select.f32 r15 r16 r19\n"
          "r21 = fmul.f32 f32:0x1p-6 r11\n"
          "r22 = fsub.f32 r3 r21\n"
          "r23 = select.f32 r12 r2 r20\n"
          "r24 = select.f32 r12 r3 r22\n"
          "next r2 r23\n"
          "next r3 r24\n"
          "frequency r3\n",
      {"a", "b"},
      {"theta", "w"},
      {"theta"},
      "e = atan2(b*cos(theta) - a*sin(theta), a*cos(theta) + b*sin(theta))\n"
      "theta' = theta + e*0.125\n"
      "w' = w - 0.015625*e\n",
      "w"};
}

/// A state x and a sample y, and operations from r2 on.
inline CodeDesign function(const std::string& operations, const std::string& result,
                           const std::string& formula) {
  return {"veritrack listing 1\nsample r0 f64 y\nstate r1 f64:0x0p+0 x\n" + operations + "next r1 " + result +
              "\nfrequency r1\n",
          {"y"},
          {"x"},
          {},
          "x' = " + formula + "\n",
          "x"};
}

}  // namespace veritrack::test
