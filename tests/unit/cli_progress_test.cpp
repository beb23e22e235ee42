// Progress lines and the interrupt flag.
#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "gtest/gtest.h"
#include "host/cli/interrupt.h"
#include "host/cli/progress.h"
#include "tests/unit/image_temporary_folder.h"

namespace meniscal {
namespace {

TEST(Progress, StyleFollowsTerminalAndFlags) {
  EXPECT_EQ(progress_style(false, false, true), ProgressStyle::bar);
  EXPECT_EQ(progress_style(false, false, false), ProgressStyle::json);
  EXPECT_EQ(progress_style(false, true, true), ProgressStyle::json);
  EXPECT_EQ(progress_style(true, false, true), ProgressStyle::none);
  EXPECT_EQ(progress_style(true, false, false), ProgressStyle::none);
}

TEST(Progress, RemainingTimeIsInProportion) {
  EXPECT_DOUBLE_EQ(remaining_seconds({"photons", 4, 16, 10}), 30);
  EXPECT_DOUBLE_EQ(remaining_seconds({"photons", 16, 16, 10}), 0);
  EXPECT_LT(remaining_seconds({"photons", 0, 16, 10}), 0);
  EXPECT_LT(remaining_seconds({"photons", 0, 0, 10}), 0);
}

TEST(Progress, BarIsFilledInProportionAndFitsTheTerminal) {
  const std::string line = progress_bar({"photons", 4, 16, 100}, 120);
  EXPECT_NE(line.find("[==========>                             ]"), std::string::npos) << line;
  EXPECT_NE(line.find("25 %  4/16  1 min 40 s, 5 min 00 s to go"), std::string::npos) << line;
  for (int columns = 1; columns < 130; ++columns)
    EXPECT_LT(progress_bar({"photons", 4, 16, 1e6}, columns).size(), columns);
}

TEST(Progress, JsonIsOneObjectALine) {
  const nlohmann::json line = nlohmann::json::parse(progress_json({"photons", 4, 16, 10}));
  EXPECT_EQ(line.at("stage"), "photons");
  EXPECT_EQ(line.at("done"), 4);
  EXPECT_EQ(line.at("total"), 16);
  EXPECT_EQ(line.at("remaining_s"), 30.0);
  EXPECT_TRUE(nlohmann::json::parse(progress_json({"photons", 0, 16, 0})).at("remaining_s").is_null());
}

TEST(Progress, FirstAndLastAreAlwaysSaid) {
  const test::TemporaryFolder folder;
  for (const ProgressStyle style : {ProgressStyle::json, ProgressStyle::none}) {
    std::FILE* stream = std::fopen((folder / "log").c_str(), "w");
    {
      Progress progress(style, stream);
      progress.begin("photons", 1000);
      for (long i = 1; i <= 1000; ++i) progress.update(i);
    }
    std::fclose(stream);
    const std::string log = test::read_bytes(folder / "log");
    if (style == ProgressStyle::none) {
      EXPECT_EQ(log, "");
      continue;
    }
    EXPECT_NE(log.find("\"done\":0,"), std::string::npos);
    EXPECT_NE(log.find("\"done\":1000,"), std::string::npos);
    EXPECT_LT(std::count(log.begin(), log.end(), '\n'), 10);
  }
}

TEST(InterruptDeathTest, FirstSignalAsksSecondEnds) {
  const auto once = [](int signal) {
    catch_interrupts();
    if (interrupted()) std::_Exit(1);
    raise(signal);
    std::_Exit(interrupted() ? 0 : 2);
  };
  EXPECT_EXIT(once(SIGINT), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT(once(SIGTERM), ::testing::ExitedWithCode(0), "");
  EXPECT_EXIT((catch_interrupts(), raise(SIGINT), raise(SIGINT)), ::testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace meniscal
