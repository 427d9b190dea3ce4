// The requests of the package for Python to the program, and the answers: JSON in, JSON out, nothing else.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace veritrack::python {

/// Members in the order in which they were added.
using Json = nlohmann::ordered_json;

/// The first message of the process, before any request: "version", "identity" (of the file that runs and of
/// the library that rounds), and "failures" of the arithmetic self-test, which are none where anything may be
/// certified.
[[nodiscard]] Json greeting();

/// The answer to a request, whose member "do" says what is asked for:
///
///   "read"     `text` and `file` (for messages): "name", "tracker", and "positions" of all keys
///   "check"    the same with `threads` (0: all) and `extent` ("requirements", or "everything"): verdicts,
///   bounds, and the SHA-256 of the certificate that they stand in "certify"  the same with `figures`, and
///   "everything" unless `extent` says otherwise: also the documents of
///              the certificate, its figures and their numbers
///   "page"     `markdown`, `file` and `figures`: one page of HTML that fetches nothing
///
/// Whatever is thrown becomes {"error": {"kind", "message"}}: "input" with "file", "line" and "column" (0
/// where there is none), "arithmetic" when nothing can be trusted any more, "failure" for all else.
[[nodiscard]] Json answer(const Json& request);

}  // namespace veritrack::python
