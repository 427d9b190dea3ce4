#include "certificates/model/model_words.hpp"

namespace veritrack::certificates {

std::string arithmetic_of(const ModelTable& model, bool is_rounded) {
  const auto format = written_format(model);
  if (format && is_rounded) {
    const bool is_single = format->bits == 32;
    return fmt::format(
        "In {} of the formulas as they are written, every number and every operation rounded to nearest, "
        "products and sums fused or not, subnormal results kept or flushed to 0, {} of the library within "
        "two units in the last place{}",
        words_of_format(*format),
        is_single ? "sinf and cosf within 1.5*2^-24 for arguments up to 8, other functions" : "functions",
        model.angles.empty() ? "" : ", angles wrapped to half a turn at every sample, and begun there");
  }
  std::string text(is_rounded ? "In IEEE 754 arithmetic" : kExactArithmetic);
  if (!model.compiled) {
    return text;
  }
  text += " of the listing of `step` and `frequency` in ";
  const std::vector<code::CodeFile>& files = model.compiled->files;
  for (std::size_t i = 0; i < files.size(); ++i) {
    text += i == 0 ? "" : i + 1 == files.size() ? " and " : ", ";
    text += fmt::format("{} (SHA-256 {:.16}...)", files[i].name, files[i].sha256);
  }
  if (const int before = model.compiled->listing.steps_before; before > 0) {
    text += before == 1 ? " after its first step" : fmt::format(" after its first {} steps", before);
  }
  if (const auto& arc = model.compiled->arc_tangent; arc && !is_rounded) {
    text += fmt::format(
        ", with atan2({}, {}) in place of r{}, which is within {:.4f} rad of it, up to whole turns, where "
        "the larger sample has a size of 2^-40 to 2^40",
        model.samples[1].text, model.samples[0].text, number_in_text(model.compiled->listing, arc->value),
        arc->error);
  }
  if (is_rounded) {
    text +=
        ", every operation rounded to nearest, products and sums fused or not, subnormal results kept or "
        "flushed to "
        "0, sinf and cosf within 1.5*2^-24 for arguments up to 8, other functions of the library within two "
        "units "
        "in the last place";
  }
  return text + (model.angles.empty()
                     ? ""
                     : ", angles modulo 2 pi, begun in the ranges that the wraps keep them in");
}

}  // namespace veritrack::certificates
