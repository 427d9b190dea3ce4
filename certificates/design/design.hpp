// A design file, read: the choices of the engineer, the assumptions, the requirements; every number with the
// interval it represents and its position in the file.
#pragma once

#include <any>
#include <map>
#include <stdexcept>
#include <string>

#include "analysis/rigor/interval.hpp"

namespace veritrack::certificates {

/// A place in a design file, both from 1; line 0 where there is none (a default).
struct Position {
  int line = 0;
  int column = 0;
};

/// Text of a design file, and the place of its first character.
struct SourceText {
  std::string text;
  Position position{1, 1};
};

/// A number of a design file.
struct Number {
  /// Contains the decimal and the double nearest to it, with a unit in the last place around `tight`, where
  /// that is not a point, as slack for another arithmetic.
  rigor::Interval value;
  rigor::Interval tight;  ///< the tightest interval that holds both
  double nearest = 0.0;   ///< the double nearest to the decimal: what the filter runs with
  /// As written in the file; a number in another unit than that of its key with that unit, "5 Hz", so that no
  /// sentence takes it for one in its own.
  std::string text;
  Position position;
  bool in_hertz = false;  ///< the text is in Hz, Hz per second or seconds; the numbers above are not
};

/// True only when both are certainly the same real number: the same decimal, or the same double exactly.
[[nodiscard]] inline bool same_number(const Number& a, const Number& b) {
  return a.text == b.text || a.value == b.value;
}

/// A design file: the parts common to all trackers, and the tables that go with the tracker, whose type only
/// its column knows.
struct Design {
  std::string name;
  std::string tracker;
  std::string source;
  std::any tables;
  /// The position of the value of each key in the file, by its path, e.g. "design.q1"; defaults are not
  /// in it.
  std::map<std::string, Position> positions;
};

/// The tables of a design, for the column that they belong to. Throws std::logic_error for a design of
/// another tracker.
template <typename Tables>
[[nodiscard]] const Tables& tables_of(const Design& design) {
  const Tables* tables = std::any_cast<Tables>(&design.tables);
  if (tables == nullptr) {
    throw std::logic_error("a design of the tracker " + design.tracker + " has other tables");
  }
  return *tables;
}

}  // namespace veritrack::certificates
