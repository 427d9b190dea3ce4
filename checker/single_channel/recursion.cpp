#include "checker/single_channel/recursion.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "checker/document/design_number.hpp"
#include "checker/document/model_design_file.hpp"
#include "checker/registry.hpp"

namespace veritrack::checker {

namespace {

/// A number as the design file writes it; such a number is also a formula.
std::string plain_number(const std::string& text, Objections& objections) {
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string::npos) {
    objections.push_back("no number of a recursion: " + text.substr(0, 60));
    return "0";
  }
  return text;
}
std::string number_in(const Tree& number, Objections& objections) {
  return plain_number(text_of(number), objections);
}

/// The band, with the sample rate where its ends are written as "5 Hz".
std::string band_in(const Tree& assume, Objections& objections) {
  const std::string unit = " Hz";
  std::string ends;
  std::size_t in_hertz = 0;
  for (const std::size_t which : {0U, 1U}) {
    const std::string& text = text_of(assume.at("frequency").at(which));
    const bool has_unit = text.ends_with(unit);
    in_hertz += has_unit ? 1 : 0;
    ends += (which == 0 ? "" : ", ") +
            plain_number(has_unit ? text.substr(0, text.size() - unit.size()) : text, objections);
  }
  if (in_hertz == 1) {
    objections.emplace_back("a band with ends in two units");
  }
  ends = "[" + ends + "]";
  return in_hertz == 0
             ? ends
             : "{ hz = " + ends + " }\nsample_rate = " + number_in(assume.at("sample_rate"), objections);
}

/// q1, q2 and r, as `read_single_channel_design` takes them.
struct VarianceTexts {
  std::string q1, q2, r;
};
VarianceTexts variance_texts(const Tree& chosen, Objections& objections) {
  const Tree& process_noise = chosen.at("process_noise");
  const Tree* ratio = chosen.find("lambda");
  const std::string r = number_in(ratio != nullptr ? *ratio : chosen.at("r"), objections);
  if (process_noise.kind() == Tree::Kind::object) {
    return {number_in(process_noise.at("q1"), objections), number_in(process_noise.at("q2"), objections), r};
  }
  const std::string q = ratio != nullptr ? "1" : number_in(chosen.at("q"), objections);
  return {process_noise.text() == "identity" ? q : "0", q, r};
}

/// The content that the recursion's design file must have: a table "recursion". `asked`: its keys of
/// [require]; `has_jacobian`: whether the derivative of the prediction is written out, which is optional.
std::string recursion_of(const Tree& design, bool has_jacobian,
                         const std::map<std::string, std::string>& asked, Objections& objections) {
  const Tree& assume = design.at("assume");
  const auto [q1, q2, r] = variance_texts(design.at("design"), objections);
  const auto number = [&](const Tree& tree) { return number_in(tree, objections); };
  std::string text = R"([recursion]
tracker = "model"
[recursion.model]
samples = "y"
frequency = "w"
[recursion.model.ekf]
states = ["x1", "x2", "w"]
predict = '''
x1' = cos(w)*x1 - sin(w)*x2
x2' = sin(w)*x1 + cos(w)*x2
w' = (1 - epsilon)*w
'''
measure = "x1"
Q = [["q1", 0, 0], [0, "q1", 0], [0, 0, "q2"]]
R = "r"
)";
  text += has_jacobian ? R"TOML(jacobian = [
  ["cos(w)", "-sin(w)", "-(sin(w)*x1 + cos(w)*x2)"],
  ["sin(w)", "cos(w)", "cos(w)*x1 - sin(w)*x2"],
  ["0", "0", "1 - epsilon"],
]
)TOML"
                       : "";
  text += "[recursion.model.parameters]\nq1 = " + q1 + "\nq2 = " + q2 + "\nr = " + r +
          "\nepsilon = " + number(design.at("design").at("epsilon")) +
          "\n[recursion.assume]\namplitude = " + number(assume.at("amplitude")) +
          "\nfrequency = " + band_in(assume, objections) + "\nnoise = " + number(assume.at("noise")) +
          "\n[recursion.require]\n";
  for (const auto& [key, value] : asked) {
    text.append(key).append(" = ").append(value).append("\n");
  }
  return text;
}

/// The keys of the recursion's [require]: those of the design's that mean the same there.
std::map<std::string, std::string> asked_of(const Tree& recursion, const Tree& design, bool is_constant,
                                            Objections& objections) {
  std::map<std::string, std::string> asked;
  for (const auto& [key, value] : recursion.at("require").members()) {
    const Tree* same = design.at("require").find(key);
    const bool is_same = key == "largest_noise_at_least" ||
                         // Under the assumed slew, which the recursion does not assume.
                         (key == "frequency_error_radius_at_least" && is_constant);
    if (same == nullptr || !is_same) {
      objections.push_back("the recursion requires what the design does not: " + key.substr(0, 60));
    } else {
      asked[key] = number_in(*same, objections);
    }
  }
  return asked;
}

}  // namespace

Recursion::Recursion(const Tree& certificate, const SingleChannelDesign& design, bool all_boxes,
                     Verification& result) {
  const Tree* part = certificate.find("recursion");
  if (part == nullptr) {
    return;
  }
  part_ = part;
  Objections objections;
  const Tree& inner = part->at("design");
  if (inner.at("tracker").text() != "model") {
    result.parts.push_back({"recursion", {"it is no recursion"}});
    return;
  }
  const Tree& outer = certificate.at("design");
  const auto asked = asked_of(inner, outer, certainly_equal(design.slew, zero), objections);
  const bool has_jacobian = inner.at("model").at("ekf").find("jacobian") != nullptr;
  try {
    const TomlFile file(recursion_of(outer, has_jacobian, asked, objections));
    compare_model_design(inner, file, *file.table().get_as<toml::table>("recursion"), objections);
  } catch (const toml::parse_error&) {  // numbers that no TOML file can have
    objections.emplace_back("no numbers of a design file");
  }
  result.parts.push_back({"recursion, that it is the same filter", objections});
  if (!objections.empty()) {
    return;  // nothing of it is about this design
  }
  verify_tracker(*part, all_boxes, found_);
  result.cells += found_.cells;
  is_verified_ = !found_.parts.empty();
  for (const Part& each : found_.parts) {
    is_verified_ = is_verified_ && each.objections.empty();
    result.parts.push_back({"recursion: " + each.name, each.objections});
  }
}

Claim Recursion::check(const Tree& claim, const Guarantee& guarantee, Objections& objections) const {
  static const std::map<std::string, std::string> same{
      {"recursion/guarantee", "model/guarantee"},
      {"recursion/limits", "model/limits"},
      {"recursion/steady-state", "model/steady-state"},
      {"ekf/largest-noise", "model/largest-noise"},
      {"ekf/frequency-error-radius", "model/frequency-error-radius"}};
  const std::string& id = claim.at("id").text();
  const auto known = same.find(id);
  if (known == same.end() || (decides(claim) && claim.at("by").text() != "recursion") ||
      decides(claim) == is_of_recursion(id)) {
    objections.emplace_back(kUnknown);
    return {};
  }
  const auto sentence = std::find_if(
      found_.sentences.begin(), found_.sentences.end(),
      [&](const Sentence& each) { return each.id == known->second && each.verdict == Verdict::proved; });
  if (!is_verified_ || sentence == found_.sentences.end()) {
    objections.emplace_back(kUnverified);
    return {};
  }
  // Requirements here name the lock by the number of this tracker.
  const auto& inner = part_->at("claims").elements();
  const auto there = std::find_if(inner.begin(), inner.end(),
                                  [&](const Tree& each) { return each.at("id").is(known->second); });
  const Tree* error = there == inner.end() ? nullptr : there->find("frequency_error");
  if (decides(claim) && error != nullptr && !guarantee.is_lock(from_decimal(error->text()))) {
    objections.emplace_back("the frequency errors in its set do not tell the lock from others");
  }
  Claim found;
  found.hypotheses = sentence->hypotheses;
  found.statement = sentence->text;
  found.verdict = Verdict::proved;
  found.is_summary = is_of_recursion(id);
  check_claim(claim, found, objections);
  return found;
}

}  // namespace veritrack::checker
