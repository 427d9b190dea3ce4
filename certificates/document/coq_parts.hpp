// The parts of certificate.v: a text for all designs (the files of certificates/coq/), and the parts for the
// design at hand.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "certificates/document/certificate.hpp"
#include "certificates/document/formal_proof.hpp"

namespace veritrack::certificates::coq {

/// The text of certificates/coq/<name>.v, which the build makes part of the program. Throws std::out_of_range
/// when there is no such file.
[[nodiscard]] std::string_view text_for_all_designs(std::string_view name);

/// Appends to the text and lists the statements proved.
class Proofs {
 public:
  Proofs() = default;
  /// The text for all designs, which comes first; a line says where it ends.
  explicit Proofs(std::string_view for_all_designs);

  /// Text that proves nothing by itself: a definition, say.
  void write(std::string_view text) { proofs_.text += text; }

  /// Lists a lemma of the text for all designs.
  void cite(std::string lemma, std::string of, std::string statement) {
    proofs_.proofs.push_back({std::move(lemma), std::move(of), std::move(statement)});
  }

  /// Writes the lemma with its proof, and lists it.
  void prove(const std::string& lemma, const std::string& proposition, const std::string& proof,
             std::string of, std::string statement);

  /// Whether nothing is proved.
  [[nodiscard]] bool empty() const { return proofs_.proofs.empty(); }
  /// Appends all of the other one.
  void append(const Proofs& other);

  /// Adds a remark that something is not proved, and why.
  void leave_out(std::string what_and_why);

  /// The whole text, ending with the command that makes Coq list the axioms it rests on.
  [[nodiscard]] FormalProofs finished() const;

 private:
  FormalProofs proofs_;
};

}  // namespace veritrack::certificates::coq
