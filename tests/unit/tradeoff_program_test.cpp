// `meniscal tradeoff`: the page and the table beside it.
#include <fmt/format.h>

#include <regex>
#include <sstream>

#include "gtest/gtest.h"
#include "tests/unit/program.h"

namespace meniscal {
namespace {

using test::meniscal;
using test::TemporaryFolder;

const std::string kPost = SCENES "/post.gltf";

// Arguments of `tradeoff`, in quotation marks.
std::string on(const std::string& scene, const std::string& page) {
  return fmt::format("tradeoff \"{}\" -o \"{}\" ", scene, page);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

// Every element that is opened is closed, in order; but those that HTML knows without an end.
std::string unbalanced(const std::string& html) {
  const std::regex tag("<(/?)([a-z0-9]+)((?:[^<>\"]|\"[^\"]*\")*?)(/?)>");
  std::vector<std::string> open;
  for (auto i = std::sregex_iterator(html.begin(), html.end(), tag); i != std::sregex_iterator(); ++i) {
    const std::string name = (*i)[2];
    if ((*i)[4].length() > 0 || name == "meta" || name == "img") continue;
    if ((*i)[1].length() == 0) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return name;
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : open.back();
}

TEST(TradeoffProgram, WritesAPageThatIsWholeAndATable) {
  const TemporaryFolder folder;
  const test::Outcome o = meniscal(folder, on(kPost, folder / "post.html") + "--quick --quiet --reference-passes 3");
  ASSERT_EQ(o.code, 0) << o.error;
  EXPECT_NE(o.output.find("post.csv"), std::string::npos) << o.output;

  std::string html = test::read_bytes(folder / "post.html");
  EXPECT_EQ(html.rfind("<!DOCTYPE html>", 0), 0u);
  // Pictures are long; what is checked of them is that they are in the page.
  const std::size_t images = count(html, "<img ");
  EXPECT_EQ(images, 1 + 2 + 3 * 3u);  // scale; reference and its caustic; picture and two maps of each preset
  EXPECT_EQ(count(html, " src=\"data:image/png;base64,iVBOR"), images);
  EXPECT_EQ(count(html, "src="), images);
  for (std::size_t at = html.find("base64,"); at != std::string::npos; at = html.find("base64,", at + 1))
    html.erase(at + 7, html.find('"', at) - at - 7);
  EXPECT_EQ(unbalanced(html), "");
  EXPECT_GE(count(html, "<svg "), 6u);
  EXPECT_EQ(count(html, "http://") + count(html, "https://"), count(html, "xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_EQ(count(html, "href") + count(html, "<script") + count(html, "@import") + count(html, "url("), 0u);
  EXPECT_EQ(count(html, "\"nan") + count(html, ",nan") + count(html, "\"inf") + count(html, ",inf"), 0u);

  const std::string csv = test::read_bytes(folder / "post.csv");
  std::istringstream rows(csv);
  std::string row, header;
  std::getline(rows, header);
  const auto columns = std::count(header.begin(), header.end(), ',');
  std::size_t points = 0, on_front = 0, presets = 0;
  double draft = 0, paper = 0;
  const std::regex number(R"(,([0-9.]+),[0-9.]+,([0-9.e-]+),([01]),([0-9.e-]+),[01],([0-9.e-]+),[01]\s*$)");
  while (std::getline(rows, row)) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), columns) << row;
    std::smatch match;
    ASSERT_TRUE(std::regex_search(row, match, number)) << row;
    EXPECT_GT(std::stod(match[1]), 0);
    EXPECT_LT(std::stod(match[5]), 1);
    on_front += match[3] == "1";
    presets += row.rfind("preset,", 0) == 0;
    ++points;
    if (row.rfind("preset,draft", 0) == 0) draft = std::stod(match[2]);
    if (row.find("--meniscus paper") != std::string::npos) paper = std::stod(match[2]);
  }
  EXPECT_EQ(points, 7u);
  EXPECT_EQ(presets, 3u);
  EXPECT_GE(on_front, 1u);
  EXPECT_GT(draft, 0);
  EXPECT_GT(paper, draft);  // another meniscus is another picture
}

TEST(TradeoffProgram, RefusesWhatItCannotDo) {
  const TemporaryFolder folder;
  const std::string page = folder / "a.html";
  EXPECT_EQ(meniscal(folder, "tradeoff a.gltf").code, 2);
  EXPECT_EQ(meniscal(folder, on("a.gltf", folder / "a.pdf")).code, 2);
  EXPECT_EQ(meniscal(folder, on(kPost, page) + "--camera nobody").code, 2);
  const test::Outcome missing = meniscal(folder, on(folder / "missing.gltf", page));
  EXPECT_EQ(missing.code, 3);
  EXPECT_NE(missing.error.find("missing.gltf"), std::string::npos) << missing.error;
  const test::Outcome unwritable = meniscal(folder, on(kPost, folder / "no/a.html"));
  EXPECT_EQ(unwritable.code, 1);
  EXPECT_NE(unwritable.error.find("no/a.html"), std::string::npos) << unwritable.error;
  EXPECT_EQ(meniscal(folder, on(kPost, page) + "--device abacus").code, 4);
  EXPECT_EQ(folder.files(), 2u);  // standard output and error
}

}  // namespace
}  // namespace meniscal
