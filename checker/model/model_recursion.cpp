#include "checker/model/model_recursion.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace veritrack::checker {

namespace {

std::vector<std::string> texts_of(const Tree& list) {
  std::vector<std::string> texts;
  for (const Tree& each : list.elements()) {
    texts.push_back(each.text());
  }
  return texts;
}

/// A ball that is wider by 2^-51 of its size: it contains the exact result of an operation and the result in
/// doubles, with functions within a unit in the last place.
Ball as_in_doubles(const Ball& exact) {
  return exact + Ball::within(exact * Ball(0x1p-51)) + Ball::within(Ball(0x1p-1070));
}

/// The numbers that a literal stands for: the decimal, and the double nearest to it, which may be the same.
Ball literal(const std::string& text) {
  const Ball decimal = from_decimal(text);
  return certainly_equal(decimal, Ball(decimal.near())) ? decimal : as_in_doubles(decimal);
}

/// Values of parameters: both as they are written and as they are computed in double precision.
struct Computed {
  Ball ball;
  Computed(Ball value) : ball(std::move(value)) {}  // NOLINT(google-explicit-constructor)
  explicit Computed(double value) : ball(Ball(value)) {}
};
Computed operator+(const Computed& x, const Computed& y) {
  return as_in_doubles(x.ball + y.ball);
}
Computed operator-(const Computed& x, const Computed& y) {
  return as_in_doubles(x.ball - y.ball);
}
Computed operator*(const Computed& x, const Computed& y) {
  return as_in_doubles(x.ball * y.ball);
}
Computed operator/(const Computed& x, const Computed& y) {
  return as_in_doubles(x.ball / y.ball);
}
Computed operator-(const Computed& x) {
  return -x.ball;
}
Computed sqrt(const Computed& x) {
  return as_in_doubles(sqrt(x.ball));
}
Computed exp(const Computed& x) {
  return as_in_doubles(exp(x.ball));
}
Computed log(const Computed& x) {
  return as_in_doubles(log(x.ball));
}
Computed sin(const Computed& x) {
  return as_in_doubles(sin(x.ball));
}
Computed cos(const Computed& x) {
  return as_in_doubles(cos(x.ball));
}
Computed tangent(const Computed& x) {
  return as_in_doubles(tangent(x.ball));
}
Computed arcsine(const Computed& x) {
  return as_in_doubles(arcsine(x.ball));
}
Computed arccosine(const Computed& x) {
  return as_in_doubles(arccosine(x.ball));
}
Computed arctangent(const Computed& x) {
  return as_in_doubles(arctangent(x.ball));
}
Computed arctangent2(const Computed& y, const Computed& x) {
  return as_in_doubles(arctangent2(y.ball, x.ball));
}
Computed stays_within(const Computed& x, const Computed& low, const Computed& high) {
  return stays_within(x.ball, low.ball, high.ball);
}

Computed larger(const Computed& x, const Computed& y) {
  return larger(x.ball, y.ball);
}
Computed clamped(const Computed& x, const Computed& low, const Computed& high) {
  return clamped(x.ball, low.ball, high.ball);
}
Computed chosen(const Computed& positive, const Computed& a, const Computed& b) {
  return chosen(positive.ball, a.ball, b.ball);
}
Computed sign_of(const Computed& x) {
  return sign_of(x.ball);
}

/// A certificate's sentences and the signal use these words: they have one meaning. Throws FormulaError.
void require_free(const std::string& name) {
  constexpr std::array<std::string_view, 24> kTaken{
      "pi",  "A",    "phi", "omega", "sqrt",         "exp",   "log",  "sin",  "cos", "tan",  "asin",  "acos",
      "min", "atan", "max", "atan2", "stays_within", "hypot", "tanh", "wrap", "abs", "sign", "clamp", "if"};
  if (std::find(kTaken.begin(), kTaken.end(), name) != kTaken.end()) {
    throw FormulaError(name + " has two meanings");
  }
}

}  // namespace

ModelRecursion::Slots ModelRecursion::numbered(const std::vector<std::string>& names) {
  Slots slots;
  int next = 0;
  for (const std::string& name : names) {
    if (!slots.try_emplace(name, next++).second) {
      throw FormulaError(name + " has two meanings");
    }
  }
  return slots;
}

Formula ModelRecursion::looked_up(Formula formula, const Slots& variables) {
  for (FormulaStep& step : formula) {
    const bool is_number = step.kind == FormulaStep::Kind::number;
    if (!is_number && step.kind != FormulaStep::Kind::name) {
      continue;
    }
    if (is_number || step.text == "pi") {
      if (constant_slots_.try_emplace(step.text, -1 - static_cast<int>(constants_.size())).second) {
        constants_.push_back(is_number ? literal(step.text) : as_in_doubles(pi()));
      }
    }
    const auto constant = constant_slots_.find(step.text);
    const auto variable = variables.find(step.text);
    if ((constant == constant_slots_.end()) == (variable == variables.end())) {
      throw FormulaError(step.text +
                         (constant == constant_slots_.end() ? " is unknown" : " has two meanings"));
    }
    step.slot = constant != constant_slots_.end() ? constant->second : variable->second;
  }
  return formula;
}

Ball ModelRecursion::constant_value(const std::string& formula) {
  return value_of<Computed>(looked_up(read_formula(formula), {}),
                            [&](const FormulaStep& leaf) {
                              return Computed(constants_[static_cast<std::size_t>(-1 - leaf.slot)]);
                            })
      .ball;
}

void ModelRecursion::read_parameters(const Tree& parameters) {
  for (const Tree& parameter : parameters.elements()) {
    const Ball value = constant_value(parameter.at("formula").text());
    const std::string& name = parameter.at("name").text();
    require_free(name);
    if (!value.finite()) {
      throw FormulaError("the parameter " + name + " has no value");
    }
    if (!constant_slots_.try_emplace(name, -1 - static_cast<int>(constants_.size())).second) {
      throw FormulaError(name + " has two meanings");
    }
    constants_.push_back(value);
  }
}

void ModelRecursion::read_lines_of(const std::string& text, const std::vector<std::string>& inputs,
                                   const std::vector<std::string>& states,
                                   const std::vector<std::string>& angles) {
  Slots variables = numbered(inputs);
  std::for_each(inputs.begin(), inputs.end(), require_free);
  int next = static_cast<int>(inputs.size());
  std::vector<FormulaLine> lines = read_lines(text);
  leave_out_outer_wraps(lines, angles);
  const std::vector<FormulaLine> ordered = in_order_of_need(lines);
  for (const FormulaLine& line : ordered) {
    require_free(line.name);
    lines_.push_back(looked_up(line.value, variables));
    if (is_limit(line)) {
      limits_.push_back(static_cast<std::size_t>(next));
    }
    if (constant_slots_.contains(line.name) || !variables.try_emplace(line.name, next++).second) {
      throw FormulaError(line.name + " has two meanings");
    }
  }
  std::vector<std::string> result_names;
  for (const std::string& state : states) {
    result_names.push_back(state + "'");
    const auto found = variables.find(result_names.back());
    if (found == variables.end()) {
      throw FormulaError("the state " + state + " has no next value");
    }
    results_.push_back(static_cast<std::size_t>(found->second));
  }
  if (const FormulaLine* unused = unused_line(ordered, result_names)) {
    objections_.push_back("nothing needs the line " + unused->name);
  }
}

Formula ModelRecursion::looked_up_text(const Tree& text, const std::vector<std::string>& variables) {
  return looked_up(read_formula(text.text()), numbered(variables));
}

ModelRecursion::Matrix ModelRecursion::looked_up_matrix(const Tree& rows, std::size_t size,
                                                        const std::vector<std::string>& variables) {
  Matrix matrix;
  for (const Tree& row : rows.elements()) {
    matrix.emplace_back();
    for (const Tree& entry : row.elements()) {
      matrix.back().push_back(looked_up_text(entry, variables));
    }
    if (matrix.back().size() != size) {
      throw FormulaError("a matrix that is not square");
    }
  }
  if (matrix.size() != size) {
    throw FormulaError("a matrix that is not square");
  }
  return matrix;
}

void ModelRecursion::read_filter(const Tree& filter) {
  const std::vector<std::string> estimated = texts_of(filter.at("states"));
  filtered_ = estimated.size();
  if (filtered_ == 0) {
    throw FormulaError("a filter without states");
  }
  read_lines_of(filter.at("predict").text(), estimated, estimated, {});
  for (const Tree& formula : filter.at("measure").elements()) {
    measure_.push_back(looked_up_text(formula, estimated));
  }
  if (measure_.size() != sample_names_.size() || measure_.size() > 2) {
    throw FormulaError("as many formulas to measure as there are samples are needed");
  }
  process_noise_ = looked_up_matrix(filter.at("Q"), filtered_, {});
  measurement_noise_ = looked_up_matrix(filter.at("R"), measure_.size(), {});
  bool is_symmetric = true;
  for (const Tree* matrix : {&filter.at("Q"), &filter.at("R")}) {
    for (std::size_t i = 0; i < matrix->elements().size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        is_symmetric = is_symmetric && matrix->at(i).at(j).text() == matrix->at(j).at(i).text();
      }
    }
  }
  if (!is_symmetric) {
    objections_.emplace_back("Q and R are covariances, written as symmetric matrices");
  }
  if (const Tree* jacobian = filter.find("jacobian")) {
    jacobian_ = looked_up_matrix(*jacobian, filtered_, estimated);
  }
  state_names_ = estimated;
  for (std::size_t i = 0; i < filtered_; ++i) {
    for (std::size_t j = i; j < filtered_; ++j) {
      state_names_.push_back("P." + estimated[i] + "." + estimated[j]);
    }
  }
}

ModelRecursion::ModelRecursion(const Tree& model) : sample_names_(texts_of(model.at("samples"))) {
  if (sample_names_.empty() || sample_names_.size() > 2) {
    throw FormulaError("one sample or two are needed");
  }
  read_parameters(model.at("parameters"));
  const std::vector<std::string> angles = texts_of(model.at("angles"));
  if (const Tree* filter = model.find("ekf")) {
    read_filter(*filter);
  } else {
    state_names_ = texts_of(model.at("states"));
    std::vector<std::string> inputs = state_names_;
    inputs.insert(inputs.end(), sample_names_.begin(), sample_names_.end());
    read_lines_of(model.at("step").text(), inputs, state_names_, angles);
  }
  if (state_names_.empty()) {
    throw FormulaError("a tracker without states");
  }
  for (const std::string& state : state_names_) {
    is_angle_.push_back(std::find(angles.begin(), angles.end(), state) != angles.end());
  }
  frequency_ = looked_up_text(model.at("frequency"), state_names_);
  for (const Tree& formula : model.at("signal").elements()) {
    signal_.push_back(looked_up_text(formula, {"A", "phi"}));
  }
  if (signal_.size() != sample_names_.size()) {
    throw FormulaError("as many formulas of the signal as there are samples are needed");
  }
}

}  // namespace veritrack::checker
