#include "certificates/model/recursion_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

#include "certificates/model/identifiers.hpp"
#include "certificates/model/piecewise_code.hpp"
#include "certificates/model/program_text.hpp"

namespace veritrack::certificates {

namespace {

/// A language that code is written in.
struct Dialect {
  CodeLanguage language;
  FormulaSyntax syntax;
  std::string_view line_end;  ///< of a statement
  std::string_view comment, comment_end;
};

constexpr std::array kDialects{
    Dialect{CodeLanguage::formulas, {"^", ""}, "", "# ", ""},
    Dialect{CodeLanguage::c, {"", ""}, ";", "/* ", " */"},
    Dialect{CodeLanguage::python, {"", "math."}, "", "# ", ""},
    Dialect{CodeLanguage::octave, {"", ""}, ";", "% ", ""},
};

const Dialect& dialect_of(CodeLanguage language) {
  return *std::find_if(kDialects.begin(), kDialects.end(),
                       [&](const Dialect& dialect) { return dialect.language == language; });
}

std::vector<std::string> primed(std::vector<std::string> names) {
  for (std::string& name : names) {
    name += "'";
  }
  return names;
}

/// The parts of the code of a model.
class RecursionWriter {
 public:
  RecursionWriter(const Model& model, CodeLanguage language)
      : model_(&model), dialect_(&dialect_of(language)), identifiers_(language) {
    for (const language::Constant& constant : model.constants) {
      constants_.push_back(constant.is_literal && constant.name != "pi" ? literal(constant.name)
                                                                        : identifiers_.of(constant.name));
    }
    states_ = identifiers_.of(model.states);
    samples_ = identifiers_.of(model.samples);
  }

  [[nodiscard]] const std::vector<std::string>& states() const { return states_; }
  [[nodiscard]] const std::vector<std::string>& samples() const { return samples_; }
  [[nodiscard]] std::vector<std::string> next() { return identifiers_.of(primed(model_->states)); }

  /// The states on which the step, or the frequency, depends, and the samples on which the step depends: the
  /// places that are not empty become statements that take them out of arrays.
  [[nodiscard]] std::vector<std::string> states_of_step() const {
    return used(model_->step.program, states_, 0);
  }
  [[nodiscard]] std::vector<std::string> states_of_frequency() const {
    return used(model_->frequency.program, states_, 0);
  }
  [[nodiscard]] std::vector<std::string> samples_of_step() const {
    return used(model_->step.program, samples_, states_.size());
  }

  /// Parameters and pi, as statements; code has those that it uses.
  [[nodiscard]] std::string parameters(std::string_view indent, std::string_view type) {
    std::string text;
    for (std::size_t i = 0; i < model_->constants.size(); ++i) {
      const language::Constant& constant = model_->constants[i];
      const bool is_in_use = depends_on(model_->step.program, i) ||
                             depends_on(model_->frequency.program, i) || depends_on(model_->start, i) ||
                             dialect_->language == CodeLanguage::formulas;
      if ((constant.is_literal && constant.name != "pi") || !is_in_use) {
        continue;
      }
      const std::string from =
          i < model_->parameter_texts.size() ? model_->parameter_texts[i] : "the circle constant";
      text += fmt::format("{}{}{} = {}{}  {}{}{}\n", indent, type, constants_[i], number(constant.nearest),
                          dialect_->line_end, dialect_->comment, from, dialect_->comment_end);
    }
    return text;
  }
  [[nodiscard]] std::vector<Assignment> step() {
    std::map<int, std::string> names;
    for (const auto& [place, name] : model_->step.names) {
      names[place] = identifiers_.of(name);
    }
    return assignments(model_->step.program, inputs(states_, samples_), names, next(), "part_",
                       dialect_->syntax);
  }
  [[nodiscard]] std::vector<Assignment> frequency() {
    return assignments(model_->frequency.program, inputs(states_, {}), {}, {"frequency"}, "part_",
                       dialect_->syntax);
  }
  [[nodiscard]] std::vector<Assignment> start() {
    return assignments(model_->start, inputs({"A", "omega"}, {}), {}, states_, "part_", dialect_->syntax);
  }
  /// The functions with kinks that the programs call, each followed by an empty line.
  [[nodiscard]] std::string helpers() const {
    return piecewise_code({&model_->step.program, &model_->frequency.program, &model_->start},
                          dialect_->language);
  }
  /// The assignments as statements.
  [[nodiscard]] std::string statements(const std::vector<Assignment>& lines, std::string_view indent,
                                       std::string_view type) const {
    std::string text;
    for (const Assignment& line : lines) {
      text += fmt::format("{}{}{} = {}{}\n", indent, type, line.name, line.formula, dialect_->line_end);
    }
    return text;
  }

 private:
  /// Whether an instruction or a result of the program is that input.
  [[nodiscard]] static bool depends_on(const trackers::StraightLineProgram& program, std::size_t input) {
    const int place = static_cast<int>(input);
    const auto& made = program.instructions();
    return std::count(program.results().begin(), program.results().end(), place) > 0 ||
           std::any_of(made.begin(), made.end(), [&](const trackers::Instruction& instruction) {
             return instruction.first == place || instruction.second == place || instruction.third == place;
           });
  }
  /// The names, empty where the program does not depend on them. They are inputs behind the constants and
  /// `offset` others.
  [[nodiscard]] std::vector<std::string> used(const trackers::StraightLineProgram& program,
                                              std::vector<std::string> names, std::size_t offset) const {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!depends_on(program, constants_.size() + offset + i)) {
        names[i].clear();
      }
    }
    return names;
  }
  /// A literal of floating point: in C, 1/2 is 0.
  [[nodiscard]] std::string literal(const std::string& text) const {
    const bool is_whole = text.find_first_of(".eE") == std::string::npos;
    return is_whole && dialect_->language != CodeLanguage::formulas ? text + ".0" : text;
  }
  [[nodiscard]] std::string number(double value) const { return literal(fmt::format("{}", value)); }
  [[nodiscard]] std::vector<std::string> inputs(const std::vector<std::string>& first,
                                                const std::vector<std::string>& second) const {
    std::vector<std::string> all = constants_;
    all.insert(all.end(), first.begin(), first.end());
    all.insert(all.end(), second.begin(), second.end());
    return all;
  }

  const Model* model_;
  const Dialect* dialect_;
  Identifiers identifiers_;
  std::vector<std::string> constants_, states_, samples_;
};

std::string as_formulas(RecursionWriter& writer, std::string_view title) {
  return fmt::format(
      "# {}\n# parameters, in double precision\n{}\n# step: from the states and the sample to the next "
      "states\n{}\n"
      "# the estimated frequency in rad/sample, of the new states\n{}\n"
      "# where the search for the steady state begins: A the amplitude, omega the frequency in "
      "rad/sample\n{}",
      title, writer.parameters("", ""), writer.statements(writer.step(), "", ""),
      writer.statements(writer.frequency(), "", ""), writer.statements(writer.start(), "", ""));
}

std::string as_c(RecursionWriter& writer, std::string_view title) {
  const auto unpack = [](const std::vector<std::string>& names, std::string_view array) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
      text += names[i].empty() ? "" : fmt::format("  const double {} = {}[{}];\n", names[i], array, i);
    }
    return text;
  };
  const auto pack = [](const std::vector<std::string>& names, std::string_view array) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
      text += fmt::format("  {}[{}] = {};\n", array, i, names[i]);
    }
    return text;
  };
  constexpr std::string_view kType = "const double ";
  return fmt::format(
      R"(/* {} */
/* Compile with -ffp-contract=off to compute the same doubles as veritrack. */
#include <math.h>

{}
/* x^n by squaring, from the highest bit of n down. */
static inline double power(double x, int n) {{
  double result = x;
  int bit = 1;
  if (n == 0) return 1.0;
  while (bit <= n / 2) bit *= 2;
  while (bit > 1) {{
    bit /= 2;
    result = result * result;
    if (n & bit) result = result * x;
  }}
  return result;
}}

/* The certificate shows low < x < high: nothing has to be done here. */
static inline double stays_within(double x, double low, double high) {{
  (void)low;
  (void)high;
  return x;
}}

{}enum {{ tracker_states = {}, tracker_samples = {} }};

/* The states after a sample (two samples for two channels). */
void tracker_step(const double *state, const double *sample, double *next) {{
{}{}{}{}}}

/* The estimated frequency, rad/sample. */
double tracker_frequency(const double *state) {{
{}{}  return frequency;
}}

/* The state where the search for the steady state begins. */
void tracker_start(double A, double omega, double *state) {{
{}{}}}
)",
      title, writer.parameters("", "static const double "), writer.helpers(), writer.states().size(),
      writer.samples().size(), unpack(writer.states_of_step(), "state"),
      unpack(writer.samples_of_step(), "sample"), writer.statements(writer.step(), "  ", kType),
      pack(writer.next(), "next"), unpack(writer.states_of_frequency(), "state"),
      writer.statements(writer.frequency(), "  ", kType), writer.statements(writer.start(), "  ", kType),
      pack(writer.states(), "state"));
}

std::string as_python(RecursionWriter& writer, std::string_view title) {
  const auto tuple = [](const std::vector<std::string>& names) {
    return fmt::format("{}{}", fmt::join(names, ", "), names.size() == 1 ? "," : "");
  };
  return fmt::format(
      R"(# {}
import math

{}

def power(x, n):
    """x^n by squaring, from the highest bit of n down."""
    if n == 0:
        return 1.0
    result = x
    for bit in bin(n)[3:]:
        result = result * result
        if bit == "1":
            result = result * x
    return result


def stays_within(x, low, high):
    """The certificate shows low < x < high: nothing has to be done here."""
    return x


{}def tracker_step(state, sample):
    """The states after a sample (two samples for two channels)."""
    {} = state
    {} = sample
{}    return ({})


def tracker_frequency(state):
    """The estimated frequency, rad/sample."""
    {} = state
{}    return frequency


def tracker_start(A, omega):
    """The state where the search for the steady state begins."""
{}    return ({})
)",
      title, writer.parameters("", ""), writer.helpers(), tuple(writer.states()), tuple(writer.samples()),
      writer.statements(writer.step(), "    ", ""), tuple(writer.next()), tuple(writer.states()),
      writer.statements(writer.frequency(), "    ", ""), writer.statements(writer.start(), "    ", ""),
      tuple(writer.states()));
}

std::string as_octave(RecursionWriter& writer, std::string_view title) {
  const auto unpack = [](const std::vector<std::string>& names, std::string_view array) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
      text += names[i].empty() ? "" : fmt::format("  {} = {}({});\n", names[i], array, i + 1);
    }
    return text;
  };
  const std::string parameters = writer.parameters("  ", "");
  return fmt::format(
      R"(1;  % {}

function result = power(x, n)  % x^n by squaring, from the highest bit of n down
  if n == 0
    result = 1;
    return
  end
  result = x;
  bit = 2^floor(log2(n));
  while bit > 1
    bit = bit/2;
    result = result*result;
    if bitand(n, bit)
      result = result*x;
    end
  end
end

function x = stays_within(x, low, high)  % the certificate shows low < x < high: nothing has to be done here
end

{}function next = tracker_step(state, sample)  % the states after a sample (two samples for two channels)
{}{}{}{}  next = [{}];
end

function frequency = tracker_frequency(state)  % the estimated frequency, rad/sample
{}{}{}end

function state = tracker_start(A, omega)  % the state where the search for the steady state begins
{}{}  state = [{}];
end
)",
      title, writer.helpers(), parameters, unpack(writer.states_of_step(), "state"),
      unpack(writer.samples_of_step(), "sample"), writer.statements(writer.step(), "  ", ""),
      fmt::join(writer.next(), "; "), parameters, unpack(writer.states_of_frequency(), "state"),
      writer.statements(writer.frequency(), "  ", ""), parameters,
      writer.statements(writer.start(), "  ", ""), fmt::join(writer.states(), "; "));
}

}  // namespace

std::string recursion_text(const Model& model, std::string_view title, CodeLanguage language) {
  RecursionWriter writer(model, language);
  switch (language) {
    case CodeLanguage::formulas:
      return as_formulas(writer, title);
    case CodeLanguage::c:
      return as_c(writer, title);
    case CodeLanguage::python:
      return as_python(writer, title);
    case CodeLanguage::octave:
      return as_octave(writer, title);
    default:
      throw std::logic_error("code in one format of numbers is written by written_code");
  }
}

}  // namespace veritrack::certificates
