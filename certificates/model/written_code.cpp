#include "certificates/model/written_code.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

#include "analysis/rigor/rounding.hpp"
#include "certificates/design/request_error.hpp"
#include "certificates/model/identifiers.hpp"
#include "certificates/model/model.hpp"
#include "certificates/model/model_sets.hpp"

namespace veritrack::certificates {

namespace {

namespace ieee = trackers::code;

class CodeWriter {
 public:
  CodeWriter(const Model& model, bool is_single)
      : written_(&model.written.value()),
        listing_(language::with_constants(*written_)),
        is_single_(is_single),
        identifiers_(CodeLanguage::c),
        struct_(identifiers_.of("tracker")) {
    for (const ieee::State& state : listing_.states) {
      states_.push_back(identifiers_.of(state.name));
    }
    samples_ = identifiers_.of(listing_.sample_names);
  }

  [[nodiscard]] std::string_view type() const { return is_single_ ? "float" : "double"; }
  [[nodiscard]] const std::vector<std::string>& states() const { return states_; }
  [[nodiscard]] const std::vector<std::string>& samples() const { return samples_; }

  /// The statements of the step.
  [[nodiscard]] std::string step() {
    std::vector<int> results;
    for (const ieee::State& state : listing_.states) {
      results.push_back(state.next);
    }
    std::string text = statements(results);
    for (std::size_t i = 0; i < results.size(); ++i) {
      text += fmt::format("  tracker->{} = {};\n", states_[i], operand(results[i]));
    }
    return text;
  }
  [[nodiscard]] std::string frequency() {
    const std::string text = statements({listing_.frequency});
    return text + fmt::format("  return {};\n", operand(listing_.frequency));
  }
  /// The number of the format that is nearest.
  [[nodiscard]] std::string number(double value) const {
    const rigor::NearestRounding nearest;
    const double rounded = is_single_ ? static_cast<double>(static_cast<float>(value)) : value;
    return fmt::format("{:a}{}", rounded, is_single_ ? "f" : "");
  }

 private:
  [[nodiscard]] const ieee::Instruction& at(int place) const {
    return listing_.instructions[static_cast<std::size_t>(place)];
  }

  /// A line for each operation that the results need and that is used more than once, or has a name.
  [[nodiscard]] std::string statements(const std::vector<int>& results) {
    std::map<int, int> uses;
    for (const int result : results) {
      ++uses[result];
    }
    for (int place = static_cast<int>(listing_.instructions.size()) - 1; place >= 0; --place) {
      if (uses.contains(place)) {
        for (const int used : at(place).operands) {
          uses[used] += used >= 0 ? 1 : 0;
        }
      }
    }
    uses.erase(-1);
    texts_.clear();
    std::string text;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (uses.contains(listing_.states[i].input)) {
        text += fmt::format("  const {} {} = tracker->{};\n", type(), states_[i], states_[i]);
      }
      texts_[listing_.states[i].input] = states_[i];
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      texts_[listing_.samples[i]] = samples_[i];
    }
    for (const auto& [place, count] : uses) {
      if (at(place).operation == ieee::Operation::input) {
        continue;
      }
      const std::string formula = formula_of(place);
      const auto named = written_->names.find(place);
      const bool is_line = at(place).format.is_float && at(place).operation != ieee::Operation::constant &&
                           (named != written_->names.end() || count > 1);
      if (is_line) {
        texts_[place] =
            identifiers_.of(named != written_->names.end() ? named->second : fmt::format("part_{}", place));
        text += fmt::format("  const {} {} = {};\n", type(), texts_[place], formula);
      } else {
        texts_[place] = at(place).operation == ieee::Operation::constant ? formula : "(" + formula + ")";
      }
    }
    return text;
  }

  [[nodiscard]] const std::string& operand(int place) const { return texts_.at(place); }

  [[nodiscard]] std::string formula_of(int place) const {
    const ieee::Instruction& made = at(place);
    const auto of = [&](std::size_t i) { return operand(made.operands[i]); };
    switch (made.operation) {
      case ieee::Operation::constant:
        return number(ieee::number_of(made.format, made.bits));
      case ieee::Operation::fadd:
        return of(0) + " + " + of(1);
      case ieee::Operation::fsub:
        return of(0) + " - " + of(1);
      case ieee::Operation::fmul:
        return of(0) + " * " + of(1);
      case ieee::Operation::fdiv:
        return of(0) + " / " + of(1);
      case ieee::Operation::fneg:
        return "-" + of(0);
      case ieee::Operation::select:
        return of(0) + " ? " + of(1) + " : " + of(2);
      case ieee::Operation::fcmp:
        return of(0) +
               (made.predicate == ieee::Predicate::olt   ? " < "
                : made.predicate == ieee::Predicate::ole ? " <= "
                : made.predicate == ieee::Predicate::ogt ? " > "
                                                         : " >= ") +
               of(1);
      default: {
        const std::string second = made.operands[1] >= 0 ? ", " + of(1) : "";
        return fmt::format("{}{}({}{})", ieee::name_of(made.operation)->name, is_single_ ? "f" : "", of(0),
                           second);
      }
    }
  }

  const language::WrittenListing* written_;
  ieee::Listing listing_;
  bool is_single_;
  Identifiers identifiers_;
  std::string struct_;  ///< taken
  std::vector<std::string> states_, samples_;
  std::map<int, std::string> texts_;
};

}  // namespace

std::string written_code(const ModelTables& tables, std::string_view title, std::string_view arithmetic) {
  if (tables.model.ekf || tables.model.compiled) {
    throw RequestError(
        "--precision is for a recursion that is written as a step; allowed: --language c alone");
  }
  ModelTable table = tables.model;
  table.arithmetic.text = arithmetic;
  const Model model = make_model(table, tables.assume.signal);
  CodeWriter writer(model, arithmetic == "binary32");
  std::string start;
  const double middle = rigor::midpoint(band_of(tables.assume));
  const std::vector<double> states = proposed_tone(model, tables.assume).start(middle);
  for (std::size_t i = 0; i < states.size(); ++i) {
    start += fmt::format("  tracker->{} = {};\n", writer.states()[i], writer.number(states[i]));
  }
  const std::string_view type = writer.type();
  return fmt::format(
      R"(/* {0} */
/* The operations are those that a certificate in {1} is about, also where products and sums are fused; not
   with -ffast-math. */
#include <math.h>

typedef struct {{
  {2} {3};
}} tracker_t;

/* The start of the design, in the middle of its frequencies. */
void tracker_init(tracker_t *tracker) {{
{4}}}

/* Takes a sample (two of two channels). */
void tracker_step(tracker_t *tracker, {2} {5}) {{
{6}}}

/* The estimated frequency, rad/sample. */
{2} tracker_frequency(const tracker_t *tracker) {{
{7}}}
)",
      title, arithmetic, type, fmt::join(writer.states(), ", "), start,
      fmt::join(writer.samples(), fmt::format(", {} ", type)), writer.step(), writer.frequency());
}

}  // namespace veritrack::certificates
