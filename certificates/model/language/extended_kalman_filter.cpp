#include "certificates/model/language/extended_kalman_filter.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <set>
#include <utility>

#include "certificates/model/language/program_builder.hpp"

namespace veritrack::certificates::language {

namespace {

/// A matrix of terms, row by row.
using TermMatrix = std::vector<std::vector<Term>>;

TermMatrix zeros(std::size_t rows, std::size_t columns) {
  return TermMatrix(rows, std::vector<Term>(columns, Term::zero()));
}

/// Writes the filter's equations.
class FilterWriter {
 public:
  FilterWriter(const FilterModel& model, const Constants& constants, const std::vector<std::string>& samples)
      : model_(&model),
        constants_(&constants),
        samples_(&samples),
        states_(model.states.size()),
        builder_(constants, static_cast<int>(filter_states(model.states).size() + samples.size())) {}

  [[nodiscard]] CompiledProgram write(Position place) {
    const bool by_the_chain_rule = model_->jacobian.empty();
    std::vector<Differentiated> predicted =
        builder_.run(compile_step(model_->predict, *constants_, model_->states, {}, place),
                     by_the_chain_rule ? with_unit_derivatives(estimates()) : estimates());
    if (!by_the_chain_rule) {
      set_derivatives(predicted);
    }
    for (std::size_t i = 0; i < states_; ++i) {
      builder_.name(predicted[i].value, model_->states[i] + ".predicted");
    }
    builder_.set_position(place);
    const TermMatrix covariance = predicted_covariance(predicted);
    std::vector<const Expression*> formulas;
    for (const Expression& formula : model_->measure) {
      formulas.push_back(&formula);
    }
    const std::vector<Differentiated> measured = builder_.run(
        compile_formulas(formulas, *constants_, model_->states), with_unit_derivatives(predicted));
    builder_.set_position(place);
    update(predicted, covariance, measured);
    return builder_.take();
  }

 private:
  [[nodiscard]] Term input(std::size_t number) const {
    return Term::of_register(static_cast<int>(constants_->size() + number));
  }
  [[nodiscard]] static std::vector<Differentiated> with_unit_derivatives(std::vector<Differentiated> terms) {
    for (std::size_t i = 0; i < terms.size(); ++i) {
      terms[i].derivatives.assign(terms.size(), Term::zero());
      terms[i].derivatives[i] = Term::one();
    }
    return terms;
  }
  [[nodiscard]] std::vector<Differentiated> estimates() const {
    std::vector<Differentiated> terms(states_);
    for (std::size_t i = 0; i < states_; ++i) {
      terms[i].value = input(i);
    }
    return terms;
  }
  /// The given F.
  void set_derivatives(std::vector<Differentiated>& predicted) {
    for (std::size_t i = 0; i < states_; ++i) {
      for (const Expression& formula : model_->jacobian[i]) {
        predicted[i].derivatives.push_back(term_of(formula, model_->states, estimates()));
      }
    }
  }
  /// A formula of these inputs; 0 and 1 are left out of sums and products.
  [[nodiscard]] Term term_of(const Expression& formula, const std::vector<std::string>& names,
                             const std::vector<Differentiated>& inputs) {
    if (formula.kind == Expression::Kind::number &&
        formula.text.find_first_not_of("0.") == std::string::npos) {
      return Term::zero();
    }
    return formula.text == "1"
               ? Term::one()
               : builder_.run(compile_formulas({&formula}, *constants_, names), inputs).front().value;
  }
  /// An entry of Q or R.
  [[nodiscard]] Term entry(const Expression& formula) { return term_of(formula, {}, {}); }
  /// sum_k a_k b_k.
  [[nodiscard]] Term dot(const std::vector<Term>& a, const std::vector<Term>& b) {
    Term sum = Term::zero();
    for (std::size_t k = 0; k < a.size(); ++k) {
      sum = builder_.add(sum, builder_.multiply(a[k], b[k]));
    }
    return sum;
  }

  /// F P F' + Q.
  [[nodiscard]] TermMatrix predicted_covariance(const std::vector<Differentiated>& predicted) {
    TermMatrix covariance = zeros(states_, states_);
    std::size_t number = states_;
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t j = i; j < states_; ++j) {
        covariance[i][j] = covariance[j][i] = input(number++);
      }
    }
    TermMatrix product = zeros(states_, states_);  // F P
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t j = 0; j < states_; ++j) {
        product[i][j] = dot(predicted[i].derivatives, covariance[j]);
      }
    }
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t j = i; j < states_; ++j) {
        const Term propagated = dot(product[i], predicted[j].derivatives);
        covariance[i][j] = covariance[j][i] = builder_.add(propagated, entry(model_->process_noise[i][j]));
        builder_.name(covariance[i][j],
                      fmt::format("P.{}.{}.predicted", model_->states[i], model_->states[j]));
      }
    }
    return covariance;
  }

  /// The inverse of a symmetric 2x2 matrix.
  [[nodiscard]] TermMatrix inverse(const TermMatrix& s) {
    // One after the other: arguments of a call are evaluated in an order of the compiler's choice.
    const Term square = builder_.multiply(s[0][1], s[1][0]);
    const Term determinant = builder_.subtract(builder_.multiply(s[0][0], s[1][1]), square);
    builder_.name(determinant, "S.determinant");
    const Term off_diagonal = builder_.negate(builder_.divide(s[0][1], determinant));
    return {{builder_.divide(s[1][1], determinant), off_diagonal},
            {off_diagonal, builder_.divide(s[0][0], determinant)}};
  }

  void update(const std::vector<Differentiated>& predicted, const TermMatrix& covariance,
              const std::vector<Differentiated>& measured) {
    const std::size_t channels = samples_->size();
    TermMatrix cross = zeros(channels, states_);  // H P
    TermMatrix innovation_covariance = zeros(channels, channels);
    std::vector<Term> innovation;
    for (std::size_t c = 0; c < channels; ++c) {
      for (std::size_t j = 0; j < states_; ++j) {
        cross[c][j] = dot(measured[c].derivatives, covariance[j]);
      }
      for (std::size_t d = 0; d <= c; ++d) {
        const Term noise = entry(model_->measurement_noise[c][d]);
        const Term term = builder_.add(dot(cross[c], measured[d].derivatives), noise);
        innovation_covariance[c][d] = innovation_covariance[d][c] = term;
        builder_.name(term, fmt::format("S.{}.{}", (*samples_)[d], (*samples_)[c]));
      }
      innovation.push_back(
          builder_.subtract(input(filter_states(model_->states).size() + c), measured[c].value));
      builder_.name(innovation.back(), "innovation." + (*samples_)[c]);
    }
    const TermMatrix weight = channels > 1 ? inverse(innovation_covariance) : TermMatrix{};
    TermMatrix gain = zeros(states_, channels);
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t c = 0; c < channels; ++c) {
        // One channel: a quotient, not the product with a reciprocal.
        gain[i][c] = channels == 1 ? builder_.divide(cross[0][i], innovation_covariance[0][0]) : Term::zero();
        for (std::size_t d = 0; d < channels && channels > 1; ++d) {
          gain[i][c] = builder_.add(gain[i][c], builder_.multiply(cross[d][i], weight[d][c]));
        }
        builder_.name(gain[i][c], fmt::format("K.{}.{}", model_->states[i], (*samples_)[c]));
      }
    }
    for (std::size_t i = 0; i < states_; ++i) {
      builder_.add_result(builder_.add(predicted[i].value, dot(gain[i], innovation)));
    }
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t j = i; j < states_; ++j) {
        Term reduction = Term::zero();
        for (std::size_t c = 0; c < channels; ++c) {
          reduction = builder_.add(reduction, builder_.multiply(gain[i][c], cross[c][j]));
        }
        builder_.add_result(builder_.subtract(covariance[i][j], reduction));
      }
    }
  }

  const FilterModel* model_;
  const Constants* constants_;
  const std::vector<std::string>* samples_;
  std::size_t states_;
  ProgramBuilder builder_;
};

void collect_exponents(const Expression& expression, std::set<int>& exponents) {
  if (expression.kind == Expression::Kind::power) {
    exponents.insert(expression.exponent);
  }
  for (const Expression& operand : expression.operands) {
    collect_exponents(operand, exponents);
  }
}

}  // namespace

std::vector<std::string> filter_states(const std::vector<std::string>& states) {
  std::vector<std::string> all = states;
  for (std::size_t i = 0; i < states.size(); ++i) {
    for (std::size_t j = i; j < states.size(); ++j) {
      all.push_back(fmt::format("P.{}.{}", states[i], states[j]));
    }
  }
  return all;
}

std::vector<Expression> literals_of_derivatives(const FilterModel& model) {
  std::set<int> numbers{0, 1, 2};
  for (const Definition& definition : model.predict) {
    collect_exponents(definition.value, numbers);
  }
  for (const Expression& formula : model.measure) {
    collect_exponents(formula, numbers);
  }
  std::vector<Expression> literals;
  literals.reserve(numbers.size());
  for (const int number : numbers) {
    literals.push_back({Expression::Kind::number, {}, std::to_string(number), 0, 1, {}});
  }
  return literals;
}

bool depends_on_inputs(const trackers::StraightLineProgram& program, int input, std::size_t first,
                       std::size_t last) {
  std::vector<bool> depends(static_cast<std::size_t>(program.registers()), false);
  for (int i = input; i < program.inputs(); ++i) {
    depends[static_cast<std::size_t>(i)] = true;
  }
  std::size_t place = static_cast<std::size_t>(program.inputs());
  for (const trackers::Instruction& instruction : program.instructions()) {
    for (const int operand : {instruction.first, instruction.second, instruction.third}) {
      if (operand >= 0 && depends[static_cast<std::size_t>(operand)]) {
        depends[place] = true;
      }
    }
    ++place;
  }
  for (std::size_t i = first; i < last; ++i) {
    if (depends[static_cast<std::size_t>(program.results()[i])]) {
      return true;
    }
  }
  return false;
}

namespace {

std::vector<Differentiated> with_derivatives(std::vector<Differentiated> terms) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    terms[i].derivatives.assign(terms.size(), Term::zero());
    terms[i].derivatives[i] = Term::one();
  }
  return terms;
}

/// Whether results number first, first + 1, ... are a symmetric matrix of this size, row by row: equal
/// formulas are one register.
bool is_symmetric(const trackers::StraightLineProgram& program, std::size_t first, std::size_t size) {
  const std::vector<int>& results = program.results();
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (results[first + i * size + j] != results[first + j * size + i]) {
        return false;
      }
    }
  }
  return true;
}

/// The prediction with its derivatives by the estimate: those of a given F, if there is one.
std::vector<Differentiated> prediction_of(ProgramBuilder& builder, const FilterModel& model,
                                          const Constants& constants,
                                          const std::vector<Differentiated>& estimates, Position place) {
  std::vector<Differentiated> predicted = builder.run(
      compile_step(model.predict, constants, model.states, {}, place), with_derivatives(estimates));
  // A given F propagates the covariance; nothing is required of it there.
  for (std::size_t i = 0; i < model.jacobian.size(); ++i) {
    for (std::size_t j = 0; j < estimates.size(); ++j) {
      predicted[i].derivatives[j] =
          builder.run(compile_formulas({&model.jacobian[i][j]}, constants, model.states), estimates)
              .front()
              .value;
    }
  }
  return predicted;
}

}  // namespace

std::optional<trackers::FilterParts> compile_filter_parts(const FilterModel& model,
                                                          const Constants& constants,
                                                          const std::vector<std::string>& samples,
                                                          Position place) {
  const std::size_t states = model.states.size();
  const std::size_t channels = samples.size();
  ProgramBuilder builder(constants, static_cast<int>(states + channels));
  const auto input = [&](std::size_t number) {
    return Term::of_register(static_cast<int>(constants.size() + number));
  };
  std::vector<Differentiated> estimates(states);
  for (std::size_t i = 0; i < states; ++i) {
    estimates[i].value = input(i);
  }
  const std::vector<Differentiated> predicted = prediction_of(builder, model, constants, estimates, place);
  builder.set_position(place);
  std::vector<const Expression*> formulas;
  for (const Expression& formula : model.measure) {
    formulas.push_back(&formula);
  }
  const std::vector<Differentiated> measured =
      builder.run(compile_formulas(formulas, constants, model.states), with_derivatives(predicted));
  builder.set_position(place);
  const auto entry = [&](const Expression& formula) {
    return builder.run(compile_formulas({&formula}, constants, {}), {}).front().value;
  };
  for (const Differentiated& next : predicted) {
    builder.add_result(next.value);
  }
  for (const Differentiated& next : predicted) {
    for (const Term derivative : next.derivatives) {
      builder.add_result(derivative);
    }
  }
  for (std::size_t c = 0; c < channels; ++c) {
    builder.add_result(builder.subtract(input(states + c), measured[c].value));
  }
  for (const Differentiated& each : measured) {
    for (const Term derivative : each.derivatives) {
      builder.add_result(derivative);
    }
  }
  for (const auto* matrix : {&model.process_noise, &model.measurement_noise}) {
    for (const std::vector<Expression>& row : *matrix) {
      for (const Expression& formula : row) {
        builder.add_result(entry(formula));
      }
    }
  }
  trackers::FilterParts parts{builder.take().program, static_cast<int>(states), static_cast<int>(channels),
                              !model.jacobian.empty()};
  const std::size_t of_measurement = states + states * states + channels;
  const bool is_linear = !depends_on_inputs(parts.program, static_cast<int>(constants.size()), of_measurement,
                                            parts.program.results().size());
  const std::size_t of_process = of_measurement + channels * states;
  const bool are_symmetric = is_symmetric(parts.program, of_process, states) &&
                             is_symmetric(parts.program, of_process + states * states, channels);
  return is_linear && are_symmetric ? std::optional(std::move(parts)) : std::nullopt;
}

CompiledProgram compile_filter(const FilterModel& model, const Constants& constants,
                               const std::vector<std::string>& samples, Position place) {
  return FilterWriter(model, constants, samples).write(place);
}

}  // namespace veritrack::certificates::language
