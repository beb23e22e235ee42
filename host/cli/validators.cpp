#include "host/cli/validators.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>

namespace meniscal {
namespace {

template <class Number>
bool parse_all(const std::string& text, Number& number) {
  // from_chars knows no locale: a decimal point is a point everywhere.
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && !text.empty();
}

template <class Accept>
CLI::Validator number_that(const std::string& description, Accept accept) {
  return CLI::Validator(
      [=](std::string& text) {
        double number = 0;
        if (parse_number(text, number) && std::isfinite(number) && accept(number)) return std::string();
        return fmt::format("{} is not {}", text, description);
      },
      "");
}

}  // namespace

bool parse_number(const std::string& text, double& number) { return parse_all(text, number); }
bool parse_integer(const std::string& text, int& number) { return parse_all(text, number); }

bool is_same_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code error;  // a name that leads nowhere fails when it is opened
  const auto place = [&](const std::string& name) { return fs::weakly_canonical(fs::absolute(name, error), error); };
  return a == b || (place(a) == place(b) && !error);
}

CLI::Validator positive() {
  return number_that("a number above 0", [](double x) { return x > 0; });
}

CLI::Validator non_negative() {
  return number_that("a number of 0 or more", [](double x) { return x >= 0; });
}

CLI::Validator finite() {
  return number_that("a number", [](double) { return true; });
}

CLI::Validator whole(double least, double greatest) {
  return CLI::Validator(
      [=](std::string& text) {
        double number = 0;
        if (!parse_number(text, number) || !(number >= least && number <= greatest) || number != std::floor(number))
          return fmt::format("{} is not a whole number from {:.0f} to {:.0f}", text, least, greatest);
        text = fmt::format("{:.0f}", number);
        return std::string();
      },
      "");
}

}  // namespace meniscal
