// README and program speak of the same options.
#include <CLI/CLI.hpp>
#include <regex>
#include <set>

#include "gtest/gtest.h"
#include "host/cli/render_options.h"
#include "tests/unit/image_temporary_folder.h"

namespace meniscal {
namespace {

std::set<std::string> long_options(const std::string& text) {
  const std::regex option("--[a-z][a-z-]+");
  return {std::sregex_token_iterator(text.begin(), text.end(), option), std::sregex_token_iterator()};
}

TEST(Readme, ListsTheOptionsOfRender) {
  const std::string readme = test::read_bytes(SCENES "/../README.md");
  const std::size_t begin = readme.find("| option | meaning |"), end = readme.find("\n\n", begin);
  ASSERT_NE(begin, std::string::npos);

  RenderOptions options;
  CLI::App app;
  CLI::App* render = app.add_subcommand("render");
  add_render_options(*render, options);
  std::set<std::string> known;
  for (const CLI::Option* option : render->get_options())
    for (const std::string& name : option->get_lnames())
      if (name != "help") known.insert("--" + name);

  EXPECT_EQ(long_options(readme.substr(begin, end - begin)), known);
}

}  // namespace
}  // namespace meniscal
