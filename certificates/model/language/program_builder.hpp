// Programs written by programs: terms that know when they are 0 or 1, and derivatives by the chain rule.
#pragma once

#include <vector>

#include "certificates/model/language/compiler.hpp"

namespace veritrack::certificates::language {

/// The result of an instruction, or 0 or 1, which take none.
class Term {
 public:
  [[nodiscard]] static Term zero() { return Term(kZero); }
  [[nodiscard]] static Term one() { return Term(kOne); }
  [[nodiscard]] static Term of_register(int place) { return Term(place); }
  [[nodiscard]] bool is_zero() const { return place_ == kZero; }
  [[nodiscard]] bool is_one() const { return place_ == kOne; }
  [[nodiscard]] int place() const { return place_; }

 private:
  static constexpr int kZero = -1;
  static constexpr int kOne = -2;
  explicit Term(int place) : place_(place) {}
  int place_;
};

/// A term and its derivatives with respect to some states.
struct Differentiated {
  Term value = Term::zero();
  std::vector<Term> derivatives;
};

/// Appends instructions to a program. Every instruction is given the place in the file that was set last.
class ProgramBuilder {
 public:
  ProgramBuilder(const Constants& constants, int other_inputs);

  void set_position(Position position) { position_ = position; }
  [[nodiscard]] Term add(Term a, Term b);
  [[nodiscard]] Term subtract(Term a, Term b);
  [[nodiscard]] Term multiply(Term a, Term b);
  [[nodiscard]] Term divide(Term a, Term b);
  [[nodiscard]] Term negate(Term a);
  /// The literal of that text, which must be one of the constants. Throws std::logic_error otherwise.
  [[nodiscard]] Term literal(const std::string& text) const;

  /// The results of a program whose inputs behind the constants are `inputs`, with their derivatives.
  [[nodiscard]] std::vector<Differentiated> run(const CompiledProgram& compiled,
                                                const std::vector<Differentiated>& inputs);

  void name(Term term, const std::string& name);
  void add_result(Term term);
  [[nodiscard]] CompiledProgram take() { return std::move(result_); }

 private:
  [[nodiscard]] Term append(const trackers::Instruction& instruction);
  [[nodiscard]] Term apply(trackers::Operation operation, Term a);
  /// The register of a term; 0 and 1 are literals.
  [[nodiscard]] int place_of(Term term) const;
  [[nodiscard]] Differentiated differentiate(const trackers::Instruction& instruction,
                                             const std::vector<Differentiated>& registers);
  /// A value and its derivative.
  struct Slope {
    Term value, derivative;
  };
  [[nodiscard]] Term derivative_of(const trackers::Instruction& instruction, Term value, const Slope& first,
                                   const Slope& second);
  /// The derivatives of functions with kinks.
  [[nodiscard]] Differentiated derivatives_by_branch(const trackers::Instruction& instruction, Term value,
                                                     const std::vector<const Differentiated*>& operands);
  /// `a` where `positive` is above 0, else `b`.
  [[nodiscard]] Term choose(Term positive, Term a, Term b);
  [[nodiscard]] Term square(Term a);
  /// n x^(n - 1).
  [[nodiscard]] Term slope_of_power(Term base, int exponent);

  const Constants* constants_;
  CompiledProgram result_;
  Position position_;
};

}  // namespace veritrack::certificates::language
