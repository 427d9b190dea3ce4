// A number of the design file as a certificate repeats it: its text, and the doubles around it.
#pragma once

#include <string>

#include "checker/document/json_tree.hpp"
#include "checker/document/statement.hpp"

namespace veritrack::checker {

/// The numbers that {text, lo, hi} stands for: the decimal, the double nearest to it, with which a filter
/// runs, and all between them. Objects unless [lo, hi] is the tightest interval of doubles around the
/// decimal. Throws std::invalid_argument for a text that is not a decimal, or longer than 200 characters.
Ball read_number(const Tree& number, Objections& objections);

/// The same for a number that must be positive, or not negative. Objects unless it is.
Ball read_positive(const Tree& number, const std::string& name, Objections& objections);
Ball read_not_negative(const Tree& number, const std::string& name, Objections& objections);

/// A frequency, in rad/sample as it is written, or as "x Hz", which is 2 pi x/sample_rate with [assume]
/// sample_rate. [lo, hi] must enclose it closely.
Ball read_frequency(const Tree& number, const Tree& assume, const std::string& name, Objections& objections);
/// Its change, in rad/sample per sample or as "x Hz per second", 2 pi x/sample_rate^2.
Ball read_slew(const Tree& number, const Tree& assume, Objections& objections);
/// A time, in samples as it is written, or as "x seconds", which is x sample_rate.
Ball read_time(const Tree& number, const Tree& assume, const std::string& name, Objections& objections);
/// As in sentences: the text with the unit that it names, or else with this one.
std::string words_of(const Tree& number, const std::string& unit);

/// The ends of [lowest, highest], rad/sample. Objects unless 0 <= lowest <= highest <= pi, so that a band is
/// never empty.
struct Band {
  Ball lowest, highest;
};
Band read_band(const Tree& assume, Objections& objections);

/// The decimal as it is written.
const std::string& text_of(const Tree& number);

}  // namespace veritrack::checker
