#include "checker/sets/frequency_promise.hpp"

#include <algorithm>
#include <utility>

#include "checker/document/evidence.hpp"

namespace veritrack::checker {

namespace {

const std::string kEkfGuarantee = "ekf/guarantee";
const std::string kModelGuarantee = "model/guarantee";

/// The claim of that id that is PROVED.
const Tree* proved_claim(const Tree& certificate, const std::string& id) {
  for (const Tree& claim : certificate.at("claims").elements()) {
    if (claim.at("id").text() == id && claim.at("verdict").text() == "proved") {
      return &claim;
    }
  }
  return nullptr;
}

std::optional<Ball> upper_end(const Tree& evidence, const char* name) {
  const Tree* quantity = evidence.find(name);
  return quantity != nullptr ? std::optional(high_of(*quantity)) : std::nullopt;
}

/// A recursion sees the tone alone when its signal is what it is without [assume] signal.
bool sees_the_tone_alone(const Tree& model) {
  const auto& signal = model.at("signal").elements();
  return !signal.empty() && signal.size() <= 2 && signal[0].text() == "A*cos(phi)" &&
         (signal.size() == 1 || signal[1].text() == "A*sin(phi)");
}

/// Whether the frequencies of the design are what its numbers say.
bool is_in_radians(const Tree& assume) {
  const Tree* band = assume.find("frequency_in_hertz");
  const Tree* slew = assume.find("slew_in_hertz_per_second");
  return band != nullptr && slew != nullptr && !band->truth() && !slew->truth();
}

}  // namespace

std::optional<FrequencyPromise> frequency_promise(const Tree& certificate, const Verification& found,
                                                  Objections& objections) {
  const Tree& design = certificate.at("design");
  const Tree& assume = design.at("assume");
  const std::string& tracker = design.at("tracker").text();
  const bool is_model = tracker == "model";
  const bool is_ekf = tracker == "quadrature-ekf" || tracker == "single-channel-ekf";
  if (!is_model && !is_ekf) {
    return std::nullopt;
  }
  const std::string& id = is_model ? kModelGuarantee : kEkfGuarantee;
  const auto sentence =
      std::find_if(found.sentences.begin(), found.sentences.end(),
                   [&](const Sentence& each) { return each.id == id && each.verdict == Verdict::proved; });
  const Tree* claim = proved_claim(certificate, id);
  const bool all_verified =
      !found.parts.empty() && std::all_of(found.parts.begin(), found.parts.end(),
                                          [](const Part& part) { return part.objections.empty(); });
  // Gaussian noise is not a number.
  const bool has_bound = assume.at("noise").find("text") != nullptr;
  if (!all_verified || sentence == found.sentences.end() || claim == nullptr || !has_bound ||
      (is_model && (!sees_the_tone_alone(design.at("model")) || !is_in_radians(assume) ||
                    assume.at("amplitude").kind() == Tree::Kind::array ||
                    assume.at("amplitude").find("text") == nullptr))) {
    return std::nullopt;
  }
  FrequencyPromise promise;
  promise.amplitude = read_positive(assume.at("amplitude"), "amplitude", objections);
  promise.noise = read_not_negative(assume.at("noise"), "noise", objections);
  promise.slew = read_slew(assume.at("slew"), assume, objections);
  promise.band = read_band(assume, objections);
  promise.two_channels =
      is_model ? design.at("model").at("samples").elements().size() == 2 : tracker == "quadrature-ekf";
  promise.between =
      text_of(assume.at("frequency").at(0)) + " and " + words_of(assume.at("frequency").at(1), " rad/sample");
  promise.sentence = sentence->text;
  std::optional<Ball> for_ever;
  if (is_ekf) {
    const Tree& evidence = claim->at("evidence");
    for_ever = upper_end(evidence, "frequency_error_bound");
    promise.ultimate = upper_end(evidence, "ultimate_frequency_error");
    promise.settled = settling_claim(evidence);
  } else if (claim->find("from") == nullptr) {
    for_ever = from_decimal(claim->at("frequency_error").text());
    const Tree* ultimate = claim->find("settled_frequency_error");
    promise.ultimate = ultimate != nullptr ? std::optional(from_decimal(ultimate->text())) : std::nullopt;
  }
  if (!for_ever || !objections.empty()) {
    return std::nullopt;
  }
  promise.for_ever = *for_ever;
  return promise;
}

}  // namespace veritrack::checker
