#include "checker/code/code_certificate.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "checker/code/arc_tangent.hpp"
#include "checker/code/formula_graph.hpp"
#include "checker/code/listing.hpp"
#include "checker/code/listing_match.hpp"
#include "checker/code/written_formulas.hpp"
#include "checker/document/code_files.hpp"

namespace veritrack::checker {

namespace {

constexpr const char* kInNames = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._/+-";

std::vector<std::string> listed_texts(const Tree& list) {
  std::vector<std::string> texts;
  for (const Tree& each : list.elements()) {
    texts.push_back(each.text());
  }
  return texts;
}

/// Names and digests stand in sentences.
void check_files(const Tree& code, Objections& objections) {
  constexpr std::size_t kDigits = 64;
  std::set<std::string> names;
  for (const Tree* file : code_files(code)) {
    const std::string& name = file->at("name").text();
    const std::string& digest = file->at("sha256").text();
    if (name.empty() || name.find_first_not_of(kInNames) != std::string::npos || !names.insert(name).second) {
      objections.emplace_back("code: a file with a name that is not allowed, or there twice");
    }
    if (digest.size() != kDigits || digest.find_first_not_of("0123456789abcdef") != std::string::npos) {
      objections.emplace_back("code: sha256 is not 64 hexadecimal digits");
    }
  }
  if (code.at("files").elements().empty()) {
    objections.emplace_back("code without files");
  }
  for (const Tree& flag : code.at("flags").elements()) {
    if (!flag.text().starts_with('-')) {
      objections.emplace_back("code: a flag that does not begin with -");
    }
  }
  if (code.at("compiler").text().empty()) {
    objections.emplace_back("code without its compiler");
  }
}

/// Whether the name is that of the listing; behind a name that has another meaning stands _.
bool is_named(const std::string& name, const std::string& listed) {
  return name.starts_with(listed) && name.find_first_not_of('_', listed.size()) == std::string::npos;
}

void check_names(const std::vector<std::string>& names, const std::vector<std::string>& listed,
                 const std::string& what, Objections& objections) {
  if (names.size() != listed.size() || !std::equal(names.begin(), names.end(), listed.begin(), is_named)) {
    objections.push_back("the " + what + " are not those of the listing, in its order");
  }
}

/// From here on there is an operation of its own in place of what the program computes.
void take_arc_tangent(const Tree& tree, CheckedCode& code, Objections& objections) {
  ListedArcTangent arc;
  // In the listing a constant stands where it is used, and has no number.
  const std::string& name = tree.at("register").text();
  const std::vector<ListedOperation>& operations = code.listing.operations;
  for (std::size_t place = 0, number = 0; place < operations.size(); ++place) {
    if (!operations[place].is("constant") && name == "r" + std::to_string(number++)) {
      arc.place = static_cast<int>(place);
    }
  }
  arc.error = from_decimal(tree.at("error").text());
  arc.largest = from_decimal(tree.at("largest").text());
  check_arc_tangent(code.listing, arc, objections);
  if (objections.empty()) {
    ListedOperation& operation = code.listing.operations[static_cast<std::size_t>(arc.place)];
    operation.name = "arc";
    operation.operands = {code.listing.samples[1], code.listing.samples[0]};
    code.listing.largest_arc = arc.largest.upper_double();
    code.turned = arc.error;
  }
}

}  // namespace

CheckedCode check_code(const Tree& design, Objections& objections) {
  const Tree& code = design.at("code");
  const Tree& model = design.at("model");
  check_files(code, objections);
  CheckedCode result;
  result.listing = read_listing(code.at("listing").text());
  const CodeListing& listing = result.listing;
  if (const Tree* arc = code.find("arc_tangent")) {
    take_arc_tangent(*arc, result, objections);
  }
  if (model.find("ekf") != nullptr) {
    objections.emplace_back("code beside a filter");
    return result;
  }
  const std::vector<std::string> states = listed_texts(model.at("states"));
  const std::vector<std::string> samples = listed_texts(model.at("samples"));
  std::vector<std::string> listed;
  for (const ListedState& state : listing.states) {
    listed.push_back(state.name);
  }
  check_names(states, listed, "states", objections);
  check_names(samples, listing.sample_names, "samples", objections);
  std::vector<bool> is_angle(states.size(), false);
  for (const std::string& angle : listed_texts(model.at("angles"))) {
    const auto found = std::find(states.begin(), states.end(), angle);
    if (found == states.end()) {
      objections.push_back("the angle " + angle + " is no state");
    } else {
      is_angle[static_cast<std::size_t>(found - states.begin())] = true;
    }
  }
  if (!objections.empty()) {
    return result;
  }
  const FormulaGraph graph(states, samples, model.at("step").text(), model.at("frequency").text());
  ListingMatch match(listing, graph, std::move(is_angle));
  objections = match.objections();
  if (objections.empty()) {
    result.angles = match.angles();
  }
  return result;
}

namespace {

std::string words_of_format(ListedFormat format, bool has_angles) {
  const bool is_single = format.bits == 32;
  return std::string("In ") +
         (is_single ? "single precision (IEEE 754 binary32)" : "double precision (IEEE 754 binary64)") +
         " of the formulas as they are written, every number and every operation rounded to nearest, "
         "products "
         "and sums fused or not, subnormal results kept or flushed to 0, " +
         (is_single ? "sinf and cosf within 1.5*2^-24 for arguments up to 8, other functions" : "functions") +
         " of the library within two units in the last place" +
         (has_angles ? ", angles wrapped to half a turn at every sample, and begun there" : "");
}

}  // namespace

std::string words_of_arithmetic(const Tree& design, bool is_rounded) {
  if (const Tree* model = is_rounded ? design.find("model") : nullptr) {
    if (const auto format = written_format(*model)) {
      return words_of_format(*format, !model->at("angles").elements().empty());
    }
  }
  std::string words = is_rounded ? "In IEEE 754 arithmetic" : "In exact arithmetic";
  const Tree* code = design.find("code");
  if (code == nullptr) {
    return words;
  }
  constexpr std::size_t kDigitsShown = 16;
  const std::vector<const Tree*> files = code_files(*code);
  words += " of the listing of `step` and `frequency` in ";
  for (std::size_t i = 0; i < files.size(); ++i) {
    words += i == 0 ? "" : i + 1 == files.size() ? " and " : ", ";
    words += files[i]->at("name").text() + " (SHA-256 " +
             files[i]->at("sha256").text().substr(0, kDigitsShown) + "...)";
  }
  const long before = read_listing(code->at("listing").text()).steps_before;
  if (before > 0) {
    words += before == 1 ? " after its first step" : " after its first " + std::to_string(before) + " steps";
  }
  const Tree* arc = is_rounded ? nullptr : code->find("arc_tangent");
  if (arc != nullptr && design.at("model").at("samples").elements().size() == 2) {
    const std::vector<Tree>& samples = design.at("model").at("samples").elements();
    words += ", with atan2(" + samples.at(1).text() + ", " + samples.at(0).text() + ") in place of " +
             arc->at("register").text() + ", which is within " + arc->at("error").text() +
             " rad of it, up to whole turns, where the larger sample has a size of 2^-40 to 2^40";
  }
  if (is_rounded) {
    words +=
        ", every operation rounded to nearest, products and sums fused or not, subnormal results kept or "
        "flushed "
        "to 0, sinf and cosf within 1.5*2^-24 for arguments up to 8, other functions of the library within "
        "two "
        "units in the last place";
  }
  return words + (design.at("model").at("angles").elements().empty()
                      ? ""
                      : ", angles modulo 2 pi, begun in the ranges that the wraps keep them in");
}

}  // namespace veritrack::checker
