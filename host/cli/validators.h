// Checks of option values that CLI11 lacks: NaN passes its ranges, and its numbers do not take 1e6.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace meniscal {

// Finite numbers > 0, >= 0, or any.
CLI::Validator positive();
CLI::Validator non_negative();
CLI::Validator finite();

// Whole numbers from `least` to `greatest`; 1e6 may be written for 1000000.
CLI::Validator whole(double least, double greatest);

// The number that `text` holds, nothing else around it; false where it holds none.
bool parse_number(const std::string& text, double& number);

// The same for a whole number that an int holds.
bool parse_integer(const std::string& text, int& number);

// Do both names lead to one place, whether a file is there or not?
bool is_same_file(const std::string& a, const std::string& b);

}  // namespace meniscal
