#include "certificates/model/model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "certificates/design/nearest_key.hpp"
#include "certificates/model/language/extended_kalman_filter.hpp"
#include "certificates/model/language/written_out.hpp"

namespace veritrack::certificates {

namespace {

using language::Definition;
using language::Expression;
using language::LanguageError;
using language::NamedFormula;

std::vector<std::string> texts(const std::vector<SourceText>& sources) {
  std::vector<std::string> names;
  names.reserve(sources.size());
  for (const SourceText& source : sources) {
    names.push_back(source.text);
  }
  return names;
}

/// Throws LanguageError unless each is a name, free, and given once.
void require_names(const std::vector<SourceText>& sources, std::set<std::string>& taken) {
  for (const SourceText& source : sources) {
    const Expression name = language::parse_expression(source);
    if (name.kind != Expression::Kind::name) {
      throw LanguageError(source.position,
                          "a formula in place of a name; allowed: letters, digits and _, a letter "
                          "first");
    }
    language::require_free_name(source.text, source.position);
    if (!taken.insert(source.text).second) {
      throw LanguageError(source.position,
                          fmt::format("{} is given twice; allowed: each name once", source.text));
    }
  }
}

std::vector<NamedFormula> parameters_of(const ModelTable& table) {
  std::vector<NamedFormula> parameters;
  parameters.reserve(table.parameters.size());
  for (const NamedText& parameter : table.parameters) {
    parameters.push_back(
        {parameter.name.text, parameter.name.position, language::parse_expression(parameter.formula)});
  }
  return parameters;
}

/// Throws LanguageError: the name is not a state.
[[noreturn]] void refuse_state(const SourceText& name, const std::vector<std::string>& states) {
  throw LanguageError(name.position, fmt::format("{} is no state; nearest: {}; allowed: {}", name.text,
                                                 nearest_key(name.text, states), fmt::join(states, ", ")));
}

/// The formulas of `named`, one for each of `names`, in their order. Throws LanguageError for a name that is
/// missing or too many.
std::vector<Expression> formulas_of(const std::vector<NamedText>& named,
                                    const std::vector<std::string>& names, Position place,
                                    std::string_view what) {
  for (const NamedText& entry : named) {
    if (std::find(names.begin(), names.end(), entry.name.text) == names.end()) {
      refuse_state(entry.name, names);
    }
  }
  std::vector<Expression> formulas;
  formulas.reserve(names.size());
  for (const std::string& name : names) {
    const auto found = std::find_if(named.begin(), named.end(),
                                    [&](const NamedText& entry) { return entry.name.text == name; });
    if (found == named.end()) {
      throw LanguageError(place, fmt::format("the state {} has no {}; allowed: one for each of {}", name,
                                             what, fmt::join(names, ", ")));
    }
    formulas.push_back(language::parse_expression(found->formula));
  }
  return formulas;
}

std::vector<const Expression*> pointers(const std::vector<Expression>& formulas) {
  std::vector<const Expression*> result;
  result.reserve(formulas.size());
  for (const Expression& formula : formulas) {
    result.push_back(&formula);
  }
  return result;
}

/// The source of the step: its lines, or the model of a filter.
struct Recipe {
  Position position;
  std::vector<Definition> step;
  std::optional<language::FilterModel> filter;
  std::vector<Expression> literals;  ///< that the filter needs beside its own

  [[nodiscard]] std::vector<const Expression*> formulas() const {
    std::vector<const Expression*> all;
    for (const Definition& definition : filter ? filter->predict : step) {
      all.push_back(&definition.value);
    }
    if (filter) {
      for (const auto* matrix : {&filter->process_noise, &filter->measurement_noise, &filter->jacobian}) {
        for (const std::vector<Expression>& row : *matrix) {
          for (const Expression& entry : row) {
            all.push_back(&entry);
          }
        }
      }
      for (const Expression& formula : filter->measure) {
        all.push_back(&formula);
      }
    }
    for (const Expression& literal : literals) {
      all.push_back(&literal);
    }
    return all;
  }
};

/// A square matrix of formulas with that many rows. Throws LanguageError.
std::vector<std::vector<Expression>> square_matrix(const std::vector<std::vector<SourceText>>& rows,
                                                   std::size_t size, std::string_view name) {
  std::vector<std::vector<Expression>> matrix;
  for (const std::vector<SourceText>& row : rows) {
    if (row.size() != size || rows.size() != size) {
      throw LanguageError(row.front().position,
                          fmt::format("{} has {} rows, and one of {} entries; allowed: {} of "
                                      "each",
                                      name, rows.size(), row.size(), size));
    }
    matrix.emplace_back();
    for (const SourceText& entry : row) {
      matrix.back().push_back(language::parse_expression(entry));
    }
  }
  return matrix;
}

/// Throws LanguageError where two entries that mirror each other are certainly different numbers.
void require_symmetric(const std::vector<std::vector<SourceText>>& rows,
                       const std::vector<NamedFormula>& parameters, std::string_view name) {
  const auto value_of = [&](const SourceText& entry) {
    std::vector<NamedFormula> formulas = parameters;
    formulas.push_back({"entry", entry.position, language::parse_expression(entry)});
    return language::collect_constants(formulas, {})[parameters.size()].value;
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const SourceText& below = rows[i][j];
      const SourceText& above = rows[j][i];
      if (below.text == above.text) {
        continue;
      }
      const rigor::Interval a = value_of(below);
      const rigor::Interval b = value_of(above);
      if (rigor::certainly_less(a, b) || rigor::certainly_less(b, a)) {
        throw LanguageError(
            below.position,
            fmt::format("{} is not symmetric: row {}, column {} is {}, and row {}, column {} is {}; "
                        "allowed: a covariance, whose entries mirror each other",
                        name, i + 1, j + 1, below.text, j + 1, i + 1, above.text));
      }
    }
  }
}

/// Throws LanguageError for a unit of something that is not a state, and where a unit contradicts the use of
/// the value.
void require_units(const ModelTable& table, const std::vector<std::string>& states) {
  const auto is_one_of = [](const std::string& unit, std::initializer_list<std::string_view> units) {
    return std::find(units.begin(), units.end(), unit) != units.end();
  };
  for (const NamedText& unit : table.units) {
    const std::string& name = unit.name.text;
    if (std::find(states.begin(), states.end(), name) == states.end()) {
      refuse_state(unit.name, states);
    }
    if (table.frequency.text == name &&
        is_one_of(unit.formula.text, {"Hz", "kHz", "MHz", "1/s", "rad/s", "deg/s", "deg/sample", "rpm",
                                      "cycles/sample", "turns/sample"})) {
      throw LanguageError(unit.formula.position,
                          fmt::format("{} is in {}, and frequency = '{}' has to be in rad/sample; allowed: a "
                                      "frequency that converts it, e.g. '{}*T' from rad/s with the sampling "
                                      "interval T",
                                      name, unit.formula.text, name, name));
    }
    const bool is_angle = std::any_of(table.angles.begin(), table.angles.end(),
                                      [&](const SourceText& angle) { return angle.text == name; });
    if (is_angle &&
        is_one_of(unit.formula.text, {"deg", "degree", "degrees", "turn", "turns", "cycle", "cycles"})) {
      throw LanguageError(
          unit.formula.position,
          fmt::format("the angle {} is in {}; allowed: angles in rad, which are the same after "
                      "2 pi",
                      name, unit.formula.text));
    }
  }
}

Recipe recipe_of(const ModelTable& table) {
  if (!table.ekf) {
    std::vector<Definition> step = language::parse_definitions(table.step);
    language::leave_out_outer_wraps(step, texts(table.angles));
    return {table.step.position, std::move(step), std::nullopt, {}};
  }
  const ModelEkfTable& ekf = *table.ekf;
  language::FilterModel filter;
  filter.states = texts(ekf.states);
  filter.predict = language::parse_definitions(ekf.predict);
  for (const SourceText& formula : ekf.measure) {
    filter.measure.push_back(language::parse_expression(formula));
  }
  if (ekf.measure.size() != table.samples.size()) {
    throw LanguageError(ekf.measure.front().position,
                        fmt::format("{} formulas to measure; allowed: as many as there are samples, {}",
                                    ekf.measure.size(), table.samples.size()));
  }
  filter.process_noise = square_matrix(ekf.process_noise, ekf.states.size(), "Q");
  filter.measurement_noise = square_matrix(ekf.measurement_noise, ekf.measure.size(), "R");
  filter.jacobian = square_matrix(ekf.jacobian, ekf.states.size(), "the Jacobian");
  std::vector<Expression> literals = language::literals_of_derivatives(filter);
  return {ekf.predict.position, {}, std::move(filter), std::move(literals)};
}

/// The start of a filter: a covariance of 1 and 0 where none is given.
std::vector<NamedText> with_start_covariance(std::vector<NamedText> start,
                                             const std::vector<std::string>& states) {
  for (const std::string& state : states) {
    const bool is_given = std::any_of(start.begin(), start.end(),
                                      [&](const NamedText& entry) { return entry.name.text == state; });
    if (state.starts_with("P.") && !is_given) {
      const std::size_t dot = state.find('.', 2);
      const bool is_diagonal = state.substr(2, dot - 2) == state.substr(dot + 1);
      start.push_back({{state, {}}, {is_diagonal ? "1" : "0", {}}});
    }
  }
  return start;
}

/// Throws LanguageError for a comment in a formula that sentences repeat as it is written.
void require_no_comment(const SourceText& formula) {
  if (formula.text.find_first_of("#\n\r") != std::string::npos) {
    throw LanguageError(formula.position,
                        "a comment, or a second line, in a formula that a sentence repeats; allowed: the "
                        "formula alone");
  }
}

/// The value of a formula of the parameters, which is evaluated as one more of them.
rigor::Interval value_of_parameters(std::vector<NamedFormula> parameters, const SourceText& formula) {
  require_no_comment(formula);
  parameters.push_back({"start", formula.position, language::parse_expression(formula)});
  return language::collect_constants(parameters, {}).at(parameters.size() - 1).value;
}

}  // namespace

bool is_pure_tone(const ModelTables& tables) {
  const std::vector<SourceText> signal = signal_of(tables.model, tables.assume.signal);
  const std::vector<SourceText> tone = signal_of(tables.model, {});
  return std::equal(signal.begin(), signal.end(), tone.begin(), tone.end(),
                    [](const SourceText& a, const SourceText& b) { return a.text == b.text; });
}

std::vector<rigor::Interval> exact_start(const Model& model, const ModelTable& table,
                                         const std::vector<NamedText>& start_exactly) {
  std::vector<rigor::Interval> state;
  if (start_exactly.empty()) {
    return state;
  }
  (void)formulas_of(start_exactly, model.states, start_exactly.front().name.position,
                    "value in start_exactly");
  for (const std::string& name : model.states) {
    const auto found = std::find_if(start_exactly.begin(), start_exactly.end(),
                                    [&](const NamedText& entry) { return entry.name.text == name; });
    state.push_back(value_of_parameters(parameters_of(table), found->formula));
  }
  return state;
}

std::vector<rigor::Interval> start_deviations(const Model& model, const ModelTable& table,
                                              const std::vector<NamedText>& start_within) {
  std::vector<rigor::Interval> deviations(model.states.size(), rigor::Interval(0.0));
  std::vector<NamedFormula> formulas = parameters_of(table);
  for (const NamedText& entry : start_within) {
    const auto found = std::find(model.states.begin(), model.states.end(), entry.name.text);
    if (found == model.states.end()) {
      refuse_state(entry.name, model.states);
    }
    // Evaluated as a parameter is: those before it are all others.
    require_no_comment(entry.formula);
    formulas.push_back({"start", entry.formula.position, language::parse_expression(entry.formula)});
    const language::Constants constants = language::collect_constants(formulas, {});
    formulas.pop_back();
    const rigor::Interval& value = constants.back().value;
    if (!rigor::certainly_less_equal(rigor::Interval(0.0), value)) {
      throw LanguageError(entry.formula.position,
                          fmt::format("a deviation of {}; allowed: 0 or more", entry.formula.text));
    }
    deviations[static_cast<std::size_t>(found - model.states.begin())] = value;
  }
  return deviations;
}

std::vector<SourceText> signal_of(const ModelTable& table, const std::vector<SourceText>& signal) {
  if (!signal.empty()) {
    return signal;
  }
  return table.samples.size() == 1 ? std::vector<SourceText>{{"A*cos(phi)", {}}}
                                   : std::vector<SourceText>{{"A*cos(phi)", {}}, {"A*sin(phi)", {}}};
}

Model make_model(const ModelTable& table, const std::vector<SourceText>& signal) {
  std::set<std::string> taken;
  require_names(table.samples, taken);
  require_names(table.ekf ? table.ekf->states : table.states, taken);
  const std::vector<NamedFormula> parameters = parameters_of(table);
  Model model;
  for (const NamedText& parameter : table.parameters) {
    require_names({parameter.name}, taken);
    model.parameter_texts.push_back(parameter.formula.text);
  }
  model.samples = texts(table.samples);
  const Recipe recipe = recipe_of(table);
  model.states = recipe.filter ? language::filter_states(recipe.filter->states) : texts(table.states);
  const Expression frequency = language::parse_expression(table.frequency);
  const std::vector<Expression> start =
      formulas_of(recipe.filter ? with_start_covariance(table.start, model.states) : table.start,
                  model.states, recipe.position, "start");
  std::vector<Expression> samples;
  const std::vector<SourceText> signal_texts = signal_of(table, signal);
  if (signal_texts.size() != table.samples.size()) {
    throw LanguageError(signal_texts.front().position,
                        fmt::format("{} formulas for the signal; allowed: as many as there are samples, {}",
                                    signal_texts.size(), table.samples.size()));
  }
  samples.reserve(signal_texts.size());
  for (const SourceText& text : signal_texts) {
    samples.push_back(language::parse_expression(text));
  }

  std::vector<const Expression*> all = pointers(start);
  const std::vector<const Expression*> of_recipe = recipe.formulas();
  all.insert(all.end(), of_recipe.begin(), of_recipe.end());
  all.push_back(&frequency);
  for (const Expression& sample : samples) {
    all.push_back(&sample);
  }
  model.constants = language::collect_constants(parameters, all);
  if (table.ekf) {
    require_symmetric(table.ekf->process_noise, parameters, "Q");
    require_symmetric(table.ekf->measurement_noise, parameters, "R");
  }

  model.step = recipe.filter
                   ? language::compile_filter(*recipe.filter, model.constants, model.samples, recipe.position)
                   : language::compile_step(recipe.step, model.constants, model.states, model.samples,
                                            recipe.position);
  model.frequency = language::compile_formulas({&frequency}, model.constants, model.states);
  model.start = language::compile_formulas(pointers(start), model.constants, {"A", "omega"}).program;
  model.signal = language::compile_formulas(pointers(samples), model.constants, {"A", "phi"}).program;
  const int constants = static_cast<int>(model.constants.size());
  model.recursion = {model.step.program,
                     model.frequency.program,
                     constants,
                     static_cast<int>(model.states.size()),
                     static_cast<int>(model.samples.size()),
                     {}};
  const std::vector<std::string> angles = texts(table.angles);
  for (const SourceText& angle : table.angles) {
    if (std::find(model.states.begin(), model.states.end(), angle.text) == model.states.end()) {
      refuse_state(angle, model.states);
    }
  }
  require_units(table, model.states);
  for (const std::string& state : model.states) {
    model.recursion.is_angle.push_back(std::find(angles.begin(), angles.end(), state) != angles.end());
  }
  if (const auto format = written_format(table); format && !recipe.filter) {
    model.written = language::written_listing(
        {parameters, recipe.step, model.states, model.samples, angles, frequency}, *format);
  }
  if (recipe.filter && angles.empty()) {
    const int estimates = constants + static_cast<int>(recipe.filter->states.size());
    const bool reads_covariance = language::depends_on_inputs(model.frequency.program, estimates, 0,
                                                              model.frequency.program.results().size());
    model.filter = reads_covariance ? std::nullopt
                                    : language::compile_filter_parts(*recipe.filter, model.constants,
                                                                     model.samples, recipe.position);
  }
  return model;
}

}  // namespace veritrack::certificates
